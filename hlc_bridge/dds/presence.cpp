#include "hlc_bridge/dds/presence.hpp"

#include <algorithm>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::dds {

std::string name_in_log(std::string name) {
  constexpr std::size_t kLongest = 64;
  if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  std::ranges::replace_if(
      name, [](char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

void Presence::appeared(const ParticipantKey& key, const std::string& name,
                        const std::string& version) {
  const auto [entry, is_new] = names_.try_emplace(key);
  if (!is_new) return;
  entry->second = process_names(name);
  if (!version.empty()) versions_.emplace(key, version);
  for (const std::string& process : entry->second) {
    alive_.insert(process);
    lost_.erase(process);
  }
}

void Presence::left(const ParticipantKey& key) {
  const auto found = names_.find(key);
  if (found == names_.end()) {
    return;
  }
  const std::vector<std::string> left = found->second;
  names_.erase(found);
  if (former_names_.insert_or_assign(key, left).second) former_.push_back(key);
  if (former_.size() > kMostFormer) {
    former_names_.erase(former_.front());
    former_.pop_front();
  }
  versions_.erase(key);
  for (const std::string& name : left) {
    const bool still_there = std::ranges::any_of(
        names_, [&](const auto& entry) { return std::ranges::count(entry.second, name) > 0; });
    if (still_there) continue;
    alive_.erase(name);
    lost_.insert(name);
  }
}

std::map<std::string, std::string> Presence::versions() const {
  std::map<std::string, std::string> result;
  for (const auto& [key, version] : versions_) {
    for (const std::string& name : names_.at(key)) result[name] = version;
  }
  return result;
}

std::vector<std::string> Presence::names_of(const ParticipantKey& key) const {
  const auto found = names_.find(key);
  return found == names_.end() ? std::vector<std::string>{} : found->second;
}

const std::vector<std::string>* Presence::last_names_of(const ParticipantKey& key) const {
  const auto present = names_.find(key);
  if (present != names_.end()) return &present->second;
  const auto former = former_names_.find(key);
  return former == former_names_.end() ? nullptr : &former->second;
}

}  // namespace hlc::dds
