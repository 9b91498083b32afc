#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>

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
  SenderCheck(std::shared_ptr<const ParticipantCore> core, std::string topic);

  /// False: the message is to be dropped, since another participant than `sender` published it.
  /// Logged once per participant, of which kMostLogged are.
  [[nodiscard]] bool accepts(const frtps::GUID_t& writer, const std::string& sender);

 private:
  static constexpr std::size_t kMostLogged = 8;

  void log(const frtps::GUID_t& writer, const std::string& names, const std::string& sender);

  std::shared_ptr<const ParticipantCore> core_;
  std::string topic_;
  std::set<frtps::GuidPrefix_t> logged_;
};

}  // namespace hlc::dds
