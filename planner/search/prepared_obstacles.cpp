#include "planner/search/prepared_obstacles.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>

namespace hlc::branch_and_bound {
namespace {

// The kernel reads corners and boundaries as they lie in memory.
static_assert(sizeof(Point) == 2 * sizeof(double));
static_assert(sizeof(Segment) == 4 * sizeof(double) && std::is_standard_layout_v<Segment>);

bool is_same(const ConvexPolygon& a, const ConvexPolygon& b) {
  const std::size_t size = a.vertices_m.size();
  return size == b.vertices_m.size() && a.vertices_m.front() == b.vertices_m.front() &&
         std::memcmp(a.vertices_m.data(), b.vertices_m.data(), size * sizeof(Point)) == 0;
}

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
  const std::size_t rectangle_blocks = blocks_of(num_polygons_) + n;
  grow(obstacles_, rectangle_blocks * kFloatLanes);
  grow(obstacle_rectangles_, rectangle_blocks);
  grow(near_, rectangle_blocks * kFloatLanes);
  grow(obstacle_blocks_, num_blocks_);
  const std::size_t corner_stride = most_blocks_ * kFloatLanes + 1;
  grow(corners_, 2 * corner_stride);
  const std::size_t segment_blocks = blocks_of(problem.boundary_m.size());
  grow(segment_source_, segment_blocks);
  grow(segment_blocks_, segment_blocks);
  grow(segment_rectangles_, blocks_of(segment_blocks));

  plan.horizon_steps = n;
  plan.polygons = polygons_.data();
  plan.num_polygons = num_polygons_;
  plan.boundary = problem.boundary_m.empty() ? nullptr : problem.boundary_m.front().from_m.data();
  plan.boundary_size = problem.boundary_m.size();
  plan.reach = reach_.data();
  plan.scale = tables_.reach_m(n);
  plan.first_obstacle = first_obstacle_.data();
  plan.obstacles = obstacles_.data();
  plan.obstacle_rectangles = obstacle_rectangles_.data();
  plan.near = near_.data();
  plan.obstacle_blocks = obstacle_blocks_.data();
  plan.corners = corners_.data();
  plan.corner_stride = corner_stride;
  plan.segment_source = segment_source_.data();
  plan.segment_blocks = segment_blocks_.data();
  plan.segment_rectangles = segment_rectangles_.data();
}

void PreparedObstacles::list_polygons() {
  std::size_t most = 0;
  for (const auto& areas_m : problem_->obstacles_m) most += areas_m.size();
  grow(polygons_, most);
  grow(sources_, most);
  num_polygons_ = 0;
  num_blocks_ = 0;
  most_blocks_ = 0;
  for (std::size_t step = 0; step < problem_->obstacles_m.size(); ++step) {
    const ConvexPolygon* before = nullptr;
    for (const ConvexPolygon& polygon_m : problem_->obstacles_m[step]) {
      const std::size_t size = polygon_m.vertices_m.size();
      if (size == 0) continue;
      assert(size >= 3);
      // A vehicle that keeps to its former plan is where both of its plans say, to the last bit.
      if (before != nullptr && is_same(*before, polygon_m)) continue;
      before = &polygon_m;
      const std::size_t blocks = blocks_of(size);
      polygons_[num_polygons_] = {
          polygon_m.vertices_m.front().data(), static_cast<std::uint32_t>(size),
          static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(num_blocks_),
          static_cast<std::uint32_t>(blocks)};
      sources_[num_polygons_] = &polygon_m;
      ++num_polygons_;
      num_blocks_ += blocks;
      most_blocks_ = std::max(most_blocks_, blocks);
    }
  }
}

}  // namespace hlc::branch_and_bound
