#pragma once

#include <memory>
#include <utility>

#include "planner/controller/prepared_subgraph.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::controller {

/// The search on a prepared subgraph. The engine is a cache: its result depends on the problem
/// alone. So a copy shares the subgraph and its tables, which never change, and makes its own
/// search engine when it first searches.
class EngineCache {
 public:
  /// @throws std::invalid_argument as make_search_engine
  EngineCache(PreparedSubgraph on, search::SearchOptions search)
      : on_(std::move(on)), search_(std::move(search)), engine_(make()) {}
  EngineCache(const EngineCache& other) : on_(other.on_), search_(other.search_) {}
  EngineCache& operator=(const EngineCache& other) { return *this = EngineCache(other); }
  EngineCache(EngineCache&&) = default;
  EngineCache& operator=(EngineCache&&) = default;
  ~EngineCache() = default;

  [[nodiscard]] const PreparedSubgraph& on() const { return on_; }

  void set_max_expansions(std::size_t max_expansions) {
    search_.max_expansions = max_expansions;
    engine_.reset();
  }

  /// Expansions of 1 / `share` of the budget: a multiple of those after which a search may be
  /// stopped, unless it is all of it.
  [[nodiscard]] std::size_t max_expansions(std::size_t share) const {
    if (share == 1) return search_.max_expansions;
    return search_.max_expansions / share / search::kExpansionsPerStop * search::kExpansionsPerStop;
  }

  /// A search with at most so many.
  [[nodiscard]] search::SearchResult search(const search::HorizonProblem& problem,
                                            std::size_t share) {
    if (share == 1) return engine().search(problem);
    std::size_t left = max_expansions(share) / search::kExpansionsPerStop;
    return engine().search(problem, [&left] { return left-- == 0; });
  }

  /// Valid until the next change of this object.
  [[nodiscard]] search::SearchEngine& engine() {
    if (!engine_) engine_ = make();
    return *engine_;
  }

 private:
  [[nodiscard]] std::unique_ptr<search::SearchEngine> make() const {
    return search::make_search_engine(*on_.subgraph, *on_.reachable, search_, on_.tables);
  }

  PreparedSubgraph on_;
  search::SearchOptions search_;
  std::unique_ptr<search::SearchEngine> engine_;
};

}  // namespace hlc::controller
