#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>

#include "hlc_bridge/dds/participant_core.hpp"

namespace hlc::dds {

/// Log lines on messages of a topic that are dropped for what their publisher does: once per
/// participant, of which kMostLogged are. Not thread-safe. Only sources of this folder include this
/// file.
class DropLog {
 public:
  DropLog(std::shared_ptr<const ParticipantCore> core, std::string topic);

  void log(const frtps::GUID_t& writer, const std::string& reason);

 private:
  static constexpr std::size_t kMostLogged = 8;

  std::shared_ptr<const ParticipantCore> core_;
  std::string topic_;
  std::set<frtps::GuidPrefix_t> logged_;
};

}  // namespace hlc::dds
