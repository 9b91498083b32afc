#include "planner/coordination/missing.hpp"

#include <cmath>
#include <numbers>

namespace hlc {

ConvexPolygon reachable_disc(const MeasuredVehicle& measured, double horizon_s,
                             const MissingVehicleRules& rules) {
  constexpr int kCorners = 8;
  const double radius = rules.max_speed_mps * (measured.age_s + horizon_s) + rules.circumradius_m;
  const double corner_radius = radius / std::cos(std::numbers::pi / kCorners);
  ConvexPolygon octagon;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    octagon.vertices_m.push_back(measured.pose.position_m() +
                                 corner_radius * Point(std::cos(angle), std::sin(angle)));
  }
  return octagon;
}

bool stands_for_good(const MeasuredVehicle& measured, StepIndex now, StepIndex last_heard,
                     std::size_t horizon_steps, const MissingVehicleRules& rules) {
  return measured.age_s <= rules.max_age_s &&
         std::abs(measured.speed_mps) <= rules.standing_speed_mps &&
         now.value > last_heard.value + kSilentSteps + horizon_steps + 1;
}

ConvexPolygon standing_area(const MeasuredVehicle& measured, const MissingVehicleRules& rules) {
  return footprint_area(rules.footprint, measured.pose, rules.safety_margin_m);
}

}  // namespace hlc
