#include "planner/coordination/settle.hpp"

#include <algorithm>

namespace hlc {
namespace {

template <class AreaAt>
bool free_step_by_step(const OccupiedAreas& a, AreaAt area_at, StepIndex from, std::size_t steps) {
  for (std::size_t i = 0; i < steps; ++i) {
    const StepIndex step{from.value + i};
    if (intersects(a.during(step), area_at(step))) return false;
  }
  return true;
}

}  // namespace

bool are_free(const OccupiedAreas& a, const OccupiedAreas& b, StepIndex from, std::size_t steps) {
  return free_step_by_step(
      a, [&b](StepIndex step) -> const ConvexPolygon& { return b.during(step); }, from, steps);
}

bool are_free(const OccupiedAreas& a, const ConvexPolygon& area_m, StepIndex from,
              std::size_t steps) {
  return free_step_by_step(
      a, [&area_m](StepIndex) -> const ConvexPolygon& { return area_m; }, from, steps);
}

SettleVerdict settle_strictly(const OccupiedAreas& planned, std::span<const HeardCoupled> coupled,
                              StepIndex from, std::size_t steps) {
  for (const HeardCoupled& other : coupled) {
    if (other.predicted != nullptr) {
      if (!are_free(planned, *other.predicted, from, steps)) return SettleVerdict::kConflict;
    } else if (!are_free(planned, *other.reachable_area_m, from, steps)) {
      return SettleVerdict::kUnheard;
    }
  }
  return SettleVerdict::kInForce;
}

SettleVerdict settle_by_votes(std::span<const Outcome* const> votes) {
  const bool all_agree = std::ranges::all_of(
      votes, [](const Outcome* vote) { return vote != nullptr && !vote->wants_fallback; });
  return all_agree ? SettleVerdict::kInForce : SettleVerdict::kFallback;
}

}  // namespace hlc
