#include "planner/search/ompl_planner.hpp"

#include <ompl/base/SolutionNonExistenceProof.h>
#include <ompl/geometric/PathGeometric.h>

#include <utility>

namespace ob = ompl::base;

namespace hlc {
namespace {

class OmplHorizonPlanner final : public HorizonPlanner {
 public:
  OmplHorizonPlanner(const Subgraph& subgraph, std::size_t max_steps,
                     std::unique_ptr<SearchEngine> engine)
      : subgraph_(subgraph),
        si_(make_space_information(subgraph, max_steps)),
        planner_(si_, std::move(engine)) {
    planner_.setup();
  }

  SearchResult plan(const HorizonProblem& problem) override {
    planner_.clear();
    planner_.setProblemDefinition(
        std::make_shared<HorizonProblemDefinition>(si_, subgraph_, problem));
    planner_.solve(ob::plannerNonTerminatingCondition());
    SearchResult result = planner_.take_result();
    planner_.setProblemDefinition(nullptr);  // it refers to `problem`
    return result;
  }

 private:
  const Subgraph& subgraph_;
  ob::SpaceInformationPtr si_;
  RecedingHorizonPlanner planner_;
};

}  // namespace

RecedingHorizonPlanner::RecedingHorizonPlanner(const ob::SpaceInformationPtr& si,
                                               std::unique_ptr<SearchEngine> engine)
    : Planner(si, "RecedingHorizonPlanner"), engine_(std::move(engine)) {
  specs_.optimizingPaths = true;
  specs_.directed = true;
  specs_.provingSolutionNonExistence = true;
}

ob::PlannerStatus RecedingHorizonPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  result_ = {};
  const auto* definition = dynamic_cast<const HorizonProblemDefinition*>(pdef_.get());
  if (definition == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  const HorizonProblem& problem = definition->problem();
  if (!starts_where_problem_starts(problem)) return ob::PlannerStatus::INVALID_START;

  engine_->search(problem, ptc, result_);
  if (result_.status != SearchStatus::kFallback) {
    add_solution(problem);
    return ob::PlannerStatus::EXACT_SOLUTION;
  }
  if (result_.reason == NoPath::kBudget) return ob::PlannerStatus::TIMEOUT;
  pdef_->setSolutionNonExistenceProof(std::make_shared<ob::SolutionNonExistenceProof>(si_));
  return ob::PlannerStatus::ABORT;
}

bool RecedingHorizonPlanner::starts_where_problem_starts(const HorizonProblem& problem) const {
  if (pdef_->getStartStateCount() != 1) return false;
  ob::State* start = si_->allocState();
  write_state({problem.start, problem.start_trim, 0}, *start);
  const bool same = si_->equalStates(start, pdef_->getStartState(0));
  si_->freeState(start);
  return same;
}

void RecedingHorizonPlanner::add_solution(const HorizonProblem& problem) {
  const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  ob::State* state = si_->allocState();
  write_state({problem.start, problem.start_trim, 0}, *state);
  path->append(state);
  for (std::size_t j = 0; j < result_.maneuvers.size(); ++j) {
    write_state({result_.poses[j], result_.maneuvers[j]->to, j + 1}, *state);
    path->append(state);
  }
  si_->freeState(state);

  ob::PlannerSolution solution(path);
  solution.setOptimized(pdef_->getOptimizationObjective(), ob::Cost(result_.cost),
                        result_.status == SearchStatus::kOptimal);
  solution.setPlannerName(getName());
  pdef_->addSolutionPath(solution);
}

void RecedingHorizonPlanner::clear() {
  Planner::clear();
  result_ = {};
}

SearchResult RecedingHorizonPlanner::take_result() { return std::exchange(result_, {}); }

std::unique_ptr<HorizonPlanner> make_ompl_horizon_planner(const Subgraph& subgraph,
                                                          std::size_t max_steps,
                                                          std::unique_ptr<SearchEngine> engine) {
  return std::make_unique<OmplHorizonPlanner>(subgraph, max_steps, std::move(engine));
}

std::unique_ptr<HorizonPlanner> make_horizon_planner(const Subgraph& subgraph,
                                                     const ReachableSets& reachable,
                                                     const SearchOptions& options) {
  return make_ompl_horizon_planner(subgraph, reachable.max_steps(),
                                   make_search_engine(subgraph, reachable, options));
}

}  // namespace hlc
