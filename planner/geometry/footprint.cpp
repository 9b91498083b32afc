#include "planner/geometry/footprint.hpp"

namespace hlc {

ConvexPolygon footprint_area(const Footprint& footprint, const Pose& pose, double margin_m) {
  const double half_length = 0.5 * footprint.length_m + margin_m;
  const double half_width = 0.5 * footprint.width_m + margin_m;
  return transformed(ConvexPolygon{{{-half_length, -half_width},
                                    {half_length, -half_width},
                                    {half_length, half_width},
                                    {-half_length, half_width}}},
                     pose);
}

}  // namespace hlc
