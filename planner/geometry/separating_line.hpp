#pragma once

#include <optional>

#include "planner/geometry/polygon.hpp"

namespace hlc {

/// A line with a side: with n = (cos direction_rad, sin direction_rad), points p with
/// n . p <= offset_m lie behind it, those with n . p >= offset_m beyond it.
struct SeparatingLine {
  double direction_rad{};  ///< in [-pi, pi], map frame
  double offset_m{};
  friend bool operator==(const SeparatingLine&, const SeparatingLine&) = default;
};

/// A gap this wide is as good as a wider one: far above what rounding moves a line or a corner by.
inline constexpr double kWideGap_m = 0.01;

/// The line through a corner of `behind`, all of which lies behind it, with a gap to `beyond`,
/// which lies beyond it: the separating axis theorem, over the normals of the edges of both, O((m +
/// n)^2). Its direction is the first one with a gap of at least kWideGap_m, or that with the
/// largest gap. None: the polygons overlap by more than `tolerance_m` in every such direction, or
/// one is empty.
/// @pre tolerance_m >= 0
[[nodiscard]] std::optional<SeparatingLine> separating_line(const ConvexPolygon& behind,
                                                            const ConvexPolygon& beyond,
                                                            double tolerance_m);

}  // namespace hlc
