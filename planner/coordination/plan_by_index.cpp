#include "planner/coordination/plan_by_index.hpp"

#include <algorithm>
#include <functional>

namespace hlc::coordination {
namespace {

std::optional<std::uint32_t> index_of(const automaton::Maneuver& maneuver,
                                      const automaton::UniversalAutomaton& automaton) {
  const automaton::Maneuver* const first = automaton.maneuvers.data();
  const std::less<> before;
  if (before(&maneuver, first) || !before(&maneuver, first + automaton.maneuvers.size())) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(&maneuver - first);
}

}  // namespace

std::optional<PlanByIndex> by_index(const Plan& plan, StepIndex from,
                                    const automaton::UniversalAutomaton& automaton) {
  PlanByIndex result{.first = std::max(plan.first(), from), .poses = {}, .maneuvers = {}};
  const StepIndex end = std::max(plan.end(), result.first);
  const std::optional<std::uint32_t> standstill = index_of(plan.maneuver_during(end), automaton);
  if (!standstill) return std::nullopt;
  result.standstill = *standstill;
  for (StepIndex step = result.first; step < end; ++step.value) {
    const std::optional<std::uint32_t> index = index_of(plan.maneuver_during(step), automaton);
    if (!index) return std::nullopt;
    result.poses.push_back(plan.pose_at(step));
    result.maneuvers.push_back(*index);
  }
  result.poses.push_back(plan.pose_at(end));
  return result;
}

std::optional<Plan> plan_of(const PlanByIndex& plan,
                            const std::shared_ptr<const automaton::UniversalAutomaton>& automaton) {
  const std::vector<automaton::Maneuver>& all = automaton->maneuvers;
  const auto exists = [&all](std::uint32_t index) { return index < all.size(); };
  if (!exists(plan.standstill) || !std::ranges::all_of(plan.maneuvers, exists)) {
    return std::nullopt;
  }
  const automaton::Maneuver& standstill = all[plan.standstill];
  if (standstill.from != standstill.to ||
      !automaton->trims[standstill.from.index].is_equilibrium()) {
    return std::nullopt;
  }
  std::vector<const automaton::Maneuver*> maneuvers;
  maneuvers.reserve(plan.maneuvers.size());
  for (const std::uint32_t index : plan.maneuvers) {
    if (!maneuvers.empty() && maneuvers.back()->to != all[index].from) return std::nullopt;
    maneuvers.push_back(&all[index]);
  }
  if (!maneuvers.empty() && maneuvers.back()->to != standstill.from) return std::nullopt;
  return Plan(plan.first, plan.poses, maneuvers, standstill, automaton);
}

}  // namespace hlc::coordination
