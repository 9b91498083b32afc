#include "planner/road/curvature_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace hlc::road {
namespace {
constexpr double kMaxStep_m = 0.005;
}

CurvatureCurve::CurvatureCurve(const Pose& start, std::vector<Knot> knots)
    : knots_(std::move(knots)), poses_{start} {
  if (knots_.size() < 2 || knots_.front().s_m != 0.0) {
    throw std::invalid_argument("curvature curve: must have at least 2 knots, the first at s = 0");
  }
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const double length_m = knots_[i + 1].s_m - knots_[i].s_m;
    if (!(length_m > 0.0)) {
      throw std::invalid_argument(fmt::format(
          "curvature curve: s of knot {} must be larger than that of the knot before", i + 1));
    }
    poses_.push_back(after_knot(i, length_m));
  }
}

Pose CurvatureCurve::at(double s_m) const {
  std::size_t i = 0;
  while (i + 2 < knots_.size() && knots_[i + 1].s_m <= s_m) {
    ++i;
  }
  return after_knot(i, s_m - knots_[i].s_m);
}

Pose CurvatureCurve::after_knot(std::size_t i, double distance_m) const {
  const Pose& begin = poses_[i];
  const double kappa = knots_[i].curvature_per_m;
  const double slope =
      (knots_[i + 1].curvature_per_m - kappa) / (knots_[i + 1].s_m - knots_[i].s_m);
  const auto heading = [&](double s) {
    return begin.heading_rad + kappa * s + slope * s * s / 2.0;
  };
  const auto direction = [&](double s) {
    return Point(std::cos(heading(s)), std::sin(heading(s)));
  };
  const int steps = std::max(1, static_cast<int>(std::ceil(distance_m / kMaxStep_m)));
  const double h = distance_m / steps;
  Point position = begin.position_m();
  for (int k = 0; k < steps; ++k) {
    position +=
        h / 6.0 * (direction(k * h) + 4.0 * direction((k + 0.5) * h) + direction((k + 1) * h));
  }
  return {.x_m = position.x(), .y_m = position.y(), .heading_rad = heading(distance_m)};
}

}  // namespace hlc::road
