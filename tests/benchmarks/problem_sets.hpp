#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Horizon problems of one kind, on one subgraph.
struct ProblemSet {
  std::string name;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::size_t horizon_steps{};  ///< of every problem
  std::vector<search::HorizonProblem> problems;
};

/// What the sets are made on; all but kPaperA have J2 maneuvers.
enum class Automaton {
  kPaperB,  ///< the paper's 12 trims
  kPaperA,  ///< the same with J1 maneuvers, which outrun their trims
  kGrid34,  ///< `ucar_grid_34`
  kGrid95,  ///< 95 trims, with at most nine edges out of each
};

struct ProblemSetInfo {
  std::string name;
  std::string what;  ///< one line
};

/// All sets that `ProblemSets` makes, in the order in which they are run:
///
/// | set | problems |
/// |---|---|
/// | `three_cars` | red's of 150 steps of scenario `paper_three_cars` (three_cars.hpp), no lanes |
/// | `three_cars_corridor` | the same within the lanes |
/// | `three_cars_incumbent` | those of `three_cars_corridor` with the plan in force as incumbent |
/// | `random_starts` | random_traffic.hpp: 2 other cars within 1.5 m |
/// | `cars_5`, `cars_10`, `cars_19` | so many other cars, within 1.5, 1.9, 2.3 m |
/// | `horizon_8`, `horizon_12`, `horizon_16` | 3 other cars, so many steps |
/// | `trims_12`, `trims_34`, `trims_95` | 3 other cars, so many trims |
/// | `maneuvers_j1` | 2 other cars, the paper's subgraph A, reference speed 1.2 m/s |
/// | `infeasible` | from standstill, all ground occupied in the last step: tries the whole tree |
/// | `infeasible_random` | 19 other cars that do not keep out of the way, no plan exists |
///
/// All but `maneuvers_j1`, `trims_34` and `trims_95` are on the paper's subgraph B.
/// Without lanes means without any boundary. Only `three_cars_incumbent` has incumbents.
[[nodiscard]] std::span<const ProblemSetInfo> problem_set_infos();

/// Makes problem sets: the same name gives the same problems on every run (fixed seeds; controllers
/// search best-first, so the sets do not depend on the engine that is measured). Automata are built
/// when a set first needs them, and kept: in a second
/// or less each.
class ProblemSets {
 public:
  ProblemSets();

  /// @param name          one of problem_set_infos()
  /// @param max_problems  only the first so many; 0: all
  /// @throws std::invalid_argument with one line for any other name
  [[nodiscard]] ProblemSet make(const std::string& name, std::size_t max_problems = 0);

 private:
  [[nodiscard]] std::shared_ptr<const automaton::Subgraph> subgraph(Automaton automaton);

  std::vector<road::ReferencePath> routes_;  ///< of random traffic: the three cars'
  std::map<Automaton, std::shared_ptr<const automaton::Subgraph>> subgraphs_;
};

}  // namespace hlc::test
