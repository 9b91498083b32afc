#pragma once

#include "planner/vehicle/lab_limits.hpp"

namespace hlc::vehicle {

/// The limits of launch_scripts/labs/cpm_lab.yaml, with points twice as far apart.
inline constexpr LabLimits kCpmLab{.curvature_min_per_m = -3.960,
                                   .curvature_max_per_m = 4.316,
                                   .acceleration_max_mps2 = 20.0,
                                   .velocity_mismatch_max_mps = 0.03,
                                   .x_min_m = 0.0,
                                   .x_max_m = 4.5,
                                   .y_min_m = 0.0,
                                   .y_max_m = 4.0,
                                   .point_interval_s = 0.05};

}  // namespace hlc::vehicle
