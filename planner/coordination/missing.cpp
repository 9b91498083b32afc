#include "planner/coordination/missing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hlc::coordination {

ConvexPolygon reachable_disc(const MeasuredVehicle& measured, double horizon_s,
                             const MissingVehicleRules& rules) {
  constexpr int kCorners = 8;
  const double radius =
      rules.max_speed_mps * (std::max(measured.age_s, 0.0) + horizon_s) + rules.circumradius_m;
  const double corner_radius = radius / std::cos(std::numbers::pi / kCorners);
  ConvexPolygon octagon;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    octagon.vertices_m.push_back(measured.pose.position_m() +
                                 corner_radius * Point(std::cos(angle), std::sin(angle)));
  }
  return octagon;
}

bool is_seen_standing(const MeasuredVehicle& measured, const MissingVehicleRules& rules) {
  return measured.age_s <= kMaxStateAge_s &&
         std::abs(measured.speed_mps) <= rules.standing_speed_mps;
}

bool stands_for_good(const Silence& silence, std::size_t horizon_steps) {
  const std::uint64_t longest = kSilentSteps + horizon_steps + 1;
  return silence.now.value > silence.last_sign_of_life.value + longest &&
         silence.now.value > silence.last_not_standing.value + longest;
}

ConvexPolygon standing_area(const MeasuredVehicle& measured, const MissingVehicleRules& rules) {
  return footprint_area(rules.footprint, measured.pose, rules.safety_margin_m);
}

}  // namespace hlc::coordination
