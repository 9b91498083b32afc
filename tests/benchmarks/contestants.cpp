#include "tests/benchmarks/contestants.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "planner/search/ompl/ompl_engine.hpp"
#include "planner/search/search_engine.hpp"
#include "tests/benchmarks/plain_search.hpp"

namespace hlc::test {
namespace {

constexpr std::size_t kNoBudget = 1'000'000'000;

const std::vector<std::pair<std::string, SearchOptions>>& engines() {
  static const std::vector<std::pair<std::string, SearchOptions>> all{
      {"best_first_straight_line", {Engine::kBestFirst, CostToGo::kStraightLine, kNoBudget}},
      {"best_first", {Engine::kBestFirst, CostToGo::kReachable, kNoBudget}},
      {"branch_and_bound", {Engine::kBranchAndBound, CostToGo::kReachable, kNoBudget}},
      {"ompl_branch_and_bound",
       {Engine::kBranchAndBound, CostToGo::kReachable, kNoBudget, {}, make_ompl_engine}},
  };
  return all;
}

Solved solved_by(const SearchResult& result) {
  return {
      .has_plan = result.status == SearchStatus::kOptimal,
      .stopped_early = result.status == SearchStatus::kBudget || result.reason == NoPath::kBudget,
      .cost = result.cost,
      .generated = result.generated,
      .expanded = result.expanded};
}

class PlainContestant final : public Contestant {
 public:
  explicit PlainContestant(const Subgraph& subgraph) : search_(subgraph) {}
  void solve(const HorizonProblem& problem) override { result_ = search_.search(problem); }
  [[nodiscard]] Solved solved() const override {
    return {.has_plan = result_.feasible,
            .cost = result_.cost,
            .generated = result_.generated,
            .expanded = result_.expanded};
  }

 private:
  PlainSearch search_;
  PlainResult result_;
};

class EngineContestant final : public Contestant {
 public:
  explicit EngineContestant(std::unique_ptr<SearchEngine> engine) : engine_(std::move(engine)) {}
  void solve(const HorizonProblem& problem) override { engine_->search(problem, stop_, result_); }
  [[nodiscard]] Solved solved() const override { return solved_by(result_); }

 private:
  std::unique_ptr<SearchEngine> engine_;
  std::function<bool()> stop_{never_stop};
  SearchResult result_;
};

}  // namespace

const std::vector<std::string>& contestant_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result{kPlain};
    for (const auto& [name, options] : engines()) result.push_back(name);
    return result;
  }();
  return names;
}

std::unique_ptr<Contestant> make_contestant(const std::string& name, const Subgraph& subgraph,
                                            const ReachableSets& reachable) {
  if (name == kPlain) return std::make_unique<PlainContestant>(subgraph);
  const auto found =
      std::ranges::find(engines(), name, &std::pair<std::string, SearchOptions>::first);
  assert(found != engines().end());
  return std::make_unique<EngineContestant>(make_search_engine(subgraph, reachable, found->second));
}

}  // namespace hlc::test
