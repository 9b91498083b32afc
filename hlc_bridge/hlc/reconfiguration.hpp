#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hlc_bridge/hlc/weight_design.hpp"
#include "hlc_bridge/messages/automaton_messages.hpp"
#include "planner/policy/subgraph_selector.hpp"

namespace hlc::high_level_controller {

/// Base of the preparation of requests, the same for all requests of a run.
struct RequestBase {
  controller::PreparedSubgraph subgraph;  ///< the scenario's
  std::vector<double> limits_mps;         ///< that may apply to a request (SubgraphSelector)
  std::size_t horizon_steps{};
  search::SearchOptions search;
};

/// A request with everything that planning on its subgraph needs, or with the reason for its
/// refusal.
struct PreparedRequest {
  AutomatonRequest request;
  std::shared_ptr<const policy::PreparedChoice> choice;  ///< none: refused
  std::string refusal;
};

/// Makes the subgraph and its tables, under every limit: milliseconds for a dozen trims, seconds
/// for a hundred, and for new weights the time that their maneuvers take (WeightDesign).
/// Independent of the controller: may run on any thread, in advance.
/// @param weights  makes and checks maneuvers; without it, only maneuvers of the automaton can be
/// requested
/// @param stop     the request is no longer needed: it is refused soon
[[nodiscard]] PreparedRequest prepare(const RequestBase& base, const AutomatonRequest& request,
                                      WeightDesign* weights = nullptr,
                                      const std::stop_token& stop = {});

/// Decides which request of a vehicle is in force when. No clock, no thread.
///
/// A refused request changes nothing: neither what is in force nor an accepted request that waits
/// for its time.
class Reconfiguration {
 public:
  /// Answers to be sent at once: to the request, and to an accepted one that it replaces.
  /// @param now  the step before which the request was received
  [[nodiscard]] std::vector<AutomatonAnswer> take(PreparedRequest prepared, StepIndex now);

  /// To be called before every step, before SubgraphSelector::begin_step. If a request holds from
  /// this step on, passes it to `selector` and returns the answer; the answer's text, the name of
  /// the subgraph then planned on, is known only after that.
  [[nodiscard]] std::optional<AutomatonAnswer> begin_step(policy::SubgraphSelector& selector,
                                                          StepIndex step, Nanoseconds t_now);

 private:
  std::uint64_t newest_id_{};
  std::optional<PreparedRequest> waiting_;
};

}  // namespace hlc::high_level_controller
