#pragma once

#include <cstddef>
#include <vector>

#include "planner/road/reference_path.hpp"

namespace hlc {

/// How the reference points of a plan are spaced: by the rule under which the paper's numbers
/// arose, or by its authors' later one.
enum class ReferenceRule {
  kLater,  ///< first step with the mean of current and reference speed, then the reference speed
  k2022,   ///< reference speed for all steps but the last, which is halved; current speed ignored
};

/// Reference of one plan: r_1 ... r_n and the speed that belongs to each step.
struct Reference {
  std::vector<Point> points_m;
  std::vector<double> speeds_mps;
};

/// Points on the path, marched from arc length `start_s_m` by speed * step_s per step.
/// @pre horizon_steps >= 1, step_s > 0, reference_speed_mps >= 0
[[nodiscard]] Reference reference_points(const ReferencePath& path, double start_s_m,
                                         double current_speed_mps, double reference_speed_mps,
                                         std::size_t horizon_steps, double step_s,
                                         ReferenceRule rule);

}  // namespace hlc
