#include "planner/coordination/messages.hpp"

#include <cassert>

namespace hlc {

const ConvexPolygon& OccupiedAreas::during(StepIndex step) const {
  assert(step >= first);
  const std::uint64_t offset = step.value - first.value;
  return offset < areas_m.size() ? areas_m[offset] : final_area_m;
}

}  // namespace hlc
