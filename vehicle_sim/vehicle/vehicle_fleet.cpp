#include "vehicle_sim/vehicle/vehicle_fleet.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"

namespace hlc::simulated_vehicle {

static_assert(machine::Machine<VehicleFleet>);

VehicleFleet::VehicleFleet(const std::vector<VehicleMachineOptions>& vehicles) {
  for (const VehicleMachineOptions& options : vehicles) {
    vehicles_.try_emplace(options.vehicle.vehicle_id, options);
  }
}

void VehicleFleet::on(Event event) {
  std::visit([this](auto& what) { take(what); }, event);
}

void VehicleFleet::take(FleetPresence& presence) {
  for (auto& [id, one] : presence) vehicles_.at(id).on(std::move(one));
}

std::vector<VehicleFleet::Action> VehicleFleet::advance(const Instant& now) {
  std::vector<Action> actions;
  std::set<std::string> requests;
  for (auto& [id, vehicle] : vehicles_) {
    for (VehicleMachine::Action& action : vehicle.advance(now)) {
      if (const auto* request = std::get_if<ParameterRequest>(&action)) {
        if (requests.insert(request->name).second) actions.emplace_back(*request);
      } else {
        actions.emplace_back(OfVehicle<VehicleMachine::Action>{id, std::move(action)});
      }
    }
  }
  return actions;
}

WakeUp VehicleFleet::wake_up() const {
  WakeUp wake;
  bool is_busy = false;  // a vehicle that requests no tick yet may publish before it
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.exit_code()) continue;
    const WakeUp one = vehicle.wake_up();
    wake.wall = machine::earlier(wake.wall, one.wall);
    wake.run = machine::earlier(wake.run, one.run);
    is_busy = is_busy || !one.run;
  }
  if (is_busy) wake.run.reset();
  return wake;
}

std::size_t VehicleFleet::awaited() const {
  std::size_t sum = 0;
  for (const auto& [id, vehicle] : vehicles_) {
    const std::size_t one = vehicle.exit_code() ? machine::kOnlyUrgent : vehicle.awaited();
    if (one != machine::kOnlyUrgent) sum += one;
  }
  return sum == 0 ? machine::kOnlyUrgent : sum;
}

std::optional<int> VehicleFleet::exit_code() const {
  const auto has_failed = [](const auto& entry) {
    return entry.second.exit_code().value_or(kExitGood) != kExitGood;
  };
  const auto failed = std::ranges::find_if(vehicles_, has_failed);
  if (failed != vehicles_.end()) return failed->second.exit_code();
  const bool all = std::ranges::all_of(
      vehicles_, [](const auto& entry) { return entry.second.exit_code().has_value(); });
  return all ? std::optional{kExitGood} : std::nullopt;
}

}  // namespace hlc::simulated_vehicle
