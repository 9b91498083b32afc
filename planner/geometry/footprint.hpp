#pragma once

#include "planner/geometry/polygon.hpp"

namespace hlc {

/// A rectangle that a vehicle covers, centred at its reference point, longitudinal axis along the
/// heading.
struct Footprint {
  double length_m{};
  double width_m{};
};

/// Length of the µCar.
inline constexpr double kUcarLength_m = 0.220;

/// How many times as long as the µCar a vehicle is: lengths on the road that were chosen for the
/// µCar are so many times as long for it. Exactly 1 for the µCar.
[[nodiscard]] constexpr double scale_of(const Footprint& footprint) {
  return footprint.length_m / kUcarLength_m;
}

/// The rectangle at `pose`, grown by `margin_m` on every side.
[[nodiscard]] ConvexPolygon footprint_area(const Footprint& footprint, const Pose& pose,
                                           double margin_m = 0.0);

}  // namespace hlc
