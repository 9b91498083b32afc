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

void Readiness::update(bool has_started) {
  if (is_ready_ || has_duplicate() || active_.empty() || peers_.command_readers == 0) return;
  const bool may_join = rule_ == StartRule::kAtTrigger && has_started;
  if (!may_join && !unmatched_peers().empty()) return;
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
