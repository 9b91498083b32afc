#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/messages/instant.hpp"
#include "planner/controller/control_loop.hpp"

namespace hlc::high_level_controller {

/// One control step with its waits: takes the ControlLoop from phase to phase. A phase ends when
/// all awaited controllers have answered; unreachable ones are not awaited. With deadlines it ends
/// at its deadline at the latest; without, after kMessageTimeout of wall time. A controller that
/// has not answered then is not awaited until it sends traffic again.
class ControlStep {
 public:
  /// Whether messages of this vehicle's controller can arrive.
  using IsReachable = std::function<bool(VehicleId)>;

  ControlStep(controller::Controller& controller, const HlcRules& rules,
              controller::Stopwatch stopwatch)
      : loop_(controller, std::move(stopwatch)),
        deadlines_(rules.deadlines),
        warms_up_(rules.warms_up) {}

  void receive(const coordination::Traffic& message);
  void receive(const coordination::Prediction& message) { loop_.receive(message); }
  void receive(const coordination::Outcome& message) { loop_.receive(message); }

  /// The step of a list that is answered: messages for earlier steps are dropped.
  void advance_to(StepIndex step) { loop_.advance_to(step); }
  [[nodiscard]] coordination::Report stand_by(const controller::Observation& observation) {
    return loop_.stand_by(observation);
  }

  /// Publishes traffic. @pre not in a step
  void begin(const VehicleStateList& list, const controller::Observation& observation,
             const Instant& now, HlcActions& actions);
  [[nodiscard]] bool is_running() const { return loop_.is_in_step(); }

  /// Continues until there is something to publish, something is awaited, or the step has ended;
  /// then it returns the step's record (the report and the measured times).
  /// @param is_over  stop waiting
  /// @pre is_running()
  [[nodiscard]] std::optional<ReportRecord> advance(const Instant& now,
                                                    const IsReachable& is_reachable, bool is_over,
                                                    HlcActions& actions);

  /// ControlLoop::two_rounds
  [[nodiscard]] const controller::TwoRounds* two_rounds() const { return loop_.two_rounds(); }

  /// When to advance without an event. @pre is_running()
  [[nodiscard]] WakeUp wake_up() const;
  /// Number of awaited messages; 0: advance at once. @pre is_running()
  [[nodiscard]] std::size_t num_awaited() const { return num_awaited_; }

 private:
  [[nodiscard]] bool ends_phase(const Instant& now, const IsReachable& is_reachable,
                                HlcActions& actions);
  [[nodiscard]] controller::StepOutput end_phase(const Instant& now);
  [[nodiscard]] Nanoseconds deadline() const;

  controller::ControlLoop loop_;
  std::optional<StepDeadlines> deadlines_;
  VehicleStateList list_;  ///< of the step; only its times
  bool warms_up_;
  bool is_warm_{};
  Nanoseconds phase_ends_{};  ///< without deadlines; wall
  std::size_t num_awaited_{};
  std::set<VehicleId> silent_;  ///< not awaited until their traffic comes
  ReportRecord record_;
};

}  // namespace hlc::high_level_controller
