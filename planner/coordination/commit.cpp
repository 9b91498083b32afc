#include "planner/coordination/commit.hpp"

#include <algorithm>

namespace hlc::coordination {
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

CommitVerdict commit_strictly(const CommitInputs& inputs) {
  for (const CoupledAreas& other : inputs.coupled) {
    if (other.predicted != nullptr) {
      if (!are_free(*inputs.planned, *other.predicted, inputs.from, inputs.steps)) {
        return CommitVerdict::kConflict;
      }
    } else if (!are_free(*inputs.planned, *other.reachable_area_m, inputs.from, inputs.steps)) {
      return CommitVerdict::kNotReceived;
    }
  }
  return CommitVerdict::kInForce;
}

CommitVerdict commit_by_votes(const CommitInputs& inputs) {
  const bool all_agree = std::ranges::all_of(
      inputs.votes, [](const Outcome* vote) { return vote != nullptr && !vote->wants_fallback; });
  return all_agree ? CommitVerdict::kInForce : CommitVerdict::kFallback;
}

}  // namespace hlc::coordination
