#pragma once

#include "planner/geometry/polygon.hpp"

namespace hlc {

/// A rectangle that a vehicle covers, centred at its reference point, longitudinal axis along the
/// heading.
struct Footprint {
  double length_m{};
  double width_m{};
};

/// The rectangle at `pose`, grown by `margin_m` on every side.
[[nodiscard]] ConvexPolygon footprint_area(const Footprint& footprint, const Pose& pose,
                                           double margin_m = 0.0);

}  // namespace hlc
