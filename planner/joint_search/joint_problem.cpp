#include "planner/joint_search/joint_problem.hpp"

#include "planner/geometry/intersection.hpp"

namespace hlc::joint_search {

double cost_of(const JointPlan& plan) {
  double cost_m2 = 0.0;
  for (const search::SearchResult& one : plan) cost_m2 += one.cost;
  return cost_m2;
}

std::vector<ConvexPolygon> areas_of(const search::SearchResult& plan,
                                    const search::HorizonProblem& problem) {
  std::vector<ConvexPolygon> areas_m;
  areas_m.reserve(plan.maneuvers.size());
  Pose start = problem.start;
  for (std::size_t j = 0; j < plan.maneuvers.size(); ++j) {
    areas_m.push_back(transformed(plan.maneuvers[j]->swept_area_m, start));
    start = plan.poses[j];
  }
  return areas_m;
}

std::optional<Point> shared_point_m(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (!overlap(bounding_box(a), bounding_box(b)) || !intersects(a, b)) return std::nullopt;
  const ConvexPolygon shared = intersection(a, b);
  if (area_m2(shared) < kTouching_m2) return std::nullopt;
  return centroid_m(shared);
}

bool meet(const std::vector<ConvexPolygon>& areas_a_m,
          const std::vector<ConvexPolygon>& areas_b_m) {
  for (std::size_t j = 0; j < areas_a_m.size(); ++j) {
    if (shared_point_m(areas_a_m[j], areas_b_m[j])) return true;
  }
  return false;
}

void add_obstacles(const std::vector<ConvexPolygon>& areas_m, search::HorizonProblem& problem) {
  problem.obstacles_m.resize(problem.horizon_steps());
  for (std::size_t j = 0; j < areas_m.size(); ++j) problem.obstacles_m[j].push_back(areas_m[j]);
}

}  // namespace hlc::joint_search
