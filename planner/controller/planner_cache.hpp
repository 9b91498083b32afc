#pragma once

#include <memory>
#include <utility>

#include "planner/controller/prepared_subgraph.hpp"
#include "planner/search/planner.hpp"

namespace hlc {

/// What searches on a prepared subgraph. The planner is a cache: what it finds depends on the
/// problem alone. So a copy shares the subgraph and its tables, which never change, and makes a
/// planner of its own when it first searches.
class PlannerCache {
 public:
  /// @throws std::invalid_argument as make_horizon_planner
  PlannerCache(PreparedSubgraph on, SearchOptions search)
      : on_(std::move(on)), search_(std::move(search)), planner_(make()) {}
  PlannerCache(const PlannerCache& other) : on_(other.on_), search_(other.search_) {}
  PlannerCache& operator=(const PlannerCache& other) { return *this = PlannerCache(other); }
  PlannerCache(PlannerCache&&) = default;
  PlannerCache& operator=(PlannerCache&&) = default;
  ~PlannerCache() = default;

  [[nodiscard]] const PreparedSubgraph& on() const { return on_; }

  void set_max_expansions(std::size_t max_expansions) {
    search_.max_expansions = max_expansions;
    planner_.reset();
  }

  /// Until the next change of this object.
  [[nodiscard]] HorizonPlanner& planner() {
    if (!planner_) planner_ = make();
    return *planner_;
  }

 private:
  [[nodiscard]] std::unique_ptr<HorizonPlanner> make() const {
    return make_horizon_planner(*on_.subgraph, *on_.reachable, search_, on_.tables);
  }

  PreparedSubgraph on_;
  SearchOptions search_;
  std::unique_ptr<HorizonPlanner> planner_;
};

}  // namespace hlc
