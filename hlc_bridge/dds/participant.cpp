#include "hlc_bridge/dds/participant.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/dds/participant_core.hpp"

namespace hlc::dds {

Participant::Participant(const ParticipantOptions& options,
                         std::function<void()> on_presence_change)
    : core_{std::make_shared<ParticipantCore>(options, std::move(on_presence_change))} {}

Participant::~Participant() { core_->close(); }

std::set<std::string> Participant::alive() const {
  return core_->with_presence([](const Presence& presence) { return presence.alive(); });
}

bool Participant::is_alive(const std::string& name) const {
  return core_->with_presence(
      [&](const Presence& presence) { return presence.alive().contains(name); });
}

std::set<std::string> Participant::lost() const {
  return core_->with_presence([](const Presence& presence) { return presence.lost(); });
}

bool Participant::is_lost(const std::string& name) const {
  return core_->with_presence(
      [&](const Presence& presence) { return presence.lost().contains(name); });
}

std::map<std::string, std::string> Participant::versions() const {
  return core_->with_presence([](const Presence& presence) { return presence.versions(); });
}

bool Participant::wait_for(const std::set<std::string>& names,
                           std::chrono::steady_clock::time_point deadline) const {
  return core_->wait_until(deadline, [&](const Presence& presence) {
    return std::ranges::includes(presence.alive(), names);
  });
}

const ParticipantOptions& Participant::options() const { return core_->options(); }

}  // namespace hlc::dds
