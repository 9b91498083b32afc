#include "planner/controller/guests.hpp"

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"

namespace hlc::controller {

Guests::Guests(const std::vector<coordination::Guest>& guests) {
  for (const coordination::Guest& guest : guests) {
    guests_.push_back({.guest = guest, .last = std::nullopt, .step = {}});
  }
}

void Guests::observe(const Observation& observation) {
  now_ = observation.step;
  for (Seen& one : guests_) {
    const coordination::MeasuredVehicle* const measured = observation.measured(one.guest.vehicle);
    if (measured == nullptr) continue;
    one.last = *measured;
    one.step = now_;
  }
}

std::vector<VehicleId> Guests::seen() const {
  std::vector<VehicleId> vehicles;
  for (const Seen& one : guests_) {
    if (one.last) vehicles.push_back(one.guest.vehicle);
  }
  return vehicles;
}

std::vector<ConvexPolygon> Guests::reachable_m(VehicleId guest, std::size_t horizon_steps,
                                               double step_s) const {
  const auto one =
      std::ranges::find(guests_, guest, [](const Seen& seen) { return seen.guest.vehicle; });
  HLC_DEMAND(one != guests_.end() && one->last);
  const double since_s = static_cast<double>(now_.value - one->step.value) * step_s;
  std::vector<ConvexPolygon> areas_m;
  for (std::size_t j = 1; j <= horizon_steps; ++j) {
    const double from_s = since_s + static_cast<double>(j) * step_s;
    areas_m.push_back(
        coordination::reachable_area(one->guest, *one->last, from_s, from_s + step_s));
  }
  return areas_m;
}

std::vector<std::vector<ConvexPolygon>> Guests::avoided_in_motion_m(
    std::span<const VehicleId> guests, std::size_t horizon_steps, double step_s) const {
  std::vector<std::vector<ConvexPolygon>> avoided_m(guests.empty() ? 0 : horizon_steps);
  for (const VehicleId guest : guests) {
    std::vector<ConvexPolygon> areas_m = reachable_m(guest, horizon_steps, step_s);
    for (std::size_t j = 0; j < horizon_steps; ++j) avoided_m[j].push_back(std::move(areas_m[j]));
  }
  return avoided_m;
}

}  // namespace hlc::controller
