#include "planner/search/prepared_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace hlc::branch_and_bound {
namespace {

// The kernel reads corners and boundaries as they lie in memory.
static_assert(sizeof(Point) == 2 * sizeof(double));
static_assert(sizeof(Segment) == 4 * sizeof(double) && std::is_standard_layout_v<Segment>);

std::size_t padded(std::size_t size) { return (size + kLanes - 1) / kLanes * kLanes; }

template <class T>
void grow(std::vector<T>& values, std::size_t size) {
  if (values.size() < size) values.resize(size);
}

}  // namespace

void PreparedObstacles::list(const HorizonProblem& problem, Plan& plan) {
  const std::size_t n = problem.horizon_steps();
  problem_ = &problem;
  list_polygons();

  grow(reach_, n);
  for (std::size_t step = 0; step < n; ++step) {
    reach_[step] = tables_.reach(problem.start_trim, step, n - step);
  }
  grow(first_obstacle_, n + 1);
  // Every step's obstacles are padded.
  const std::size_t num_obstacles = polygons_.size() + n * (kLanes - 1);
  grow(obstacles_, num_obstacles);
  grow(circles_, 3 * num_obstacles);
  const std::size_t corners =
      polygons_.empty() ? 0 : padded(polygons_.back().first + polygons_.back().size);
  grow(corners_, 5 * corners);
  const std::size_t segments = padded(problem.boundary_m.size());
  grow(segment_source_, segments);
  grow(segments_, 4 * segments);
  const std::size_t blocks = padded(segments / kLanes);
  grow(blocks_, 5 * blocks);

  plan.horizon_steps = n;
  plan.polygons = polygons_.data();
  plan.num_polygons = polygons_.size();
  plan.boundary = problem.boundary_m.empty() ? nullptr : problem.boundary_m.front().from_m.data();
  plan.boundary_size = problem.boundary_m.size();
  plan.reach = reach_.data();
  plan.scale = std::abs(problem.start.x_m) + std::abs(problem.start.y_m) + tables_.reach_m(n);
  plan.first_obstacle = first_obstacle_.data();
  plan.obstacles = obstacles_.data();
  plan.circle_x = circles_.data();
  plan.circle_y = plan.circle_x + num_obstacles;
  plan.circle_radius = plan.circle_y + num_obstacles;
  plan.obstacle_x = corners_.data();
  plan.obstacle_y = plan.obstacle_x + corners;
  plan.obstacle_normal_x = plan.obstacle_y + corners;
  plan.obstacle_normal_y = plan.obstacle_normal_x + corners;
  plan.obstacle_offset = plan.obstacle_normal_y + corners;
  plan.segment_source = segment_source_.data();
  plan.from_x = segments_.data();
  plan.from_y = plan.from_x + segments;
  plan.to_x = plan.from_y + segments;
  plan.to_y = plan.to_x + segments;
  plan.block_x = blocks_.data();
  plan.block_y = plan.block_x + blocks;
  plan.block_half_x = plan.block_y + blocks;
  plan.block_half_y = plan.block_half_x + blocks;
  plan.block_half_width = plan.block_half_y + blocks;
}

void PreparedObstacles::list_polygons() {
  polygons_.clear();
  sources_.clear();
  most_corners_ = 0;
  std::size_t first = 0;
  for (std::size_t step = 0; step < problem_->obstacles_m.size(); ++step) {
    for (const ConvexPolygon& polygon_m : problem_->obstacles_m[step]) {
      const std::size_t size = polygon_m.vertices_m.size();
      if (size == 0) continue;
      polygons_.push_back({polygon_m.vertices_m.front().data(), static_cast<std::uint32_t>(size),
                           static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(first)});
      sources_.push_back(&polygon_m);
      first += padded(size);
      most_corners_ = std::max(most_corners_, padded(size));
    }
  }
}

}  // namespace hlc::branch_and_bound
