#include "planner/search/prepared_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "planner/search/frame.hpp"

namespace hlc::branch_and_bound {
namespace {

/// Coordinate of padding: far from everything, and its square is still a number.
constexpr double kFarAwayM = 1e150;

std::size_t padded(std::size_t size) { return (size + kLanes - 1) / kLanes * kLanes; }

template <class T>
void grow(std::vector<T>& values, std::size_t size) {
  if (values.size() < size) values.resize(size);
}

double largest_coordinate(const Point& point_m) {
  return std::max(std::abs(point_m.x()), std::abs(point_m.y()));
}

}  // namespace

void PreparedObstacles::prepare(const HorizonProblem& problem) {
  const std::size_t n = problem.horizon_steps();
  problem_ = &problem;
  num_obstacles_ = 0;
  num_corners_ = 0;
  most_corners_ = 0;
  scale_m_ = 0.0;
  grow(first_obstacle_, n + 1);
  grow(num_segments_, n);
  first_obstacle_[0] = 0;
  if (problem.obstacles_m.empty() && problem.boundary_m.empty()) {
    std::fill_n(first_obstacle_.begin(), n + 1, 0U);
    std::fill_n(num_segments_.begin(), n, 0U);
    return;
  }
  find_reach(problem);
  make_room(problem);
  for (std::size_t step = 1; step <= n; ++step) {
    if (!problem.obstacles_m.empty()) {
      for (const ConvexPolygon& polygon_m : problem.obstacles_m[step - 1]) {
        add_obstacle(polygon_m, reach_[step - 1]);
      }
      pad_step();
    }
    first_obstacle_[step] = static_cast<std::uint32_t>(num_obstacles_);
  }
  add_segments(problem);
}

void PreparedObstacles::find_reach(const HorizonProblem& problem) {
  constexpr double kSlackM = 1e-6;  // rounding must not leave out what only just touches
  const std::size_t n = problem.horizon_steps();
  const Frame start = to_frame(problem.start);
  double farthest_m = 0.0;
  grow(reach_, n);
  for (std::size_t step = 1; step <= n; ++step) {
    const Reach& reach = reachable_.reach(problem.start_trim, step - 1, n - (step - 1));
    HalfPlanes& planes = reach_[step - 1];
    for (std::size_t i = 0; i < kReachDirections.size(); ++i) {
      const auto [x, y] = kReachDirections[i];
      planes.x[i] = start.cos_heading * x - start.sin_heading * y;
      planes.y[i] = start.sin_heading * x + start.cos_heading * y;
      planes.offset[i] = planes.x[i] * start.origin_m.x() + planes.y[i] * start.origin_m.y() +
                         reach.support_m[i] + area_radius_m_ + kSlackM;
    }
    farthest_m = std::max(farthest_m, reach.max_distance_m);
  }
  scale_m_ = largest_coordinate(start.origin_m) + farthest_m + area_radius_m_;
}

void PreparedObstacles::make_room(const HorizonProblem& problem) {
  std::size_t obstacles = 0;
  std::size_t corners = 0;
  for (const auto& step : problem.obstacles_m) {
    obstacles += padded(step.size());
    for (const ConvexPolygon& polygon_m : step) corners += padded(polygon_m.vertices_m.size());
  }
  for (auto* values : {&circle_x_, &circle_y_, &circle_radius_}) grow(*values, obstacles);
  for (auto* values : {&x_, &y_, &normal_x_, &normal_y_, &offset_}) grow(*values, corners);
  grow(obstacles_, obstacles);
  grow(sources_, obstacles);
}

void PreparedObstacles::add_obstacle(const ConvexPolygon& polygon_m, const HalfPlanes& reach) {
  const auto& corners = polygon_m.vertices_m;
  const std::size_t size = corners.size();
  if (size == 0) return;
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (const Point& corner : corners) {
    sum_x += corner.x();
    sum_y += corner.y();
  }
  const double centre_x = sum_x / static_cast<double>(size);
  const double centre_y = sum_y / static_cast<double>(size);
  double radius2 = 0.0;
  for (const Point& corner : corners) {
    const double dx = corner.x() - centre_x;
    const double dy = corner.y() - centre_y;
    radius2 = std::max(radius2, dx * dx + dy * dy);
  }
  const double radius = std::sqrt(radius2);
  for (std::size_t i = 0; i < reach.offset.size(); ++i) {
    if (reach.x[i] * centre_x + reach.y[i] * centre_y - radius > reach.offset[i]) return;
  }

  const std::size_t first = num_corners_;
  num_corners_ += padded(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Point& from = corners[i];
    const Point& to = corners[i + 1 == size ? 0 : i + 1];
    const double along_x = to.x() - from.x();
    const double along_y = to.y() - from.y();
    x_[first + i] = from.x();
    y_[first + i] = from.y();
    normal_x_[first + i] = along_y;
    normal_y_[first + i] = -along_x;
    offset_[first + i] = along_y * from.x() - along_x * from.y();
  }
  for (std::size_t i = first + size; i < num_corners_; ++i) {
    for (auto* values : {&x_, &y_, &normal_x_, &normal_y_, &offset_}) {
      (*values)[i] = (*values)[first];
    }
  }
  circle_x_[num_obstacles_] = centre_x;
  circle_y_[num_obstacles_] = centre_y;
  circle_radius_[num_obstacles_] = radius;
  obstacles_[num_obstacles_] = {static_cast<std::uint32_t>(first),
                                static_cast<std::uint32_t>(size)};
  sources_[num_obstacles_] = &polygon_m;
  ++num_obstacles_;
  most_corners_ = std::max(most_corners_, padded(size));
  scale_m_ = std::max(scale_m_, std::abs(centre_x) + std::abs(centre_y) + radius);
}

void PreparedObstacles::pad_step() {
  for (; num_obstacles_ % kLanes != 0; ++num_obstacles_) {
    circle_x_[num_obstacles_] = kFarAwayM;
    circle_y_[num_obstacles_] = kFarAwayM;
    circle_radius_[num_obstacles_] = 0.0;
  }
}

void PreparedObstacles::add_segments(const HorizonProblem& problem) {
  const std::size_t n = problem.horizon_steps();
  const std::size_t count = problem.boundary_m.size();
  const auto never = static_cast<std::uint32_t>(n);
  grow(first_step_, count);
  grow(segment_source_, count);
  for (auto* values : {&from_x_, &from_y_, &to_x_, &to_y_}) grow(*values, padded(count));
  std::fill_n(num_segments_.begin(), n, 0U);

  const auto is_in_reach = [](const Segment& segment, const HalfPlanes& reach) {
    for (std::size_t i = 0; i < reach.offset.size(); ++i) {
      const double from = reach.x[i] * segment.from_m.x() + reach.y[i] * segment.from_m.y();
      const double to = reach.x[i] * segment.to_m.x() + reach.y[i] * segment.to_m.y();
      if (std::min(from, to) > reach.offset[i]) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t step = 0;
    while (step < never && !is_in_reach(problem.boundary_m[i], reach_[step])) ++step;
    first_step_[i] = step;
    if (step < never) ++num_segments_[step];
  }
  // Counts become ends, by counting on; then each segment takes the next place before its end.
  std::uint32_t total = 0;
  for (std::size_t step = 0; step < n; ++step) {
    total += num_segments_[step];
    num_segments_[step] = total;
  }
  for (std::size_t i = count; i-- > 0;) {
    if (first_step_[i] == never) continue;
    const std::uint32_t place = --num_segments_[first_step_[i]];
    const Segment& segment = problem.boundary_m[i];
    from_x_[place] = segment.from_m.x();
    from_y_[place] = segment.from_m.y();
    to_x_[place] = segment.to_m.x();
    to_y_[place] = segment.to_m.y();
    segment_source_[place] = static_cast<std::uint32_t>(i);
    scale_m_ =
        std::max({scale_m_, largest_coordinate(segment.from_m), largest_coordinate(segment.to_m)});
  }
  for (std::size_t step = 0; step + 1 < n; ++step) num_segments_[step] = num_segments_[step + 1];
  if (n > 0) num_segments_[n - 1] = total;
  for (std::size_t i = total; i < padded(total); ++i) {
    from_x_[i] = to_x_[i] = kFarAwayM;
    from_y_[i] = to_y_[i] = kFarAwayM;
  }
}

void PreparedObstacles::view(Plan& plan) const {
  const std::size_t n = problem_->horizon_steps();
  plan.has_obstacles = num_obstacles_ > 0;
  plan.has_segments = n > 0 && num_segments_[n - 1] > 0;
  plan.first_obstacle = first_obstacle_.data();
  plan.circle_x = circle_x_.data();
  plan.circle_y = circle_y_.data();
  plan.circle_radius = circle_radius_.data();
  plan.obstacles = obstacles_.data();
  plan.obstacle_x = x_.data();
  plan.obstacle_y = y_.data();
  plan.obstacle_normal_x = normal_x_.data();
  plan.obstacle_normal_y = normal_y_.data();
  plan.obstacle_offset = offset_.data();
  plan.num_segments = num_segments_.data();
  plan.from_x = from_x_.data();
  plan.from_y = from_y_.data();
  plan.to_x = to_x_.data();
  plan.to_y = to_y_.data();
  // Far above the rounding of products of coordinates and edges, which are at most twice the
  // scale; far below what matters.
  plan.tolerance = 1e-12 * (1.0 + scale_m_) * (1.0 + scale_m_);
  plan.circle_slack = 1e-9 * (1.0 + scale_m_);
}

const Segment& PreparedObstacles::segment(std::uint32_t item) const {
  return problem_->boundary_m[segment_source_[item]];
}

}  // namespace hlc::branch_and_bound
