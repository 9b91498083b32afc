#pragma once

#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc::road {

/// A curve given by its curvature kappa(s), piecewise linear in the arc length s between knots:
///
///     heading(s)  = heading(0) + integral_0^s kappa,
///     position(s) = position(0) + integral_0^s (cos heading, sin heading).
///
/// The heading is exact; the position comes from Simpson's rule with steps of at most 5 mm (error
/// below 1e-8 m on 12 m with curvatures up to 4 1/m).
class CurvatureCurve {
 public:
  struct Knot {
    double s_m{};
    double curvature_per_m{};  ///< positive: to the left
  };

  /// @param start  pose at s = 0
  /// @param knots  at least 2, the first at s = 0, s ascending
  /// @throws std::invalid_argument otherwise
  CurvatureCurve(const Pose& start, std::vector<Knot> knots);

  [[nodiscard]] double length_m() const { return knots_.back().s_m; }
  /// Pose on the curve, heading along it, not wrapped. @pre 0 <= s_m <= length_m()
  [[nodiscard]] Pose at(double s_m) const;

 private:
  /// Pose `distance_m` after knot `i`. @pre at most up to knot i + 1
  [[nodiscard]] Pose after_knot(std::size_t i, double distance_m) const;

  std::vector<Knot> knots_;
  std::vector<Pose> poses_;  ///< at the knots
};

}  // namespace hlc::road
