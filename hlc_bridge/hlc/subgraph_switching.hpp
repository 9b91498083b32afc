#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/reconfiguration.hpp"
#include "planner/policy/subgraph_selector.hpp"

namespace hlc::high_level_controller {

/// The subgraph that a controller plans on, step by step: requests of the operator from their
/// arrival until they are in force (Reconfiguration), zones and policies (SubgraphSelector). Every
/// request is answered, and every switch is logged.
class SubgraphSwitching {
 public:
  /// @pre check_reconfiguration throws nothing
  SubgraphSwitching(const controller::Controller& controller,
                    const policy::ReconfigurationSettings& settings)
      : selector_(controller, settings) {}

  /// Base for the preparation of requests.
  [[nodiscard]] RequestBase request_base(const controller::Controller& controller) const;

  /// Requests are prepared in order, one at a time; of more than kMaxWaiting the first are dropped.
  /// As many, and the one in work, are prepared between two steps: the rest wait for the next one.
  void receive(const AutomatonRequest& request);
  void receive(const PreparedRequest& prepared);
  /// At every advance.
  void prepare_next(HlcActions& actions);
  /// A request is being prepared, or is the next one.
  [[nodiscard]] bool is_preparing() const { return is_in_work_ || has_next(); }

  /// Before every step of the controller, also before the experiment has begun: switches the
  /// controller.
  /// @param first_step  of the experiment; none: it has not begun
  void begin_step(controller::Controller& controller, const VehicleStateList& list, StepIndex step,
                  std::optional<StepIndex> first_step, HlcActions& actions);

  [[nodiscard]] bool looks_ahead() const { return selector_.looks_ahead(); }
  /// After every step of the experiment, when the vehicle's command is published.
  void end_step(const controller::Controller& controller, const coordination::Report& report,
                bool may_look_ahead) {
    selector_.end_step(controller, report, may_look_ahead);
  }

  static constexpr std::size_t kMaxWaiting = 16;

 private:
  [[nodiscard]] bool has_next() const {
    return !waiting_.empty() && prepared_.size() <= kMaxWaiting;
  }

  policy::SubgraphSelector selector_;
  Reconfiguration reconfiguration_;
  std::deque<AutomatonRequest> waiting_;
  bool is_in_work_{};
  std::vector<PreparedRequest> prepared_;  ///< since the last step
};

}  // namespace hlc::high_level_controller
