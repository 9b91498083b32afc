#include "tests/benchmarks/random_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/reference_points.hpp"
#include "tests/support/random_problem.hpp"

namespace hlc::test {
namespace {

constexpr double kSlowestPace = 0.4;
constexpr double kBeside_m = 0.1;
constexpr double kTurned_rad = 0.5;

TrimId random_trim_on(const automaton::Subgraph& subgraph, std::mt19937_64& random) {
  return subgraph.trims()[pick(random, subgraph.trims().size())];
}

/// Swept areas of the steps of a plan that ends in standstill; `choose` takes one of the edges of a
/// step: (edges, pose, number of the step from 0).
template <class Choose>
std::vector<ConvexPolygon> plan_areas_m(const automaton::Subgraph& subgraph, Pose pose, TrimId trim,
                                        std::size_t steps, Choose choose) {
  std::vector<ConvexPolygon> areas_m;
  for (std::size_t step = 0; step < steps; ++step) {
    const automaton::Edge& edge = choose(subgraph.successors(trim, steps - step), pose, step);
    areas_m.push_back(transformed(edge.maneuver->swept_area_m, pose));
    pose = compose(pose, edge.maneuver->displacement);
    trim = edge.to;
  }
  return areas_m;
}

/// Of a car somewhere else, by chance.
std::vector<ConvexPolygon> random_plan_areas_m(const automaton::Subgraph& subgraph,
                                               const Pose& pose, std::size_t steps,
                                               std::mt19937_64& random) {
  return plan_areas_m(
      subgraph, pose, random_trim_on(subgraph, random), steps,
      [&](std::span<const automaton::Edge> edges, const Pose&,
          std::size_t) -> const automaton::Edge& { return edges[pick(random, edges.size())]; });
}

/// Of this car: each step as near as it can to where a car is that drives the reference's way at
/// `pace` times its speed.
std::vector<ConvexPolygon> plan_in_force_areas_m(const automaton::Subgraph& subgraph,
                                                 const search::HorizonProblem& problem,
                                                 double pace) {
  return plan_areas_m(subgraph, problem.start, problem.start_trim, problem.horizon_steps(),
                      [&](std::span<const automaton::Edge> edges, const Pose& pose,
                          std::size_t step) -> const automaton::Edge& {
                        const auto at = static_cast<std::size_t>(pace * static_cast<double>(step));
                        const auto distance = [&](const automaton::Edge& edge) {
                          const Point end_m =
                              compose(pose, edge.maneuver->displacement).position_m();
                          return (end_m - problem.reference_m[at]).squaredNorm();
                        };
                        return *std::ranges::min_element(edges, {}, distance);
                      });
}

bool meet_in_a_step(const std::vector<ConvexPolygon>& a_m, const std::vector<ConvexPolygon>& b_m) {
  for (std::size_t j = 0; j < a_m.size(); ++j) {
    if (intersects(a_m[j], b_m[j])) return true;
  }
  return false;
}

search::HorizonProblem problem_without_obstacles(const automaton::Subgraph& subgraph, TrimId trim,
                                                 std::span<const road::ReferencePath> routes,
                                                 const RandomTraffic& traffic,
                                                 std::mt19937_64& random) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const road::ReferencePath& route = routes[pick(random, routes.size())];
  const double s_m = uniform(random, 0.0, route.length_m());
  const double along_rad = route.heading_rad_at(s_m);
  const double beside_m = uniform(random, -kBeside_m, kBeside_m);
  const Point position_m =
      route.at(s_m) + beside_m * Point(-std::sin(along_rad), std::cos(along_rad));
  search::HorizonProblem problem{.start = {position_m.x(), position_m.y(),
                                           along_rad + uniform(random, -kTurned_rad, kTurned_rad)},
                                 .start_trim = trim};
  if (pick(random, 10) == 0) problem.start.heading_rad += std::numbers::pi;
  road::Reference reference = road::reference_points(
      route, route.project_within(position_m, s_m - 2.0 * kBeside_m, s_m + 2.0 * kBeside_m).s_m,
      automaton.trims[trim.index].speed_mps, traffic.reference_speed_mps, traffic.horizon_steps,
      automaton.step_s, road::mean_speed_first);
  problem.reference_m = std::move(reference.points_m);
  problem.reference_speed_mps = std::move(reference.speeds_mps);
  problem.obstacles_m.resize(traffic.horizon_steps);
  return problem;
}

}  // namespace

search::HorizonProblem random_traffic_problem(const automaton::Subgraph& subgraph,
                                              std::span<const road::ReferencePath> routes,
                                              const RandomTraffic& traffic, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  search::HorizonProblem problem = problem_without_obstacles(
      subgraph, random_trim_on(subgraph, random), routes, traffic, random);
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const ConvexPolygon own_m = footprint_area(automaton.vehicle.footprint, problem.start,
                                             2.0 * automaton.vehicle.safety_margin_m);
  const std::vector<ConvexPolygon> in_force_m =
      plan_in_force_areas_m(subgraph, problem, uniform(random, kSlowestPace, 1.0));
  for (std::size_t car = 0; car < traffic.cars;) {
    const double distance_m = traffic.within_m * std::sqrt(uniform(random, 0.0, 1.0));
    const double direction_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
    const Pose pose{problem.start.x_m + distance_m * std::cos(direction_rad),
                    problem.start.y_m + distance_m * std::sin(direction_rad),
                    uniform(random, -std::numbers::pi, std::numbers::pi)};
    std::vector<ConvexPolygon> areas_m =
        random_plan_areas_m(subgraph, pose, traffic.horizon_steps, random);
    if (intersects(own_m, areas_m.front())) continue;
    if (traffic.others == Others::kKeepClear && meet_in_a_step(in_force_m, areas_m)) continue;
    for (std::size_t j = 0; j < areas_m.size(); ++j) {
      problem.obstacles_m[j].push_back(std::move(areas_m[j]));
    }
    ++car;
  }
  return problem;
}

search::HorizonProblem blocked_end_problem(const automaton::Subgraph& subgraph,
                                           std::span<const road::ReferencePath> routes,
                                           std::size_t horizon_steps, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const RandomTraffic no_traffic{.horizon_steps = horizon_steps};
  search::HorizonProblem problem =
      problem_without_obstacles(subgraph, subgraph.standstill(), routes, no_traffic, random);
  constexpr double kFar_m = 100.0;
  problem.obstacles_m.back().push_back(
      convex_hull({{-kFar_m, -kFar_m}, {kFar_m, -kFar_m}, {kFar_m, kFar_m}, {-kFar_m, kFar_m}}));
  return problem;
}

}  // namespace hlc::test
