#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/controller/prepared_subgraph.hpp"

namespace hlc {

/// A subgraph that may be asked for, under every speed limit that may be laid upon it, ready to be
/// planned on. It never changes: it can be made on any thread.
///
/// Under a limit with which the request cannot be (maneuvers of J1 outrun both their trims) it is
/// the scenario's own subgraph under that limit: a limit is safety, and goes before what is asked
/// for.
class PreparedChoice {
 public:
  /// @param base        the scenario's; asked for without a limit it is `base` itself
  /// @param limits_mps  those that may hold
  /// @param automaton   as requested_subgraph
  /// @throws std::invalid_argument as requested_subgraph and prepare_subgraph, for the request
  /// without a limit, or for the scenario's own under one
  PreparedChoice(const PreparedSubgraph& base, const SubgraphRequest& request,
                 std::span<const double> limits_mps, std::size_t horizon_steps,
                 const SearchOptions& search,
                 const std::shared_ptr<const UniversalAutomaton>& automaton = nullptr);

  /// @pre `limit_mps` is none or one of those it was made for
  [[nodiscard]] const PreparedSubgraph& under(std::optional<double> limit_mps) const {
    return by_limit_.at(limit_mps);
  }
  /// All of them, once for every limit.
  [[nodiscard]] const std::map<std::optional<double>, PreparedSubgraph>& by_limit() const {
    return by_limit_;
  }

 private:
  std::map<std::optional<double>, PreparedSubgraph> by_limit_;
};

}  // namespace hlc
