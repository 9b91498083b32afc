#pragma once

#include <cstddef>

#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Straight on at 0.8 m/s from (1 m, 2 m) and the paper's pi_7, reference speeds too; nothing is in
/// the way.
[[nodiscard]] search::HorizonProblem straight_problem(std::size_t horizon_steps);

/// A rectangle along the axes.
[[nodiscard]] ConvexPolygon box(double min_x_m, double max_x_m, double min_y_m, double max_y_m);

}  // namespace hlc::test
