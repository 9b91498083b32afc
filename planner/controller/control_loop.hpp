#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/controller/two_rounds.hpp"

namespace hlc::controller {

enum class MessageKind { kTraffic, kPrediction, kOutcome };

/// Messages to publish now; at the end of the step its report. With two rounds (TwoRounds) the
/// outcome comes without a prediction.
struct StepOutput {
  std::optional<coordination::Traffic> traffic{};
  std::optional<coordination::Prediction> prediction{};
  std::optional<coordination::Outcome> outcome{};
  std::optional<coordination::Report> report{};
};

/// Senders whose messages the next phase needs and has not received.
struct Awaited {
  MessageKind kind{};
  std::vector<VehicleId> from;
};

/// What a control step waits for.
enum class StepPhase {
  kIdle,          ///< not in a step
  kTraffic,       ///< traffic of all other active vehicles
  kPredecessors,  ///< predictions of the coupled vehicles that plan before this one; with two
                  ///< rounds nothing
  kCommit,  ///< predictions of the coupled vehicles (strict), outcomes of the component (agreed);
            ///< with two rounds outcomes of the coupled vehicles
};

/// Processor time in nanoseconds from any origin; for measuring only.
using Stopwatch = std::function<std::uint64_t()>;

/// The sequence of one control step, for every owner of a controller: observe, publish traffic,
/// couple, plan, publish prediction (and outcome, if the commit rule needs votes), commit, report.
/// No clock, no waiting, no thread.
///
///     output = begin(observation)
///     while is_in_step: publish output; wait until `awaited` is empty or the phase's deadline has
///                       passed, passing on to `receive` what arrives; output = proceed()
///
/// Each phase works with the messages received so far. Messages are kept by step and sender, so a
/// peer may be a phase or some steps ahead; a message is dropped if its step is over, if it is too
/// far ahead to come from a sane sender, or if it has the own name. The last message of a sender in
/// a step counts.
class ControlLoop {
 public:
  /// @param controller  not owned; must outlive this object; between the steps its owner may change
  /// it freely (switch_to, set_minimal_risk_stop)
  /// @param stopwatch   measures planning_ns; absent: 0
  /// @param rounds      kTwo has two rounds where it is possible, if the controller can plan for
  /// the others (ControllerOptions::others), and its commit rule needs no votes
  explicit ControlLoop(Controller& controller, Stopwatch stopwatch = {},
                       Rounds rounds = Rounds::kTwo);

  [[nodiscard]] Controller& controller() { return *controller_; }
  [[nodiscard]] const Controller& controller() const { return *controller_; }

  /// Begins a step; outputs traffic. @pre as for Controller::observe; not in a step
  [[nodiscard]] StepOutput begin(const Observation& observation);
  /// Controller::stand_by, a step before the start. @pre not in a step
  [[nodiscard]] coordination::Report stand_by(const Observation& observation);
  /// The step of the next `begin`, if it is known earlier: messages for the steps before are
  /// dropped. Also to be called in a step that has neither `begin` nor `stand_by`.
  void advance_to(StepIndex step);

  /// Kept as it is: several loops may receive one message.
  template <class Message>
  void receive(std::shared_ptr<const Message> message);
  void receive(const coordination::Traffic& message);
  void receive(const coordination::Prediction& message);
  void receive(const coordination::Outcome& message);

  [[nodiscard]] StepPhase phase() const { return phase_; }
  [[nodiscard]] bool is_in_step() const { return phase_ != StepPhase::kIdle; }
  /// By sender; without the own vehicle. Empty if nothing is awaited. @pre in a step
  [[nodiscard]] Awaited awaited() const;
  /// Controller::warm_up, while the others' messages are on their way. @pre in the first phase
  std::uint64_t warm_up() { return controller_->warm_up(); }

  /// The next phase, with the messages received so far. @pre in a step
  /// @param shared  of all controllers that are stepped together; absent: alone
  [[nodiscard]] StepOutput proceed(SharedStep* shared = nullptr);
  /// Ends the step instead; outputs the report: the plan in force stays. @pre in a step
  [[nodiscard]] StepOutput fall_back(coordination::FallbackReason reason);

  /// nullptr: all steps are sequential.
  [[nodiscard]] const TwoRounds* two_rounds() const {
    return two_rounds_ ? &*two_rounds_ : nullptr;
  }

  /// Duration of planning in the last step, by the stopwatch.
  [[nodiscard]] std::uint64_t planning_ns() const { return planning_ns_; }

 private:
  template <class Message>
  using Received = std::map<StepIndex, coordination::ReceivedMessages<Message>>;

  template <class Message>
  [[nodiscard]] const coordination::ReceivedMessages<Message>& received() {
    return std::get<Received<Message>>(received_)[step_];
  }
  template <class Message>
  [[nodiscard]] Awaited missing_of(MessageKind kind, const std::vector<VehicleId>& from) const;
  [[nodiscard]] Awaited missing_plans_of(MessageKind kind,
                                         const std::vector<VehicleId>& from) const;
  [[nodiscard]] bool needs_votes() const;
  [[nodiscard]] bool is_in_two_rounds() const { return two_rounds_ && two_rounds_->is_chosen(); }
  void couple(SharedStep* shared);
  [[nodiscard]] StepOutput commit();
  [[nodiscard]] StepOutput plan();

  Controller* controller_;
  Stopwatch stopwatch_;
  StepPhase phase_{StepPhase::kIdle};
  StepIndex step_;
  std::vector<VehicleId> active_;
  std::uint64_t planning_ns_{};
  std::optional<TwoRounds> two_rounds_;
  std::tuple<Received<coordination::Traffic>, Received<coordination::Prediction>,
             Received<coordination::Outcome>>
      received_;
};

}  // namespace hlc::controller
