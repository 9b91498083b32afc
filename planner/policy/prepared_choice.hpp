#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "planner/automaton/requested_subgraph.hpp"
#include "planner/controller/prepared_subgraph.hpp"

namespace hlc::policy {

/// A request under a speed limit: the lower of the limit and its own holds. Where the request is
/// infeasible under the limit (maneuvers of J1 outrun both their trims) the base itself is used
/// under it: a limit is for safety, and has precedence over requests.
/// @param automaton  as requested_subgraph
/// @throws std::invalid_argument if the base is infeasible under the limit, too
[[nodiscard]] std::shared_ptr<const automaton::Subgraph> limited_subgraph(
    const automaton::Subgraph& base, const SubgraphRequest& request, double limit_mps,
    std::size_t horizon_steps,
    const std::shared_ptr<const automaton::UniversalAutomaton>& automaton = nullptr);

/// A subgraph that may be requested, under every possible speed limit, ready to be planned on. It
/// never changes: it can be made on any thread.
class PreparedChoice {
 public:
  /// @param base        the scenario's; the empty request without a limit is `base` itself
  /// @param limits_mps  the possible limits
  /// @param automaton   as requested_subgraph
  /// @throws std::invalid_argument as requested_subgraph, limited_subgraph and prepare_subgraph
  PreparedChoice(const controller::PreparedSubgraph& base, const SubgraphRequest& request,
                 std::span<const double> limits_mps, std::size_t horizon_steps,
                 const search::SearchOptions& search,
                 const std::shared_ptr<const automaton::UniversalAutomaton>& automaton = nullptr);

  /// @pre `limit_mps` is none or one of `limits_mps`
  [[nodiscard]] const controller::PreparedSubgraph& under(std::optional<double> limit_mps) const {
    return by_limit_.at(limit_mps);
  }
  /// Most steps from a trim that is too fast for one of the limits to one that is not.
  [[nodiscard]] std::size_t steps_to_slow_down() const { return steps_to_slow_down_; }
  /// Of the maneuvers that may be planned without a limit.
  [[nodiscard]] double top_speed_mps() const { return top_speed_mps_; }

  /// All prepared subgraphs, one for every limit.
  [[nodiscard]] const std::map<std::optional<double>, controller::PreparedSubgraph>& by_limit()
      const {
    return by_limit_;
  }

 private:
  std::map<std::optional<double>, controller::PreparedSubgraph> by_limit_;
  std::size_t steps_to_slow_down_{};
  double top_speed_mps_{};
};

}  // namespace hlc::policy
