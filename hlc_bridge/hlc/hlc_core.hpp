#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/settled_states.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

/// A command and, if it has points, its copies for later (copy_for_later).
struct AnswerToList {
  TrajectoryCommand command;
  std::vector<TrajectoryCommand> copies;
  /// Why the command is the last good one instead of the plan in force; empty if it is the plan.
  std::string fault;
};

/// The report of the answered step: with a fault it is a fallback.
[[nodiscard]] coordination::Report with_answer(coordination::Report report,
                                               const AnswerToList& answer);

/// The decisions of a controller's process, without network, clock or waiting: which lists count,
/// when the experiment begins, and how a plan becomes commands. Between `begins` and `answer` the
/// owner takes the controller through the phases of its step and exchanges the messages.
///
///     validate → observe → note → begins ─yes─► phases of controller() ─► answer
///                                        └────no──► controller().stand_by ─► answer
class HlcCore {
 public:
  explicit HlcCore(std::unique_ptr<controller::Controller> controller);

  [[nodiscard]] controller::Controller& controller() { return *controller_; }
  [[nodiscard]] const controller::Controller& controller() const { return *controller_; }

  /// Error in the list's period, in one line; empty: none. A list with an error must not be used.
  [[nodiscard]] std::string validate(const VehicleStateList& list) const;

  /// The list as an observation; nothing if its step was observed before: each step is done once.
  /// @pre validate(list) is empty
  [[nodiscard]] std::optional<controller::Observation> observe(const VehicleStateList& list);

  /// Remembers the list's states, which decide on the start. To be called for every observed list
  /// until the experiment begins.
  void note(const VehicleStateList& list, const controller::Observation& observation);

  /// Before the experiment has begun here: whether the vehicle may be planned, and commanded, to
  /// stand where it is. (Under kAtTrigger the owner sends such a command only after the trigger's
  /// time: until then the operator moves the vehicle.) A moving vehicle still drives the command of
  /// a former controller, or is moved by hand, and an unseen one may do so: it gets no plan, and no
  /// command that has an effect. The same holds for a vehicle that has not stood in the lists of a
  /// whole horizon, since the plan of its former controller may be to wait and then drive, and for
  /// one whose states cannot be trusted yet (SettledStates). Once commanded to stand, it is
  /// commanded so
  ///   * under kAtTrigger as long as it is not seen moving;
  ///   * under kTogether until the experiment begins.
  ///
  /// Under kTogether a vehicle that was seen in a list of the time's first SettledStates::kSpan may
  /// be commanded to stand at once: until then no vehicle can have settled, so there is no former
  /// plan. (The list must show the vehicle: a middleware that was restarted begins with the lists
  /// of the past, in which no states are valid yet.)
  [[nodiscard]] bool may_stand_by(const controller::Observation& observation, StartRule rule) const;

  /// The own vehicle's states can be trusted (SettledStates), as of the last list.
  [[nodiscard]] bool has_own_settled() const { return has_settled(controller_->options().vehicle); }

  /// True if the experiment has begun, or begins with this list: a plan is in force, the vehicle
  /// fits its route (Controller::fits_route), and
  ///   * under kTogether (`trigger` has no meaning then) every active vehicle has a usable state in
  ///     it and has settled (SettledStates), the same for all controllers;
  ///   * under kAtTrigger the list is not before the trigger's next_start, and shows the vehicle
  ///     standing.
  [[nodiscard]] bool begins(const VehicleStateList& list,
                            const controller::Observation& observation, StartRule rule,
                            const std::optional<Nanoseconds>& trigger);
  [[nodiscard]] bool has_begun() const { return has_begun_; }

  /// The plan in force as commands, in answer to the list; without a plan an answer that leaves the
  /// vehicle alone (command_of), as for a vehicle that is elsewhere (rule 6 of plan_in_force.hpp).
  /// The commands are checked (own_command_check.hpp). On a fault, the last good command is
  /// republished, which ends in standstill: the vehicle leaves its plan, and the controller treats
  /// it as a disturbed one. If no point of that command is within vehicle::kStopBound_m of where
  /// the list shows the vehicle, it is left alone instead. Plans beyond the lab's limits do not get
  /// this far: the controller drops them before it announces them. To be called once per list.
  [[nodiscard]] AnswerToList answer(const VehicleStateList& list);

 private:
  [[nodiscard]] AnswerToList answer_with(const coordination::Plan* plan,
                                         const VehicleStateList& list) const;
  [[nodiscard]] bool may_repeat(const TrajectoryCommand& command,
                                const VehicleStateList& list) const;
  [[nodiscard]] std::string validate(const AnswerToList& answer) const;
  [[nodiscard]] bool have_all_settled(const controller::Observation& observation) const;
  [[nodiscard]] bool has_settled(VehicleId vehicle) const;
  [[nodiscard]] const coordination::MeasuredVehicle* own(
      const controller::Observation& observation) const;

  std::unique_ptr<controller::Controller> controller_;
  std::map<VehicleId, SettledStates> settled_;
  std::optional<StepIndex> last_step_;
  std::size_t stood_lists_{};  ///< consecutive, up to the last one
  bool is_seen_from_begin_{};  ///< in a list of the time's first SettledStates::kSpan
  std::optional<TrajectoryCommand> last_good_;
  bool has_begun_{};
};

}  // namespace hlc::high_level_controller
