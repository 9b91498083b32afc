#pragma once

#include <memory>
#include <optional>

#include "planner/coordination/plan.hpp"
#include "planner/coordination/planning_input.hpp"

namespace hlc::coordination {

/// The plan from t(from) on, or all of it if it begins later. None: it has a maneuver of another
/// automaton.
[[nodiscard]] std::optional<PlanByIndex> by_index(const Plan& plan, StepIndex from,
                                                  const automaton::UniversalAutomaton& automaton);

/// The same plan again, bit for bit: plans that continue it agree, too. None: an index does not
/// exist, or maneuvers do not follow each other, or it does not end in a standstill.
/// @pre is_well_formed (of the planning input)
[[nodiscard]] std::optional<Plan> plan_of(
    const PlanByIndex& plan, const std::shared_ptr<const automaton::UniversalAutomaton>& automaton);

}  // namespace hlc::coordination
