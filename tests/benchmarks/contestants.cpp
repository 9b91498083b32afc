#include "tests/benchmarks/contestants.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "planner/scenario/engine_choice.hpp"
#include "planner/search/search_engine.hpp"
#include "tests/benchmarks/plain_search.hpp"

namespace hlc::test {
namespace {

constexpr std::size_t kNoBudget = 1'000'000'000;

/// Those of scenarios, and the textbook's cost-to-go.
const std::vector<std::pair<std::string, search::SearchOptions>>& engines() {
  static const auto all = [] {
    std::vector<std::pair<std::string, search::SearchOptions>> named{
        {"best_first_straight_line",
         {search::Engine::kBestFirst, search::CostToGo::kStraightLine, kNoBudget}}};
    for (const scenario::NamedEngine& one : scenario::engines()) {
      named.push_back({std::string(one.name),
                       {one.engine, search::CostToGo::kReachable, kNoBudget, {}, one.factory}});
    }
    return named;
  }();
  return all;
}

Solved solved_by(const search::SearchResult& result) {
  return {.has_plan = result.status == search::SearchStatus::kOptimal,
          .stopped_early = result.status == search::SearchStatus::kBudget ||
                           result.reason == search::NoPath::kBudget,
          .cost = result.cost,
          .generated = result.generated,
          .expanded = result.expanded};
}

class PlainContestant final : public Contestant {
 public:
  explicit PlainContestant(const automaton::Subgraph& subgraph) : search_(subgraph) {}
  void solve(const search::HorizonProblem& problem) override { result_ = search_.search(problem); }
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
  explicit EngineContestant(std::unique_ptr<search::SearchEngine> engine)
      : engine_(std::move(engine)) {}
  void solve(const search::HorizonProblem& problem) override {
    engine_->search(problem, stop_, result_);
  }
  [[nodiscard]] Solved solved() const override { return solved_by(result_); }

 private:
  std::unique_ptr<search::SearchEngine> engine_;
  std::function<bool()> stop_{search::never_stop};
  search::SearchResult result_;
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

std::unique_ptr<Contestant> make_contestant(const std::string& name,
                                            const automaton::Subgraph& subgraph,
                                            const automaton::ReachableSets& reachable) {
  if (name == kPlain) return std::make_unique<PlainContestant>(subgraph);
  const auto found =
      std::ranges::find(engines(), name, &std::pair<std::string, search::SearchOptions>::first);
  assert(found != engines().end());
  return std::make_unique<EngineContestant>(
      search::make_search_engine(subgraph, reachable, found->second));
}

}  // namespace hlc::test
