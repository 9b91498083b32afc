#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "hlc_bridge/core/messages.hpp"
#include "hlc_bridge/core/observation.hpp"
#include "hlc_bridge/core/settled_states.hpp"
#include "planner/controller/controller.hpp"

namespace hlc {

/// A command and, unless it is one to stand, the same again for later (copy_for_later).
struct AnswerToList {
  TrajectoryCommand command;
  std::optional<TrajectoryCommand> copy;
};

/// What a controller's process decides, without network, clock or waiting: which lists count, when
/// the experiment begins, and how a plan becomes commands. Between `begins` and `answer` the owner
/// takes the controller through the phases of its step and exchanges the messages.
///
///     problem_with → observe → note → begins ─yes─► phases of controller() ─► answer
///                                        └────no──► controller().stand_by ─► answer
class HlcCore {
 public:
  explicit HlcCore(std::unique_ptr<Controller> controller);

  [[nodiscard]] Controller& controller() { return *controller_; }
  [[nodiscard]] const Controller& controller() const { return *controller_; }

  /// What is wrong with the list's period, in one line; empty if nothing is. Such a list must not
  /// be used.
  [[nodiscard]] std::string problem_with(const VehicleStateList& list) const;

  /// What the list tells; nothing if its step was observed before: each step is done once.
  /// @pre nothing is wrong with the list
  [[nodiscard]] std::optional<Observation> observe(const VehicleStateList& list);

  /// Remembers the list's states, by which the start is decided. To be called for every list until
  /// the experiment begins.
  void note(const VehicleStateList& list);

  /// True if the experiment has begun, or begins with this list: a plan is in force,
  /// and in logical time (`trigger` says nothing then) every active vehicle has a usable state in
  /// it and has settled (SettledStates), the same for all controllers; in real time the list is not
  /// before the trigger's next_start.
  [[nodiscard]] bool begins(const VehicleStateList& list, const Observation& observation,
                            bool logical_time, const std::optional<Nanoseconds>& trigger);
  [[nodiscard]] bool has_begun() const { return has_begun_; }

  /// The plan in force as commands, in answer to the list; without a plan a command to stand.
  [[nodiscard]] AnswerToList answer(const VehicleStateList& list) const;

 private:
  [[nodiscard]] bool have_all_settled(const Observation& observation) const;

  std::unique_ptr<Controller> controller_;
  std::map<VehicleId, SettledStates> settled_;
  std::optional<StepIndex> last_step_;
  bool has_begun_{};
};

}  // namespace hlc
