#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/controller/guests.hpp"
#include "planner/controller/observation.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"
#include "planner/coordination/received_messages.hpp"

namespace hlc::controller {

[[nodiscard]] inline bool holds(std::span<const VehicleId> vehicles, VehicleId vehicle) {
  return std::ranges::find(vehicles, vehicle) != vehicles.end();
}

/// Motion limits of a missing vehicle: over all maneuvers of the automaton, since another vehicle
/// may drive on any subgraph.
[[nodiscard]] coordination::MissingVehicleRules rules_for_missing(
    const automaton::UniversalAutomaton& automaton);

/// One controller's knowledge of the other vehicles: received in this step, alive, standing. A
/// value.
class Neighbours {
 public:
  /// @param rules  for missing ones
  Neighbours(VehicleId own, const coordination::MissingVehicleRules& rules,
             const std::vector<coordination::Guest>& guests = {})
      : own_(own), rules_(rules), guests_(guests) {}

  [[nodiscard]] const coordination::MissingVehicleRules& rules() const { return rules_; }
  [[nodiscard]] const Guests& guests() const { return guests_; }

  /// Starts a step in which no message has been received.
  void begin_step(StepIndex step) { now_ = step; }
  /// The active vehicles not received for kSilentSteps (Traffic::silent).
  [[nodiscard]] std::vector<VehicleId> silent(std::span<const VehicleId> active);

  /// Takes this step's traffic; messages of other steps or senders and malformed ones are ignored.
  /// Updates liveness and standstill. In steps that were left out nobody was looked at: a vehicle
  /// may have driven and been received meanwhile.
  void receive(const coordination::ReceivedMessages<coordination::Traffic>& traffic,
               const Observation& observation);

  /// The same knowledge in the controller of `other`, if it has received the same in this step and
  /// those before. @param own  traffic of this controller. @pre receive; `other` was received
  [[nodiscard]] Neighbours in_place_of(VehicleId other, const coordination::Traffic& own) const;

  /// Received in this step, sorted by vehicle.
  [[nodiscard]] std::vector<const coordination::Traffic*> received() const;
  /// @pre it was received in this step
  [[nodiscard]] const coordination::Traffic& traffic_of(VehicleId vehicle) const {
    return *traffic_.at(vehicle);
  }
  /// Active vehicles that were not received, in the order of the observation. Valid after
  /// `receive`.
  [[nodiscard]] const std::vector<VehicleId>& missing() const { return missing_; }
  /// Whether a missing vehicle is a standing obstacle. @pre it is one of `missing`
  [[nodiscard]] bool stands_for_good(VehicleId vehicle, std::size_t horizon_steps) const;
  /// No active vehicle is received, although one that does not stand for good was received once, or
  /// its controller's process is present: these controllers may not receive this one, and take it
  /// for one that stands for good.
  [[nodiscard]] bool is_cut_off(std::size_t horizon_steps) const;

 private:
  void forget_if_steps_are_missing();
  void update_liveness(const Observation& observation);
  void update_standstill(const Observation& observation);
  [[nodiscard]] bool is_received(VehicleId vehicle) const;
  /// Traffic of this step does not list it as silent: its sender receives it. (A sender that has
  /// just started lists nobody for kSilentSteps.)
  [[nodiscard]] bool is_received_by_any(VehicleId vehicle) const;

  VehicleId own_;
  coordination::MissingVehicleRules rules_;
  Guests guests_;
  StepIndex now_;
  std::optional<StepIndex> last_looked_;  ///< last step of `receive`
  /// The last of each; of this step only if its step matches
  std::map<VehicleId, std::shared_ptr<const coordination::Traffic>> traffic_;
  std::vector<VehicleId> missing_;
  std::vector<VehicleId> present_;  ///< Observation::present
  std::map<VehicleId, StepIndex> last_received_;
  /// Last step in which the vehicle's controller may have agreed to something: received or present.
  std::map<VehicleId, StepIndex> last_sign_of_life_;
  /// Last step in which the list did not show the vehicle standing.
  std::map<VehicleId, StepIndex> last_not_standing_;
};

}  // namespace hlc::controller
