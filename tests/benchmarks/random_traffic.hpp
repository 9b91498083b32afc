#pragma once

#include <cstddef>
#include <cstdint>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Whether other cars leave the way of the plan in force free. In a run they do, so that there
/// always is a plan (recursive feasibility).
enum class Others { kKeepClear, kDriveAnywhere };

/// Whether one car in ten stands the wrong way round.
enum class Headings { kAlongTheWay, kSomeReversed };

struct RandomTraffic {
  std::size_t horizon_steps{8};
  std::size_t cars{};  ///< others
  double within_m{};   ///< of the start
  double reference_speed_mps{0.8};
  Others others{Others::kKeepClear};
  Headings headings{Headings::kAlongTheWay};
};

/// A car somewhere in traffic, no boundary.
///
/// It starts anywhere in a trim that is on and follows an arc of up to 2.5 / m, beside which it is
/// by up to 0.1 m and 0.5 rad, or the wrong way round. The first reference point
/// lies ahead by the mean of its speed and the reference speed, the others by the reference speed.
/// Other cars drive random plans of the same subgraph, each from a random pose and trim; what they
/// sweep are the obstacles. None starts on this car or sweeps it in the first step.
/// With kKeepClear none meets a random plan of this car either, so that the problem has a solution.
///
/// @param seed  the same gives the same problem
/// @pre every trim that is on can stand within `horizon_steps`
[[nodiscard]] HorizonProblem random_traffic_problem(const Subgraph& subgraph,
                                                    const RandomTraffic& traffic,
                                                    std::uint64_t seed);

/// From standstill at a random pose, random reference, all ground occupied during the last step:
/// every path up to it is free and none ends.
[[nodiscard]] HorizonProblem blocked_end_problem(const Subgraph& subgraph,
                                                 std::size_t horizon_steps, std::uint64_t seed);

}  // namespace hlc::test
