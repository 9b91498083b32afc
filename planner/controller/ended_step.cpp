#include "planner/controller/ended_step.hpp"

#include <algorithm>

namespace hlc::controller {
namespace {

bool meets(const OtherVehicle& other, const ConvexPolygon& area_m, std::size_t j, StepIndex step) {
  const auto is_met = [&](const ConvexPolygon& one) { return intersects(one, area_m); };
  if (j < other.areas_m.size() && std::ranges::any_of(other.areas_m[j], is_met)) return true;
  if (!other.compared) return false;
  const auto& [reachable_area_m, predicted] = *other.compared;
  return is_met(predicted != nullptr ? predicted->during(step) : *reachable_area_m);
}

}  // namespace

std::optional<StepIndex> stops_in(const OtherVehicle& other,
                                  const coordination::OccupiedAreas& motion,
                                  const EndedStep& step) {
  if (other.prevents_all()) return step.next();
  for (std::size_t j = 0; j < step.horizon_steps; ++j) {
    const StepIndex during{step.next().value + j};
    if (meets(other, motion.during(during), j, during)) return during;
  }
  return std::nullopt;
}

}  // namespace hlc::controller
