#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/policy/subgraph_selector.hpp"
#include "vehicle_sim/apps/explanation.hpp"

/// What a controller's step answers after it by searches of its own problem: nothing is driven.
namespace hlc::apps {

/// Way that the plan in force leads from t(k+1) on; 0 without a plan.
[[nodiscard]] double ahead_m(const controller::Controller& controller);

/// Who asked for the subgraph in force, and for which: "rule 2 of policy mixed (J2, labels
/// comfort)"; "the fork's request (...)", as a drive has no other operator; empty: nobody, it is
/// the scenario's own.
/// @param policy  name of the policy in force
[[nodiscard]] std::string request_name(const policy::SubgraphSelector& chosen,
                                       const std::string& policy);
/// The zone whose limit holds: "zone 1 of policy mixed (at most 0.6 m/s)"; empty: none.
[[nodiscard]] std::string zone_name(const policy::SubgraphSelector& chosen,
                                    const std::string& policy);

/// ExplainedStep::choice, limits and alone of a step.
struct StepAnswers {
  std::optional<ExplainedStep::Choice> choice;
  std::vector<ExplainedStep::Limit> limits;
  std::optional<ExplainedStep::Limit> alone;
};

/// @param controller  after the last phase of the step
/// @param chosen      of that controller, since when nothing changed
/// @param report      of the step
/// @param policy      name of the policy in force
/// @return nothing where the step's plan does not follow from the step's search: none was made, the
/// plan found did not come into force, or the budget ended a search
[[nodiscard]] StepAnswers answers_of(const controller::Controller& controller,
                                     const policy::SubgraphSelector& chosen,
                                     const coordination::Report& report, const std::string& policy);

}  // namespace hlc::apps
