#include "planner/coordination/messages.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

namespace hlc::coordination {
namespace {

bool are_well_formed(const OccupiedAreas& areas, StepIndex first) {
  return areas.first == first && !areas.final_area_m.empty() &&
         std::ranges::none_of(areas.areas_m, &ConvexPolygon::empty);
}

/// Not a number compares false.
bool is_well_formed(const LaneClaim& claim) {
  return claim.place_m >= 0.0 && claim.place_m <= kLargestCoordinate_m && claim.ahead_m >= 0.0 &&
         claim.ahead_m <= kLargestCoordinate_m;
}

}  // namespace

bool is_well_formed(const Traffic& traffic) {
  return !traffic.reachable_area_m.empty() && are_well_formed(traffic.running, traffic.step) &&
         std::ranges::none_of(traffic.reference_areas_m, &ConvexPolygon::empty) &&
         (!traffic.claim || is_well_formed(*traffic.claim));
}

bool is_well_formed(const Prediction& prediction) {
  const StepIndex next{prediction.step.value + 1};
  return are_well_formed(prediction.areas, next) &&
         (!prediction.desired || are_well_formed(*prediction.desired, next));
}

const ConvexPolygon& OccupiedAreas::during(StepIndex step) const {
  HLC_DEMAND(step >= first, step, first);
  const std::uint64_t offset = step.value - first.value;
  return offset < areas_m.size() ? areas_m[offset] : final_area_m;
}

}  // namespace hlc::coordination
