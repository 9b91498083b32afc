#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"
#include "tests/benchmarks/search_report.hpp"

namespace hlc::test {

/// Something that solves horizon problems, to be measured.
class Contestant {
 public:
  virtual ~Contestant() = default;
  /// What is measured, and nothing else.
  virtual void solve(const search::HorizonProblem& problem) = 0;
  /// What `solve` found last, without the time.
  [[nodiscard]] virtual Solved solved() const = 0;
};

/// Name of the reference.
inline constexpr char kPlain[] = "plain";

/// | name | what |
/// |---|---|
/// | `plain` | PlainSearch, the reference |
/// | `best_first_straight_line` | best-first engine with the reference's kind of cost-to-go |
/// | `best_first` | the same with the one from reachable sets |
/// | `branch_and_bound` | the fast engine, as the controller has it |
/// | `ompl_branch_and_bound` | the same, called through an ompl::base::Planner |
[[nodiscard]] const std::vector<std::string>& contestant_names();

/// An engine's budget is beyond every tree of the problem sets: nothing may end before the optimum.
/// @param name  one of contestant_names()
/// @param subgraph, reachable  must outlive the contestant
[[nodiscard]] std::unique_ptr<Contestant> make_contestant(
    const std::string& name, const automaton::Subgraph& subgraph,
    const automaton::ReachableSets& reachable);

}  // namespace hlc::test
