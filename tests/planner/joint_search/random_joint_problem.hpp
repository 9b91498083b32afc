#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/joint_search/joint_problem.hpp"
#include "planner/search/search_engine.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::joint_search {

inline constexpr std::size_t kLongestHorizon = 8;

/// Draws joint problems on one subgraph of the test automaton, and has the engine for them.
class JointProblems {
 public:
  explicit JointProblems(const std::vector<std::size_t>& trims = test::kAllTrims)
      : subgraph_(test::make_test_subgraph(test::make_test_automaton(), trims)),
        reachable_(subgraph_, kLongestHorizon),
        engine_(make_engine(1'000'000)) {}

  [[nodiscard]] const automaton::Subgraph& subgraph() const { return subgraph_; }
  [[nodiscard]] search::SearchEngine& engine() const { return *engine_; }
  [[nodiscard]] std::unique_ptr<search::SearchEngine> make_engine(
      std::size_t max_expansions) const {
    return search::make_search_engine(subgraph_, reachable_, {.max_expansions = max_expansions});
  }

  /// Vehicles around one point, most of them on the way to it, none overlapping at the start.
  [[nodiscard]] JointProblem draw(std::size_t num_vehicles, std::size_t horizon_steps,
                                  std::mt19937_64& random) const {
    JointProblem problem;
    std::vector<ConvexPolygon> starts;
    while (problem.size() < num_vehicles) {
      search::HorizonProblem one = test::random_problem(subgraph_, horizon_steps, random);
      const double from_rad = test::uniform(random, -3.1, 3.1);
      const double distance_m = test::uniform(random, 0.15, 0.5);
      const Pose start{distance_m * std::cos(from_rad), distance_m * std::sin(from_rad),
                       from_rad + 3.1416 + test::uniform(random, -0.4, 0.4)};
      one.obstacles_m.clear();
      one.boundary_m.clear();
      one.start = start;
      one.reference_m = test::random_reference_m(start, horizon_steps, random);
      const TrimId stand = subgraph_.standstill();
      const ConvexPolygon area_m =
          transformed(subgraph_.automaton().find(stand, stand, "trim")->swept_area_m, start);
      const auto meets = [&](const ConvexPolygon& other_m) { return intersects(area_m, other_m); };
      if (std::ranges::any_of(starts, meets)) continue;
      starts.push_back(area_m);
      problem.push_back({.problem = std::move(one), .engine = engine_.get()});
    }
    return problem;
  }

 private:
  automaton::Subgraph subgraph_;
  automaton::ReachableSets reachable_;
  std::unique_ptr<search::SearchEngine> engine_;
};

[[nodiscard]] inline std::vector<search::HorizonProblem> problems_of(const JointProblem& joint) {
  std::vector<search::HorizonProblem> problems;
  for (const JointVehicle& one : joint) problems.push_back(one.problem);
  return problems;
}

}  // namespace hlc::joint_search
