#include "planner/search/ompl/ompl_engine.hpp"

#include <functional>
#include <utility>

#include "planner/search/ompl/ompl_planner.hpp"
#include "planner/search/ompl/ompl_problem.hpp"

namespace ob = ompl::base;

namespace hlc::search {
namespace {

class OmplEngine final : public SearchEngine {
 public:
  OmplEngine(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
             const SearchOptions& options, std::shared_ptr<const SearchTables> tables)
      : subgraph_(subgraph),
        si_(make_space_information(subgraph, reachable.max_steps())),
        planner_(si_, subgraph, reachable, options, std::move(tables)) {
    planner_.setup();
  }

  using SearchEngine::search;
  void search(const HorizonProblem& problem, const std::function<bool()>& stop,
              SearchResult& result) override {
    if (definition_) {
      definition_->pose(problem);
      planner_.clear();
    } else {
      definition_ = std::make_shared<HorizonProblemDefinition>(si_, subgraph_, problem);
      planner_.setProblemDefinition(definition_);
    }
    planner_.solve(ob::PlannerTerminationCondition(stop));
    // The definition still refers to `problem`: it must not be used before it poses the next one.
    result = planner_.take_result();
  }

 private:
  const automaton::Subgraph& subgraph_;
  ob::SpaceInformationPtr si_;
  RecedingHorizonPlanner planner_;
  std::shared_ptr<HorizonProblemDefinition> definition_;
};

}  // namespace

std::unique_ptr<SearchEngine> make_ompl_engine(const automaton::Subgraph& subgraph,
                                               const automaton::ReachableSets& reachable,
                                               const SearchOptions& options,
                                               std::shared_ptr<const SearchTables> tables) {
  return std::make_unique<OmplEngine>(subgraph, reachable, options, std::move(tables));
}

}  // namespace hlc::search
