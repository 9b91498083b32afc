#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "planner/automaton/requested_subgraph.hpp"
#include "planner/controller/prepared_subgraph.hpp"

namespace hlc {

/// What a request is under a speed limit: the lower of the limit and its own holds. Where the
/// request cannot be under the limit (maneuvers of J1 outrun both their trims) it is the base
/// itself under it: a limit is safety, and goes before what is asked for.
/// @param automaton  as requested_subgraph
/// @throws std::invalid_argument if not even that can be
[[nodiscard]] std::shared_ptr<const Subgraph> limited_subgraph(
    const Subgraph& base, const SubgraphRequest& request, double limit_mps,
    std::size_t horizon_steps,
    const std::shared_ptr<const UniversalAutomaton>& automaton = nullptr);

/// A subgraph that may be asked for, under every speed limit that may be laid upon it, ready to be
/// planned on. It never changes: it can be made on any thread.
class PreparedChoice {
 public:
  /// @param base        the scenario's; asked for without a limit it is `base` itself
  /// @param limits_mps  those that may hold
  /// @param automaton   as requested_subgraph
  /// @throws std::invalid_argument as requested_subgraph, limited_subgraph and prepare_subgraph
  PreparedChoice(const PreparedSubgraph& base, const SubgraphRequest& request,
                 std::span<const double> limits_mps, std::size_t horizon_steps,
                 const SearchOptions& search,
                 const std::shared_ptr<const UniversalAutomaton>& automaton = nullptr);

  /// @pre `limit_mps` is none or one of those it was made for
  [[nodiscard]] const PreparedSubgraph& under(std::optional<double> limit_mps) const {
    return by_limit_.at(limit_mps);
  }
  /// Most steps from a trim that is too fast for one of the limits to one that is not.
  [[nodiscard]] std::size_t steps_to_slow_down() const { return steps_to_slow_down_; }
  /// Of the maneuvers that may be planned without a limit.
  [[nodiscard]] double top_speed_mps() const { return top_speed_mps_; }

  /// All of them, once for every limit.
  [[nodiscard]] const std::map<std::optional<double>, PreparedSubgraph>& by_limit() const {
    return by_limit_;
  }

 private:
  std::map<std::optional<double>, PreparedSubgraph> by_limit_;
  std::size_t steps_to_slow_down_{};
  double top_speed_mps_{};
};

}  // namespace hlc
