#include "planner/search/ompl/ompl_planner.hpp"

#include <ompl/base/PlannerData.h>
#include <ompl/base/SolutionNonExistenceProof.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>

#include <charconv>
#include <stdexcept>
#include <utility>

#include "planner/search/ompl/ompl_control.hpp"
#include "planner/search/search_options.hpp"

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace og = ompl::geometric;

namespace hlc::search {
namespace {

/// @throws std::invalid_argument, which ParamSet turns into a refusal
std::size_t expansions_from_text(const std::string& text) {
  std::size_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || value == 0) {
    throw std::invalid_argument("max_expansions = " + text + ", must be a whole number >= 1");
  }
  return value;
}

/// Written into the states of `former`, if that is a path of the same length without another owner:
/// making states takes longer than many a search.
ob::PathPtr make_geometric_path(const ob::SpaceInformationPtr& si, const HorizonProblem& problem,
                                const SearchResult& plan, ob::PathPtr former) {
  const std::size_t num_states = plan.maneuvers.size() + 1;
  std::shared_ptr<og::PathGeometric> path;
  if (former && former.use_count() == 1) {
    path = std::dynamic_pointer_cast<og::PathGeometric>(std::move(former));
  }
  if (!path || path->getStateCount() != num_states) {
    path = std::make_shared<og::PathGeometric>(si);
    for (std::size_t j = 0; j < num_states; ++j) path->getStates().push_back(si->allocState());
  }
  write_state({problem.start, problem.start_trim, 0}, *path->getState(0));
  for (std::size_t j = 0; j < plan.maneuvers.size(); ++j) {
    write_state({plan.poses[j], plan.maneuvers[j]->to, j + 1},
                *path->getState(static_cast<unsigned>(j + 1)));
  }
  return path;
}

}  // namespace

RecedingHorizonPlanner::RecedingHorizonPlanner(const ob::SpaceInformationPtr& si,
                                               const automaton::Subgraph& subgraph,
                                               const automaton::ReachableSets& reachable,
                                               const SearchOptions& options,
                                               std::shared_ptr<const SearchTables> tables)
    : Planner(si, "RecedingHorizonPlanner"),
      subgraph_(subgraph),
      reachable_(reachable),
      options_(options),
      tables_(std::move(tables)),
      state_(si) {
  options_.factory = nullptr;
  specs_.optimizingPaths = true;
  specs_.approximateSolutions = true;
  specs_.directed = true;
  specs_.provingSolutionNonExistence = true;
  declare_parameters();
}

/// After a change of a parameter the next `solve` makes a new engine.
void RecedingHorizonPlanner::declare_parameters() {
  const auto declare = [this](const std::string& name, const std::string& allowed, auto set,
                              auto get) {
    params_.declareParam<std::string>(
        name,
        [this, set](const std::string& text) {
          set(text);
          tables_.reset();
          setup_ = false;
        },
        get);
    params_[name].setRangeSuggestion(allowed);
  };
  declare(
      "engine", "branch_and_bound,best_first",
      [this](const std::string& text) { options_.engine = engine_from_name(text); },
      [this] { return std::string(to_string(options_.engine)); });
  declare(
      "cost_to_go", "reachable,straight_line,2022",
      [this](const std::string& text) { options_.cost_to_go = cost_to_go_from_name(text); },
      [this] { return std::string(to_string(options_.cost_to_go)); });
  declare(
      "max_expansions", "1:10000000",
      [this](const std::string& text) { options_.max_expansions = expansions_from_text(text); },
      [this] { return std::to_string(options_.max_expansions); });
}

void RecedingHorizonPlanner::setup() {
  check_search_options(options_);
  engine_ = make_search_engine(subgraph_, reachable_, options_, tables_);
  Planner::setup();
}

