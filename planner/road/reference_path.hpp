#pragma once

#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc {

/// A polyline, parametrised by arc length s [m]; closed paths continue at s = length with s = 0.
class ReferencePath {
 public:
  /// @param points_m  at least 2, no two neighbours equal; a closed path does not repeat its first point
  /// @throws std::invalid_argument otherwise
  ReferencePath(std::vector<Point> points_m, bool closed);

  [[nodiscard]] double length_m() const;
  [[nodiscard]] bool is_closed() const { return closed_; }
  [[nodiscard]] const std::vector<Point>& points_m() const { return points_m_; }

  /// Point at arc length s: wrapped on a closed path, clamped to the ends of an open one.
  [[nodiscard]] Point at(double s_m) const;
  /// Direction of travel there [rad].
  [[nodiscard]] double heading_rad_at(double s_m) const;

  struct Projection {
    double s_m{};        ///< in [0, length)
    double distance_m{}; ///< to the path
  };
  /// Exact nearest point of the whole polyline (the smallest s among equals).
  [[nodiscard]] Projection project(const Point& point_m) const;
  /// Exact nearest point among s in [from_s_m, to_s_m] (wrapped on a closed path): for a vehicle whose
  /// place is known, where another piece of the path runs close by. @pre from_s_m <= to_s_m
  [[nodiscard]] Projection project_within(const Point& point_m, double from_s_m, double to_s_m) const;

 private:
  std::vector<Point> points_m_;
  bool closed_;
  std::vector<double> s_m_;
};

}  // namespace hlc
