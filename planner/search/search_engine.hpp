#pragma once

#include <functional>

#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// What searches behind the planner: one call per problem. Not safe for two threads at once.
class SearchEngine {
 public:
  virtual ~SearchEngine() = default;

  /// @param stop  asked now and then, the first time before the first expansion; once it says true
  ///              the search gives up with `kBudget`
  [[nodiscard]] virtual SearchResult search(const HorizonProblem& problem,
                                            const std::function<bool()>& stop) = 0;
};

/// For `SearchEngine::search`: only the problem and the engine's own budget end the search.
[[nodiscard]] inline bool never_stop() { return false; }

}  // namespace hlc
