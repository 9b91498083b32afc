#include "planner/controller/neighbours.hpp"

#include <cmath>
#include <utility>

namespace hlc::controller {

coordination::MissingVehicleRules rules_for_missing(
    const automaton::UniversalAutomaton& automaton) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  return {
      .max_speed_mps = automaton::top_speed_mps(automaton),
      .circumradius_m = 0.5 * std::hypot(vehicle.footprint.length_m, vehicle.footprint.width_m) +
                        std::sqrt(2.0) * vehicle.safety_margin_m,
      .footprint = vehicle.footprint,
      .safety_margin_m = vehicle.safety_margin_m};
}

std::vector<VehicleId> Neighbours::silent(std::span<const VehicleId> active) {
  std::vector<VehicleId> silent;
  for (const VehicleId other : active) {
    if (other == own_) continue;
    const StepIndex last = last_received_.try_emplace(other, now_).first->second;
    if (now_.value >= last.value + coordination::kSilentSteps) silent.push_back(other);
  }
  return silent;
}

void Neighbours::receive(const coordination::ReceivedMessages<coordination::Traffic>& traffic,
                         const Observation& observation) {
  missing_.clear();
  present_ = observation.present;
  guests_.observe(observation);
  for (const VehicleId other : observation.active) {
    if (other == own_) continue;
    std::shared_ptr<const coordination::Traffic> message = traffic.find(other, now_);
    if (message == nullptr) {
      missing_.push_back(other);
      continue;
    }
    traffic_[other] = std::move(message);
    last_received_[other] = now_;
  }
  forget_if_steps_are_missing();
  update_liveness(observation);
  update_standstill(observation);
}

Neighbours Neighbours::in_place_of(VehicleId other, const coordination::Traffic& own) const {
  Neighbours result = *this;
  result.own_ = other;
  result.traffic_.erase(other);
  result.traffic_[own_] = std::make_shared<const coordination::Traffic>(own);
  return result;
}

void Neighbours::forget_if_steps_are_missing() {
  const bool is_gap = last_looked_ && now_.value > last_looked_->value + 1;
  last_looked_ = now_;
  if (!is_gap) return;
  last_sign_of_life_.clear();
  last_not_standing_.clear();
}

bool Neighbours::is_received(VehicleId vehicle) const {
  const auto found = traffic_.find(vehicle);
  return found != traffic_.end() && found->second->step == now_;
}

bool Neighbours::is_received_by_any(VehicleId vehicle) const {
  return std::ranges::any_of(received(), [vehicle](const coordination::Traffic* traffic) {
    return std::ranges::find(traffic->silent, vehicle) == traffic->silent.end();
  });
}

std::vector<const coordination::Traffic*> Neighbours::received() const {
  std::vector<const coordination::Traffic*> result;
  for (const auto& [vehicle, traffic] : traffic_) {
    if (traffic->step == now_) result.push_back(traffic.get());
  }
  return result;
}

void Neighbours::update_liveness(const Observation& observation) {
  for (const VehicleId other : observation.active) {
    const bool is_alive = is_received(other) || is_received_by_any(other) || holds(present_, other);
    const auto [last, is_first] = last_sign_of_life_.try_emplace(other, now_);
    if (is_alive && !is_first) last->second = now_;
  }
}

void Neighbours::update_standstill(const Observation& observation) {
  for (const VehicleId other : observation.active) {
    const coordination::MeasuredVehicle* state = observation.measured(other);
    const bool stands = state != nullptr && coordination::is_seen_standing(*state, rules_);
    const auto [last, is_first] = last_not_standing_.try_emplace(other, now_);
    if (!stands && !is_first) last->second = now_;
  }
}

bool Neighbours::stands_for_good(VehicleId vehicle, std::size_t horizon_steps) const {
  return coordination::stands_for_good({.now = now_,
                                        .last_sign_of_life = last_sign_of_life_.at(vehicle),
                                        .last_not_standing = last_not_standing_.at(vehicle)},
                                       horizon_steps);
}

bool Neighbours::is_cut_off(std::size_t horizon_steps) const {
  return received().empty() && std::ranges::any_of(missing_, [&](VehicleId other) {
           return (traffic_.contains(other) || holds(present_, other)) &&
                  !stands_for_good(other, horizon_steps);
         });
}

}  // namespace hlc::controller
