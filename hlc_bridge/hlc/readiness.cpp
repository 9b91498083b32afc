#include "hlc_bridge/hlc/readiness.hpp"

#include <fmt/format.h>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::high_level_controller {

void Readiness::receive(const HlcPeers& peers) { peers_ = peers; }

bool Readiness::has_duplicate() const {
  return peers_.lab.alive.contains(controller_name(vehicle_.value));
}

bool Readiness::yields_to_duplicate() const {
  return is_ready_ ? is_duplicate_received_ : has_duplicate();
}

std::set<std::string> Readiness::unmatched_peers() const {
  std::set<std::string> names;
  for (const VehicleId vehicle : active_) {
    const std::string name = controller_name(vehicle.value);
    if (vehicle != vehicle_ && !peers_.receivers.contains(name)) names.insert(name);
  }
  return names;
}

std::set<std::string> Readiness::absent_controllers() const {
  std::set<std::string> names = unmatched_peers();
  std::erase_if(names, [this](const std::string& name) {
    return peers_.lab.alive.contains(name) || peers_.controllers.alive.contains(name);
  });
  return names;
}

void Readiness::update(bool has_started, Nanoseconds since_start) {
  if (is_ready_ || has_duplicate() || active_.empty() || peers_.command_readers == 0) return;
  const bool may_join = rules_.start == StartRule::kAtTrigger && has_started;
  const bool may_be_alone = rules_.waits_for_start && since_start >= rules_.controller_patience;
  std::set<std::string> awaited = unmatched_peers();
  if (may_be_alone) {
    for (const std::string& name : absent_controllers()) awaited.erase(name);
  }
  if (!may_join && !awaited.empty()) return;
  is_ready_ = true;
  is_duplicate_received_ = false;
}

bool Readiness::is_reachable(VehicleId vehicle) const {
  return peers_.controllers.alive.contains(controller_name(vehicle.value));
}

std::vector<VehicleId> Readiness::present(std::vector<VehicleId> vehicles) const {
  std::erase_if(vehicles, [this](VehicleId vehicle) {
    return !is_reachable(vehicle) && !peers_.lab.alive.contains(controller_name(vehicle.value));
  });
  return vehicles;
}

std::string Readiness::missing() const {
  if (has_duplicate()) {
    return "another instance of " + controller_name(vehicle_.value) + " is running";
  }
  if (active_.empty()) return "no state list received from the middleware";
  std::set<std::string> names = unmatched_peers();
  if (peers_.command_readers == 0) names.insert("the middleware's reader of commands");
  return fmt::format("missing: {}", fmt::join(names, ", "));
}

}  // namespace hlc::high_level_controller
