#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "hlc_bridge/core/automaton_messages.hpp"
#include "hlc_bridge/core/weight_design.hpp"
#include "planner/controller/controller.hpp"

namespace hlc {

/// A request with all that planning on its subgraph needs, or with the reason why that cannot be.
struct PreparedRequest {
  AutomatonRequest request;
  std::shared_ptr<const Subgraph> subgraph;  ///< none: refused
  std::shared_ptr<const ReachableSets> reachable;
  std::string refusal;
};

/// Makes the subgraph and its tables: milliseconds for a dozen trims, a good part of a second for a
/// hundred, and for new weights the time that their maneuvers take (WeightDesign). Needs nothing of
/// a controller: on any thread, ahead.
/// @param base     the scenario's subgraph
/// @param weights  what makes and checks maneuvers; without, only what the automaton holds can be
/// asked for
/// @param stop     nobody wants it any more: it is refused soon
[[nodiscard]] PreparedRequest prepare(const Subgraph& base, const AutomatonRequest& request,
                                      std::size_t horizon_steps, WeightDesign* weights = nullptr,
                                      const std::stop_token& stop = {});

/// Which request of a vehicle is in force when. No clock, no thread.
///
/// A request that is refused changes nothing: neither what is in force nor what was accepted before
/// and waits for its time.
class Reconfiguration {
 public:
  /// What is told of it at once.
  /// @param now  the step before which it came
  [[nodiscard]] AutomatonAnswer take(PreparedRequest prepared, StepIndex now);

  /// To be called before every step. Switches the controller if a request holds from this step on,
  /// and says so.
  [[nodiscard]] std::optional<AutomatonAnswer> begin_step(Controller& controller, StepIndex step,
                                                          Nanoseconds t_now);

 private:
  std::uint64_t newest_id_{};
  std::optional<PreparedRequest> waiting_;
};

}  // namespace hlc
