#include "planner/search/collision.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

namespace hlc::search {
namespace {

double distance_m(const Box& box, const Point& point_m) {
  return (point_m - point_m.cwiseMax(box.min_m).cwiseMin(box.max_m)).norm();
}

double radius_m(const ConvexPolygon& polygon) {
  double radius = 0.0;
  for (const Point& vertex_m : polygon.vertices_m) radius = std::max(radius, vertex_m.norm());
  return radius;
}

}  // namespace

Box place(const ConvexPolygon& area_m, const Frame& start, ConvexPolygon& placed) {
  placed.vertices_m.clear();
  Box box;
  for (const Point& vertex_m : area_m.vertices_m) {
    const Point& placed_m = placed.vertices_m.emplace_back(transformed(vertex_m, start));
    box.min_m = box.min_m.cwiseMin(placed_m);
    box.max_m = box.max_m.cwiseMax(placed_m);
  }
  return box;
}

std::optional<Obstruction> obstruction_of(const automaton::Maneuver& maneuver, std::size_t step,
                                          const Frame& start, const HorizonProblem& problem) {
  ConvexPolygon placed;
  place(maneuver.swept_area_m, start, placed);
  const auto meets = [&placed](const ConvexPolygon& area_m) {
    return !area_m.empty() && intersects(placed, area_m);
  };
  std::size_t before = 0;
  if (!problem.obstacles_m.empty()) {
    const std::vector<ConvexPolygon>& areas_m = problem.obstacles_m[step - 1];
    const auto met = std::ranges::find_if(areas_m, meets);
    before = static_cast<std::size_t>(met - areas_m.begin());
    if (met != areas_m.end()) return Obstruction{.obstacle = before};
  }
  if (!problem.avoided_in_motion_m.empty() && !stands_in(maneuver)) {
    const std::vector<ConvexPolygon>& areas_m = problem.avoided_in_motion_m[step - 1];
    const auto met = std::ranges::find_if(areas_m, meets);
    if (met != areas_m.end()) {
      return Obstruction{.obstacle = before + static_cast<std::size_t>(met - areas_m.begin())};
    }
  }
  place(maneuver.lane_area_m, start, placed);
  const bool meets_boundary = std::ranges::any_of(
      problem.boundary_m,
      [&placed](const Segment& segment) { return intersects(placed, segment); });
  return meets_boundary ? std::optional(Obstruction{}) : std::nullopt;
}

CollisionCheck::CollisionCheck(const automaton::Subgraph& subgraph,
                               const automaton::ReachableSets& reachable)
    : reachable_(reachable) {
  std::size_t max_vertices = 0;
  for (const TrimId trim : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      for (const ConvexPolygon* area_m :
           {&edge.maneuver->swept_area_m, &edge.maneuver->lane_area_m}) {
        area_radius_m_ = std::max(area_radius_m_, radius_m(*area_m));
        max_vertices = std::max(max_vertices, area_m->vertices_m.size());
      }
    }
  }
  placed_.vertices_m.reserve(max_vertices);
}

void CollisionCheck::prepare(const HorizonProblem& problem) {
  const std::size_t horizon_steps = problem.horizon_steps();
  HLC_DEMAND(problem.obstacles_m.empty() || problem.obstacles_m.size() == horizon_steps,
             problem.obstacles_m.size(), horizon_steps);
  HLC_DEMAND(
      problem.avoided_in_motion_m.empty() || problem.avoided_in_motion_m.size() == horizon_steps,
      problem.avoided_in_motion_m.size(), horizon_steps);

  // Rounding must not drop an area that only just touches.
  constexpr double kSlackM = 1e-6;
  const Point start_m = problem.start.position_m();
  double farthest_m = 0.0;
  obstacles_.resize(horizon_steps);
  avoided_in_motion_.resize(horizon_steps);
  for (std::size_t step = 1; step <= horizon_steps; ++step) {
    const double before_m =
        reachable_.max_distance_m(problem.start_trim, step - 1, horizon_steps - (step - 1));
    const double reach_m = before_m + area_radius_m_ + kSlackM;
    farthest_m = std::max(farthest_m, reach_m);
    obstacles_[step - 1].clear();
    avoided_in_motion_[step - 1].clear();
    if (!problem.obstacles_m.empty()) {
      add_obstacles(problem.obstacles_m[step - 1], start_m, reach_m, obstacles_[step - 1]);
    }
    if (!problem.avoided_in_motion_m.empty()) {
      add_obstacles(problem.avoided_in_motion_m[step - 1], start_m, reach_m,
                    avoided_in_motion_[step - 1]);
    }
  }
  boundary_.clear();
  for (const Segment& segment : problem.boundary_m) {
    const Box box = bounding_box(segment);
    if (distance_m(box, start_m) <= farthest_m) boundary_.push_back({box, segment});
  }
}

void CollisionCheck::add_obstacles(const std::vector<ConvexPolygon>& areas_m, const Point& start_m,
                                   double reach_m, std::vector<Obstacle>& obstacles) const {
  for (const ConvexPolygon& polygon_m : areas_m) {
    const Box box = bounding_box(polygon_m);
    if (!polygon_m.empty() && distance_m(box, start_m) <= reach_m)
      obstacles.push_back({box, &polygon_m});
  }
}

bool CollisionCheck::is_free(const automaton::Maneuver& maneuver, std::size_t step,
                             const Frame& start) {
  return !meets_obstacle(maneuver, step, start) && !meets_boundary(maneuver.lane_area_m, start);
}

bool CollisionCheck::meets_obstacle(const automaton::Maneuver& maneuver, std::size_t step,
                                    const Frame& start) {
  const std::vector<Obstacle>& obstacles = obstacles_[step - 1];
  const std::vector<Obstacle>& in_motion = avoided_in_motion_[step - 1];
  if (obstacles.empty() && in_motion.empty()) return false;
  const Box box = place(maneuver.swept_area_m, start, placed_);
  const auto meets = [&](const Obstacle& obstacle) {
    return overlap(box, obstacle.box) && intersects(placed_, *obstacle.polygon_m);
  };
  return std::ranges::any_of(obstacles, meets) ||
         (!stands_in(maneuver) && std::ranges::any_of(in_motion, meets));
}

bool CollisionCheck::meets_boundary(const ConvexPolygon& area_m, const Frame& start) {
  if (boundary_.empty()) return false;
  const Box box = place(area_m, start, placed_);
  return std::any_of(boundary_.begin(), boundary_.end(), [&](const BoundaryPiece& piece) {
    return overlap(box, piece.box) && intersects(placed_, piece.segment);
  });
}

}  // namespace hlc::search
