#include "planner/road/lap.hpp"

#include <cmath>

namespace hlc::road {
namespace {

constexpr double kSlack_m = 0.1;

/// The difference of two arc lengths on a closed path with the smallest absolute value.
double shortest(double difference_m, double length_m) {
  return difference_m - length_m * std::round(difference_m / length_m);
}

/// The projection on the whole path; of the places of a lane that the path drives more than once
/// the first.
ReferencePath::Projection first_projection(const ReferencePath& path, const Point& position_m) {
  constexpr double kWindow_m = 0.2;
  const ReferencePath::Projection nearest = path.project(position_m);
  for (int i = 0; i * kWindow_m < nearest.s_m - kWindow_m; ++i) {
    const double s_m = i * kWindow_m;
    const ReferencePath::Projection one =
        path.project_within(position_m, s_m - kWindow_m, s_m + kWindow_m);
    if (one.distance_m < nearest.distance_m + kSameLane_m &&
        drives_again(path, one.s_m, nearest.s_m)) {
      return path.project_within(position_m, one.s_m - kWindow_m, one.s_m + kWindow_m);
    }
  }
  return nearest;
}

}  // namespace

Progress progress_along(const ReferencePath& path, std::span<const Point> positions_m) {
  Progress progress;
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    if (i == 0) {
      const ReferencePath::Projection first = first_projection(path, positions_m[0]);
      progress.s_m.push_back(first.s_m);
      progress.distance_m.push_back(first.distance_m);
      continue;
    }
    const double before_m = progress.s_m.back();
    const double reach_m = 2.0 * (positions_m[i] - positions_m[i - 1]).norm() + kSlack_m;
    const ReferencePath::Projection next =
        path.project_within(positions_m[i], before_m - reach_m, before_m + reach_m);
    const double moved_m =
        path.is_closed() ? shortest(next.s_m - before_m, path.length_m()) : next.s_m - before_m;
    progress.s_m.push_back(before_m + moved_m);
    progress.distance_m.push_back(next.distance_m);
  }
  return progress;
}

std::optional<double> lap_s(const ReferencePath& path, const Progress& progress,
                            std::span<const double> times_s, std::size_t first) {
  if (!path.is_closed()) {
    return std::nullopt;
  }
  for (std::size_t i = first + 1; i < progress.s_m.size(); ++i) {
    const double goal_m = progress.s_m[first] + path.length_m();
    if (progress.s_m[i] >= goal_m) {
      const double part = (goal_m - progress.s_m[i - 1]) / (progress.s_m[i] - progress.s_m[i - 1]);
      return times_s[i - 1] + part * (times_s[i] - times_s[i - 1]) - times_s[first];
    }
  }
  return std::nullopt;
}

}  // namespace hlc::road
