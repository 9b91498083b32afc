#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Whether other cars leave the way of the plan in force free. In a run they do, so that there
/// always is a plan (recursive feasibility).
enum class Others { kKeepClear, kDriveAnywhere };

struct RandomTraffic {
  std::size_t horizon_steps{8};
  std::size_t cars{};  ///< others
  double within_m{};   ///< of the start
  double reference_speed_mps{0.8};
  Others others{Others::kKeepClear};
};

/// A car on one of the routes in random traffic, no boundary.
///
/// It is in an enabled trim, up to 0.1 m beside the route and turned by up to 0.5 rad, one in
/// ten the wrong way round; its reference are the points of profile `default`. Other cars drive
/// random plans of the same subgraph, each from a random pose and trim; what they sweep are the
/// obstacles. None sweeps the place where this car starts in the first step. With kKeepClear none
/// meets this car's plan in force either, so that the problem has a solution: in each step as near
/// as it can to where a car is that drives the reference's way at 0.4 to 1 times its speed, and
/// standing at the end.
///
/// @param routes  closed
/// @param seed  the same gives the same problem
/// @pre every enabled trim can stand within `horizon_steps`
[[nodiscard]] search::HorizonProblem random_traffic_problem(
    const automaton::Subgraph& subgraph, std::span<const road::ReferencePath> routes,
    const RandomTraffic& traffic, std::uint64_t seed);

/// From standstill anywhere on the routes as above, all ground occupied during the last step:
/// every path up to it is free and none ends.
[[nodiscard]] search::HorizonProblem blocked_end_problem(
    const automaton::Subgraph& subgraph, std::span<const road::ReferencePath> routes,
    std::size_t horizon_steps, std::uint64_t seed);

}  // namespace hlc::test
