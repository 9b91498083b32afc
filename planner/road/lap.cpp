#include "planner/road/lap.hpp"

#include <cmath>

namespace hlc::road {
namespace {

constexpr double kSlack_m = 0.1;

/// The difference of two arc lengths on a closed path with the smallest absolute value.
double shortest(double difference_m, double length_m) {
  return difference_m - length_m * std::round(difference_m / length_m);
}

}  // namespace

Progress progress_along(const ReferencePath& path, std::span<const Point> positions_m) {
  Progress progress;
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    if (i == 0) {
      const ReferencePath::Projection first = path.project(positions_m[0]);
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
