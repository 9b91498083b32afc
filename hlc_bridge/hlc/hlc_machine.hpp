#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/hlc/command_copies.hpp"
#include "hlc_bridge/hlc/control_step.hpp"
#include "hlc_bridge/hlc/experiment_start.hpp"
#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/hlc/life_cycle.hpp"
#include "hlc_bridge/hlc/operator_notes.hpp"
#include "hlc_bridge/hlc/subgraph_switching.hpp"
#include "hlc_bridge/machine/stamp_check.hpp"
#include "hlc_bridge/messages/instant.hpp"

namespace hlc::high_level_controller {

struct HlcSettings {
  HlcRules rules;
  Nanoseconds startup_timeout{30 * kNanosecondsPerSecond};
  policy::ReconfigurationSettings reconfiguration;  ///< zones and policies
  controller::Stopwatch cpu_time{};                 ///< of the calling thread; absent: 0
};

/// The decisions of one controller's process, as a machine (machine/machine.hpp): takes state lists
/// from the middleware, steps the controller, exchanges messages with the other controllers between
/// its phases, answers every list with a command.
///
///     idle ─list─► gathering ─► preparing ─► stepping ─command─► reporting ─► after step ─► idle
///       │             all ready    requested    └── or standing by ──┘        looking ahead
///       └─► exit                   subgraphs
///
/// * *Gathering* waits under StartRule::kTogether until all controllers are matched, since messages
///   sent before a match are lost.
/// * *Preparing* waits, if the rules require it, for requested subgraphs that are being prepared.
/// * *Stepping* is a ControlStep: traffic is published before anything else is computed.
/// * *Reporting* determines which vehicles it waits for, once the command is published; then come
///   the report, the drawings and AfterStep.
/// * *After a step* policies look ahead, when everything is published. The copy of the command is
///   published first: a controller that dies in between would leave its vehicle half a plan.
///
/// Every wait ends: at a deadline, when the awaited participant has left the domain, or after
/// kMessageTimeout.
///
/// **Ends** (LifeCycle) between two steps; also with kExitGood after the stop symbol or a
/// StopSignal, with kExitBadInput if the lab's period is not the automaton's step (then the lab
/// control is requested to stop all vehicles). On a stop, a running step is aborted at once, and no
/// further command is sent. After the stop symbol the vehicle brakes and then listens again: it
/// must receive nothing. After a StopSignal the vehicle keeps its whole plan: the copy of the last
/// command is still published.
class HlcMachine {
 public:
  using Event = HlcEvent;
  using Action = HlcAction;

  /// @param controller  of the vehicle
  /// @throws std::invalid_argument if its plans are longer than a vehicle follows a command
  HlcMachine(const HlcSettings& settings, std::unique_ptr<controller::Controller> controller);

  [[nodiscard]] const controller::Controller& controller() const { return core_.controller(); }
  /// Base for the preparation of requested subgraphs.
  [[nodiscard]] RequestBase request_base() const {
    return subgraphs_.request_base(core_.controller());
  }

  void on(Event event);
  [[nodiscard]] std::vector<Action> advance(const Instant& now);
  [[nodiscard]] WakeUp wake_up() const;
  /// In a step the number of awaited messages; otherwise only urgent events count: all but those of
  /// the other controllers.
  [[nodiscard]] std::size_t awaited() const;
  [[nodiscard]] std::optional<int> exit_code() const;

 private:
  enum class Phase : std::uint8_t {
    kIdle,
    kGathering,
    kPreparing,
    kStepping,
    kReporting,
    kAfterStep,
    kRefusing,
  };

  /// The list being answered.
  struct Current {
    VehicleStateList list;
    controller::Observation observation;
    bool is_running{};  ///< a step of the experiment, or one before it
    Nanoseconds reconfiguring_ns{};
    ReportRecord record;
    Nanoseconds patience{};  ///< wall time at which a wait ends; kPreparing, kRefusing
  };

  struct Ending {
    bool is_asked{};        ///< by the stop symbol or a StopSignal
    std::string unwritten;  ///< what AfterStep failed to do
    std::optional<int> code;
  };

  void take(const HlcPeers& peers) { life_.receive(peers); }
  void take(VehicleStateList&& list);
  void take(const SystemTrigger& trigger);
  void take(const RunState& state);
  void take(const coordination::Traffic& traffic);
  void take(const coordination::Prediction& prediction) { step_.receive(prediction); }
  void take(const coordination::Outcome& outcome) { step_.receive(outcome); }
  void take(const AutomatonRequest& request);
  void take(const PreparedRequest& prepared) { subgraphs_.receive(prepared); }
  void take(const Parameter& answer) { life_.receive(answer); }
  void take(const machine::StopSignal& /*signal*/) { ending_.is_asked = true; }
  void take(const LostMessage& message) { actions_.warn(message.line); }
  void take(const AfterStepFailure& failure);

  // One phase each; true if the next one can follow in the same advance.
  [[nodiscard]] bool go_on(const Instant& now);
  void drop_lists_of_the_future(const Instant& now);
  [[nodiscard]] bool take_list(const Instant& now);
  [[nodiscard]] bool gather(const Instant& now);
  [[nodiscard]] bool prepare(const Instant& now);
  [[nodiscard]] bool step(const Instant& now);
  [[nodiscard]] bool report();
  [[nodiscard]] bool after_step(const Instant& now);
  [[nodiscard]] bool refuse(const Instant& now);

  [[nodiscard]] bool has_started() const { return start_.time().has_value(); }
  [[nodiscard]] bool ends(const Instant& now);
  [[nodiscard]] bool may_stand_by() const;
  [[nodiscard]] bool leaves_vehicle_alone(const coordination::Report& report) const;
  void disregard_own_vehicle();
  void enter_experiment();
  void finish(ReportRecord record, const Instant& now);
  void publish_command(coordination::Report& report, const Instant& now);

  HlcRules rules_;
  controller::Stopwatch cpu_time_;
  HlcCore core_;
  LifeCycle life_;
  ExperimentStart start_;
  ControlStep step_;
  CommandCopies copies_;
  SubgraphSwitching subgraphs_;
  OperatorNotes notes_;
  HlcActions actions_;  ///< since the last advance

  machine::StampCheck stamp_check_;     ///< of lists
  std::deque<VehicleStateList> lists_;  ///< not answered yet, the newest kMostLists
  Phase phase_{Phase::kIdle};
  Current current_;  ///< in all phases but kIdle
  Ending ending_;
};

}  // namespace hlc::high_level_controller
