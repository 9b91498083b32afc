#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "planner/controller/controller.hpp"

namespace hlc {

/// What was said in a step; the controller's own messages may be among it.
struct HeardInStep {
  std::vector<Traffic> traffic;
  std::vector<Prediction> predictions;
};

struct RehearsalSettings {
  std::size_t steps{8};
  std::vector<PlanningWeight> criterion_weights;
  std::size_t max_expansions{};  ///< of each search
};

/// Called before each step of a rehearsal with the controller that is stepped.
using BeforeStep = std::function<void(Controller&)>;

/// What the vehicle would drive in the next steps, in a closed loop: the controller is stepped as
/// ever, its vehicle follows the plan exactly, and the other vehicles drive what they told in the
/// last step, and then stand, as every controller reckons with.
///
/// The cost of a step is what planning goes by, of what is driven:
///
///     c_k = |p(k+2) - r_k|^2 + sum_c w_c c(e_k)   [m^2]
///
/// with p(k+2) the planned position at t(k+2), r_k the point of the path at the arc length of
/// p(k+1) plus reference_speed * step, e_k the maneuver between the two, and w_c its weights.
///
/// @param controller  after a step; it stays as it is
/// @param heard       of that step. The others are those that it holds traffic of; of predictions
/// only those count that the controller waited for, so that it does not matter which others came
/// @param before_step  may switch the controller that is stepped
/// @return sum of c_k over the steps; 0 for a controller without a plan or a place on its path
[[nodiscard]] double rehearsed_cost_m2(const Controller& controller, const HeardInStep& heard,
                                       const RehearsalSettings& settings,
                                       const BeforeStep& before_step);

}  // namespace hlc
