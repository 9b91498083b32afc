#pragma once

#include <memory>
#include <string>

#include "hlc_bridge/dds/drop_log.hpp"
#include "hlc_bridge/dds/participant_core.hpp"

namespace hlc::dds {

/// Whether a message that only `sender` may publish counts if `publisher` has published it.
/// @param is_among_others  on the lab's transport, see SenderOf
[[nodiscard]] bool counts(const Presence& presence, const ParticipantKey& publisher,
                          const std::string& sender, bool is_among_others);

/// Compares the participants that publish on a topic with those that alone may (SenderOf). Not
/// thread-safe. Only sources of this folder include this file.
class SenderCheck {
 public:
  SenderCheck(std::shared_ptr<const ParticipantCore> core, const std::string& topic);

  /// False: the message is to be dropped, since another participant than `sender` published it.
  /// Logged once per participant.
  [[nodiscard]] bool accepts(const frtps::GUID_t& writer, const std::string& sender);

 private:
  std::shared_ptr<const ParticipantCore> core_;
  DropLog log_;
};

}  // namespace hlc::dds
