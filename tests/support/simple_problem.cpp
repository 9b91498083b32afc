#include "tests/support/simple_problem.hpp"

namespace hlc::test {

search::HorizonProblem straight_problem(std::size_t horizon_steps) {
  search::HorizonProblem problem;
  problem.start = {1.0, 2.0, 0.0};
  problem.start_trim = TrimId{6};
  for (std::size_t j = 1; j <= horizon_steps; ++j) {
    problem.reference_m.emplace_back(1.0 + 0.16 * static_cast<double>(j), 2.0);
  }
  problem.reference_speed_mps.assign(horizon_steps, 0.8);
  return problem;
}

ConvexPolygon box(double min_x_m, double max_x_m, double min_y_m, double max_y_m) {
  return convex_hull(
      {{min_x_m, min_y_m}, {max_x_m, min_y_m}, {max_x_m, max_y_m}, {min_x_m, max_y_m}});
}

}  // namespace hlc::test
