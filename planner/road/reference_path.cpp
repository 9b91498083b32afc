#include "planner/road/reference_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace hlc::road {
namespace {

/// Above the rounding of a distance.
constexpr double kRounding_m = 1e-9;

/// The representative of s in [0, length).
double wrapped(double s_m, double length_m) {
  if (s_m >= 0.0 && s_m < length_m) return s_m;
  const double rest_m = std::fmod(s_m, length_m);
  const double positive_m = rest_m < 0.0 ? rest_m + length_m : rest_m;
  return positive_m < length_m ? positive_m : 0.0;  // -1e-20 + length rounds to length
}

}  // namespace

ReferencePath::ReferencePath(std::vector<Point> points_m, bool closed)
    : points_m_(std::move(points_m)), closed_(closed) {
  if (points_m_.size() < 2) {
    throw std::invalid_argument(
        fmt::format("reference path: {} points, must be at least 2", points_m_.size()));
  }
  const std::size_t segments = closed_ ? points_m_.size() : points_m_.size() - 1;
  s_m_.reserve(segments + 1);
  s_m_.push_back(0.0);
  for (std::size_t i = 0; i < segments; ++i) {
    const double length = (points_m_[(i + 1) % points_m_.size()] - points_m_[i]).norm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw std::invalid_argument(
          fmt::format("reference path: distance of point {} to the next is {:f} m, must be finite "
                      "and larger than 0",
                      i, length));
    }
    s_m_.push_back(s_m_.back() + length);
  }
}

double ReferencePath::length_m() const { return s_m_.back(); }

std::size_t ReferencePath::segment_at(double s_m) const {
  const auto above = std::upper_bound(s_m_.begin() + 1, s_m_.end() - 1, s_m);
  return static_cast<std::size_t>(above - s_m_.begin()) - 1;
}

double ReferencePath::on_path(double s_m) const {
  return closed_ ? wrapped(s_m, length_m()) : std::clamp(s_m, 0.0, length_m());
}

Point ReferencePath::at(double s_m) const {
  const double s = on_path(s_m);
  const std::size_t i = segment_at(s);
  const double t = (s - s_m_[i]) / (s_m_[i + 1] - s_m_[i]);
  return (1.0 - t) * points_m_[i] + t * points_m_[(i + 1) % points_m_.size()];
}

double ReferencePath::heading_rad_at(double s_m) const {
  const std::size_t i = segment_at(on_path(s_m));
  const Point along_m = points_m_[(i + 1) % points_m_.size()] - points_m_[i];
  return std::atan2(along_m.y(), along_m.x());
}

void ReferencePath::improve(Projection& best, const Point& point_m, double from_s_m,
                            double to_s_m) const {
  const std::size_t first = segment_at(from_s_m);
  // The nearest joint determines which segments need to be checked.
  double squared_m2 = best.distance_m * best.distance_m;
  for (std::size_t i = first; i < points_m_.size() && s_m_[i] <= to_s_m; ++i) {
    if (s_m_[i] < from_s_m) continue;
    squared_m2 = std::min(squared_m2, (point_m - points_m_[i]).squaredNorm());
  }
  const double reach_m = std::sqrt(squared_m2) + kRounding_m;
  for (std::size_t i = first; i + 1 < s_m_.size() && s_m_[i] <= to_s_m; ++i) {
    const Point& a = points_m_[i];
    const double length = s_m_[i + 1] - s_m_[i];
    // No point of the segment is nearer than its begin by more than its length.
    const double near_m = reach_m + length;
    if ((point_m - a).squaredNorm() > near_m * near_m) continue;
    const Point& b = points_m_[(i + 1) % points_m_.size()];
    const double t_min = std::max(0.0, (from_s_m - s_m_[i]) / length);
    const double t_max = std::min(1.0, (to_s_m - s_m_[i]) / length);
    const double t =
        std::clamp((point_m - a).dot(b - a) / (b - a).squaredNorm(), t_min, std::max(t_min, t_max));
    // Both ends without rounding: at a joint the two segments then agree, and the smaller s stays.
    const Point foot_m = t == 0.0 ? a : t == 1.0 ? b : Point((1.0 - t) * a + t * b);
    const double distance_m = (point_m - foot_m).norm();
    if (distance_m < best.distance_m) {
      best = {.s_m = t == 1.0 ? s_m_[i + 1] : s_m_[i] + t * length, .distance_m = distance_m};
    }
  }
}

ReferencePath::Projection ReferencePath::project(const Point& point_m) const {
  return project_within(point_m, 0.0, length_m());
}

ReferencePath::Projection ReferencePath::project_within(const Point& point_m, double from_s_m,
                                                        double to_s_m) const {
  const double length = length_m();
  Projection best{.s_m = on_path(from_s_m), .distance_m = std::numeric_limits<double>::infinity()};
  if (!closed_) {
    improve(best, point_m, on_path(from_s_m), on_path(to_s_m));
    return best;
  }
  if (to_s_m - from_s_m >= length) {
    improve(best, point_m, 0.0, length);
  } else {
    const double from = on_path(from_s_m);
    const double to = from + (to_s_m - from_s_m);
    improve(best, point_m, from, std::min(to, length));
    if (to > length) {
      improve(best, point_m, 0.0, to - length);
    }
  }
  best.s_m = on_path(best.s_m);
  return best;
}

bool drives_again(const ReferencePath& path, double first_s_m, double second_s_m) {
  constexpr double kApart_m = 0.4;
  constexpr double kSameHeading_rad = 0.3;
  const double ahead_m = std::abs(first_s_m - second_s_m);
  const double apart_m = path.is_closed() ? std::min(ahead_m, path.length_m() - ahead_m) : ahead_m;
  if (apart_m <= kApart_m) return false;
  const double turned_rad =
      wrap_angle(path.heading_rad_at(first_s_m) - path.heading_rad_at(second_s_m));
  return std::abs(turned_rad) < kSameHeading_rad &&
         (path.at(first_s_m) - path.at(second_s_m)).norm() < kSameLane_m;
}

double chord_heading_rad(const ReferencePath& path, double s_m, double half_chord_m) {
  const Point chord_m = path.at(s_m + half_chord_m) - path.at(s_m - half_chord_m);
  return std::atan2(chord_m.y(), chord_m.x());
}

double chord_curvature_per_m(const ReferencePath& path, double s_m, double chord_m) {
  const double half_m = chord_m / 2.0;
  const double turned_rad =
      chord_heading_rad(path, s_m + half_m, half_m) - chord_heading_rad(path, s_m - half_m, half_m);
  return wrap_angle(turned_rad) / chord_m;
}

}  // namespace hlc::road
