#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Whether cars keep within their lanes.
enum class Lanes { kNone, kCorridor };

/// Where blue and green start: arc length on their routes [m]. Red starts at 0.
struct ThreeCarsStart {
  double blue_m{};
  double green_m{};
};

/// The start used for the problem sets. Of the starts that are multiples of 0.5 m on both routes it
/// is the one in whose 150 steps red's best plan is changed by the others most often, with lanes
/// and without (the smaller number of the two counts), among those where red always has a plan.
inline constexpr ThreeCarsStart kThreeCarsStart{.blue_m = 6.5, .green_m = 4.5};

/// The closed routes of red, blue and green.
[[nodiscard]] std::vector<road::ReferencePath> three_cars_routes();

/// Red's planning problems, step by step, in scenario `paper_three_cars` (map, routes, reference
/// speed, horizon, profile `default` but the authors' later spacing of reference points, and
/// coordination `strict`: one problem a step) with vehicles that follow perfectly. Red is the
/// vehicle that plans last and keeps clear of both others. Without lanes all three drive on open
/// ground: their controllers know no boundary either.
///
/// Steps in which red had nothing to search are left out.
/// @param subgraph  of the paper's automaton
[[nodiscard]] std::vector<search::HorizonProblem> three_cars_problems(
    const std::shared_ptr<const automaton::Subgraph>& subgraph, Lanes lanes, std::size_t steps,
    const ThreeCarsStart& start = kThreeCarsStart);

}  // namespace hlc::test
