#include "planner/search/branch_and_bound/prepared_obstacles.hpp"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace hlc::search::branch_and_bound {
namespace {

// The kernel reads corners and boundaries directly from memory.
static_assert(sizeof(Point) == 2 * sizeof(double));
static_assert(sizeof(Segment) == 4 * sizeof(double) && std::is_standard_layout_v<Segment>);

/// Number of PieceData for a polygon with this many corners. Each except the last takes kNextPiece
/// of the triangles at its first corner.
std::size_t pieces_of(std::size_t corners) { return (corners - 2 + kNextPiece - 1) / kNextPiece; }

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
  grow(last_obstacle_, n);
  grow(first_in_motion_, n);
  // Every step's obstacles are padded.
  const std::size_t boxes_blocks = blocks_of(num_pieces_) + n;
  grow(obstacles_, boxes_blocks * kFloatLanes);
  grow(obstacle_boxes_, boxes_blocks);
  grow(near_, (n + 1) * most_in_step_ + 1);
  grow(near_blocks_, (n + 1) * most_in_step_ + 1);
  grow(obstacle_blocks_, boxes_blocks * kFloatLanes);
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
  plan.last_obstacle = last_obstacle_.data();
  plan.first_in_motion = first_in_motion_.data();
  plan.obstacles = obstacles_.data();
  plan.obstacle_boxes = obstacle_boxes_.data();
  plan.obstacle_blocks = obstacle_blocks_.data();
  plan.segment_source = segment_source_.data();
  plan.segment_blocks = segment_blocks_.data();
  plan.segment_rectangles = segment_rectangles_.data();
}

void PreparedObstacles::list_polygons() {
  const auto& always_m = problem_->obstacles_m;
  const auto& in_motion_m = problem_->avoided_in_motion_m;
  std::size_t most = 0;
  for (const auto& areas_m : always_m) most += areas_m.size();
  for (const auto& areas_m : in_motion_m) most += areas_m.size();
  grow(polygons_, most);
  num_polygons_ = 0;
  num_pieces_ = 0;
  most_in_step_ = 0;
  for (std::size_t step = 0; step < problem_->horizon_steps(); ++step) {
    const std::size_t before = num_pieces_;
    if (!always_m.empty()) list_polygons(always_m[step], step, false);
    if (!in_motion_m.empty()) list_polygons(in_motion_m[step], step, true);
    most_in_step_ = std::max(most_in_step_, num_pieces_ - before);
  }
}

void PreparedObstacles::list_polygons(const std::vector<ConvexPolygon>& areas_m, std::size_t step,
                                      bool only_in_motion) {
  for (std::size_t number = 0; number < areas_m.size(); ++number) {
    const auto& corners_m = areas_m[number].vertices_m;
    const std::size_t size = corners_m.size();
    assert(size == 0 || size >= 3);  // per obstacle of every problem
    if (size < 3) continue;
    polygons_[num_polygons_++] = {.corners = corners_m.front().data(),
                                  .size = static_cast<std::uint32_t>(size),
                                  .step = static_cast<std::uint32_t>(step),
                                  .number = static_cast<std::uint32_t>(number),
                                  .only_in_motion = only_in_motion};
    num_pieces_ += pieces_of(size);
  }
}

}  // namespace hlc::search::branch_and_bound
