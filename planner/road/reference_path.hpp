#pragma once

#include <cstddef>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc::road {

/// A polyline, parametrised by arc length s [m]; closed paths continue at s = length with s = 0.
class ReferencePath {
 public:
  /// @param points_m  at least 2, no two neighbours equal, all finite; a closed path does not
  /// repeat its first point
  /// @throws std::invalid_argument otherwise
  ReferencePath(std::vector<Point> points_m, bool closed);

  [[nodiscard]] double length_m() const;
  [[nodiscard]] bool is_closed() const { return closed_; }
  [[nodiscard]] const std::vector<Point>& points_m() const { return points_m_; }
  /// Arc length of each point; on a closed path one more: the length, where the first point follows
  /// again.
  [[nodiscard]] const std::vector<double>& joints_s_m() const { return s_m_; }

  /// Point at arc length s: wrapped on a closed path, clamped to the ends of an open one.
  [[nodiscard]] Point at(double s_m) const;
  /// Direction of travel there [rad], in (-pi, pi]: that of the segment; at a joint, of the later
  /// one.
  [[nodiscard]] double heading_rad_at(double s_m) const;

  struct Projection {
    double s_m{};         ///< in [0, length) on a closed path, [0, length] on an open one
    double distance_m{};  ///< to the path; infinite if the point is not finite
  };
  /// Exact nearest point of the whole polyline (the smallest s among equals).
  [[nodiscard]] Projection project(const Point& point_m) const;
  /// Exact nearest point among s in [from_s_m, to_s_m] (wrapped on a closed path, clamped to an
  /// open one; the first on the way among equals): for a vehicle whose place is known, where
  /// another piece of the path runs close by. @pre from_s_m <= to_s_m
  [[nodiscard]] Projection project_within(const Point& point_m, double from_s_m,
                                          double to_s_m) const;

 private:
  [[nodiscard]] double on_path(double s_m) const;
  [[nodiscard]] std::size_t segment_at(double s_m) const;
  /// Nearest point in 0 <= from_s_m <= s <= to_s_m <= length, if nearer than `best`.
  void improve(Projection& best, const Point& point_m, double from_s_m, double to_s_m) const;

  std::vector<Point> points_m_;
  bool closed_;
  std::vector<double> s_m_;
};

/// Distance of two places on a path within which they count as one place of a lane that the path
/// drives more than once, as a random tour does: the lanes of these places are the same or have
/// just begun to part.
inline constexpr double kSameLane_m = 0.01;

/// True if the two places lie on one place of a lane, in the same direction, but more than 0.4 m
/// apart along the path. @pre both arc lengths are on the path
[[nodiscard]] bool drives_again(const ReferencePath& path, double first_s_m, double second_s_m);

/// Direction of the path at arc length s, from the chord `half_chord_m` to either side: that of a
/// single segment jumps at the joints. [rad]
[[nodiscard]] double chord_heading_rad(const ReferencePath& path, double s_m, double half_chord_m);
/// Change of direction per arc length, from two chords of that length. [1/m]
[[nodiscard]] double chord_curvature_per_m(const ReferencePath& path, double s_m, double chord_m);

}  // namespace hlc::road
