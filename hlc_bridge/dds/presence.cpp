#include "hlc_bridge/dds/presence.hpp"

#include <algorithm>

namespace hlc::dds {

void Presence::appeared(const ParticipantKey& key, const std::string& name,
                        const std::string& version) {
  if (!names_.emplace(key, name).second) {
    return;
  }
  if (!version.empty()) versions_.emplace(key, version);
  alive_.insert(name);
  lost_.erase(name);
}

void Presence::left(const ParticipantKey& key) {
  const auto found = names_.find(key);
  if (found == names_.end()) {
    return;
  }
  const std::string name = found->second;
  names_.erase(found);
  versions_.erase(key);
  const bool still_there =
      std::ranges::any_of(names_, [&](const auto& entry) { return entry.second == name; });
  if (!still_there) {
    alive_.erase(name);
    lost_.insert(name);
  }
}

std::map<std::string, std::string> Presence::versions() const {
  std::map<std::string, std::string> result;
  for (const auto& [key, version] : versions_) result[names_.at(key)] = version;
  return result;
}

const std::string* Presence::name_of(const ParticipantKey& key) const {
  const auto found = names_.find(key);
  return found == names_.end() ? nullptr : &found->second;
}

}  // namespace hlc::dds