ob::PlannerStatus RecedingHorizonPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  if (!isSetup()) setup();
  forget();
  if (!pdef_) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  const auto* goal = dynamic_cast<const StandstillGoal*>(pdef_->getGoal().get());
  if (goal == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  const HorizonProblem& problem = goal->problem();
  if (!starts_where_problem_starts(problem)) return ob::PlannerStatus::INVALID_START;

  engine_->search(problem, ptc, result_);
  if (result_.status != SearchStatus::kFallback) return add_solution(problem);
  if (result_.reason == NoPath::kBudget) return ob::PlannerStatus::TIMEOUT;
  pdef_->setSolutionNonExistenceProof(std::make_shared<ob::SolutionNonExistenceProof>(si_));
  return ob::PlannerStatus::ABORT;
}

bool RecedingHorizonPlanner::starts_where_problem_starts(const HorizonProblem& problem) {
  if (pdef_->getStartStateCount() != 1) return false;
  write_state({problem.start, problem.start_trim, 0}, *state_.get());
  return si_->equalStates(state_.get(), pdef_->getStartState(0));
}

ob::PlannerStatus RecedingHorizonPlanner::add_solution(const HorizonProblem& problem) {
  const auto controls = std::dynamic_pointer_cast<oc::SpaceInformation>(si_);
  path_ = controls ? make_control_path(controls, problem, result_)
                   : make_geometric_path(si_, problem, result_, std::move(former_path_));
  const std::size_t n = problem.horizon_steps();
  write_state(n == 0 ? HorizonState{problem.start, problem.start_trim, 0}
                     : HorizonState{result_.poses.back(), result_.maneuvers.back()->to, n},
              *state_.get());
  const bool is_exact = pdef_->getGoal()->isSatisfied(state_.get());

  ob::PlannerSolution solution(path_);
  solution.setOptimized(pdef_->getOptimizationObjective(), ob::Cost(result_.cost),
                        result_.status == SearchStatus::kOptimal);
  if (!is_exact) {
    solution.setApproximate(
        (result_.poses.back().position_m() - problem.reference_m.back()).norm());
  }
  solution.setPlannerName(getName());
  pdef_->addSolutionPath(solution);
  return is_exact ? ob::PlannerStatus::EXACT_SOLUTION : ob::PlannerStatus::APPROXIMATE_SOLUTION;
}

void RecedingHorizonPlanner::clear() {
  Planner::clear();
  forget();
}

void RecedingHorizonPlanner::setProblemDefinition(const ob::ProblemDefinitionPtr& definition) {
  forget();
  Planner::setProblemDefinition(definition);
}

void RecedingHorizonPlanner::forget() {
  result_ = {};
  if (path_) former_path_ = std::move(path_);
}

void RecedingHorizonPlanner::getPlannerData(ob::PlannerData& data) const {
  Planner::getPlannerData(data);
  if (!path_ || !pdef_) return;
  const auto* controls = dynamic_cast<const oc::PathControl*>(path_.get());
  const auto state = [&](std::size_t i) {
    const auto index = static_cast<unsigned>(i);
    return controls != nullptr ? controls->getState(index)
                               : static_cast<const og::PathGeometric&>(*path_).getState(index);
  };
  const auto& objective = pdef_->getOptimizationObjective();
  const std::size_t n = controls != nullptr
                            ? controls->getControlCount()
                            : static_cast<const og::PathGeometric&>(*path_).getStateCount() - 1;
  data.addStartVertex(ob::PlannerDataVertex(state(0)));
  for (std::size_t j = 1; j <= n; ++j) {
    const ob::PlannerDataVertex from(state(j - 1));
    const ob::PlannerDataVertex to(state(j));
    if (j == n) {
      data.addGoalVertex(to);
    } else {
      data.addVertex(to);
    }
    const ob::Cost cost = objective ? objective->motionCost(state(j - 1), state(j)) : ob::Cost(1.0);
    if (controls != nullptr && data.hasControls()) {
      const auto index = static_cast<unsigned>(j - 1);
      data.addEdge(from, to,
                   oc::PlannerDataEdgeControl(controls->getControl(index),
                                              controls->getControlDuration(index)),
                   cost);
    } else {
      data.addEdge(from, to, ob::PlannerDataEdge(), cost);
    }
  }
}

SearchResult RecedingHorizonPlanner::take_result() { return std::exchange(result_, {}); }

}  // namespace hlc::search
