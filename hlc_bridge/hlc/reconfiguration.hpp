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

namespace hlc {

/// What requests are prepared on and for, the same for all requests of a run.
struct RequestBase {
  PreparedSubgraph subgraph;       ///< the scenario's
  std::vector<double> limits_mps;  ///< that may be laid on what is asked for (SubgraphSelector)
  std::size_t horizon_steps{};
  SearchOptions search;
};

/// A request with all that planning on its subgraph needs, or with the reason why that cannot be.
struct PreparedRequest {
  AutomatonRequest request;
  std::shared_ptr<const PreparedChoice> choice;  ///< none: refused
  std::string refusal;
};

/// Makes the subgraph and its tables, under every limit: milliseconds for a dozen trims, seconds
/// for a hundred, and for new weights the time that their maneuvers take (WeightDesign). Needs
/// nothing of a controller: on any thread, ahead.
/// @param weights  what makes and checks maneuvers; without, only what the automaton holds can be
/// asked for
/// @param stop     nobody wants it any more: it is refused soon
[[nodiscard]] PreparedRequest prepare(const RequestBase& base, const AutomatonRequest& request,
                                      WeightDesign* weights = nullptr,
                                      const std::stop_token& stop = {});

/// Which request of a vehicle is in force when. No clock, no thread.
///
/// A request that is refused changes nothing: neither what is in force nor what was accepted before
/// and waits for its time.
class Reconfiguration {
 public:
  /// What is told of it at once, and of an accepted one that it takes the place of.
  /// @param now  the step before which it came
  [[nodiscard]] std::vector<AutomatonAnswer> take(PreparedRequest prepared, StepIndex now);

  /// To be called before every step, before SubgraphSelector::begin_step. Passes the request to
  /// `selector` if a request holds from this step on, and says so; the answer's text, the name of
  /// what is then planned on, is known only after that.
  [[nodiscard]] std::optional<AutomatonAnswer> begin_step(SubgraphSelector& selector,
                                                          StepIndex step, Nanoseconds t_now);

 private:
  std::uint64_t newest_id_{};
  std::optional<PreparedRequest> waiting_;
};

}  // namespace hlc
