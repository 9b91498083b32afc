#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "planner/controller/joint_planning.hpp"

namespace hlc::controller {

/// A step of one controller with two rounds of messages, however many vehicles there are: traffic,
/// from which each controller computes the plans of all that matter to it (JointPlanning), and
/// outcomes with the digests of the plans.
///
/// **Safety.** The rule is `strict` (coordination/commit.hpp); what differs is how i gets to know
/// new_j. It has computed it, and j's outcome shows the digest of what j has computed for itself:
/// if it is the same, new_j is known as surely as by a prediction. If it is another one, or did not
/// come, new_j was not received: new_i then comes into force only if it is free of everything that
/// j can reach. So any mixture of old and new plans is free pair by pair, whatever is lost, late or
/// repeated, whatever one controller has received and another has not, and whatever bits it
/// computes. In particular a plan that was computed around the wrong new plan of a predecessor does
/// not count as free of it.
///
/// **Who cannot share.** The way is chosen by the component, from its traffic: two rounds if all of
/// its vehicles can be planned for, otherwise the sequential way. Without loss all its members
/// choose the same, unless they know a vehicle by different scenarios. Where they do not, either
/// takes the other's message for what it is: a prediction instead of an outcome counts, with the
/// areas in it; an outcome instead of a prediction counts as not received. So whoever finds that
/// a coupled vehicle has not computed the same publishes its prediction, too, in the next step, as
/// does a vehicle that misses another one: it knows that nobody can compute its plan.
///
/// A controller whose digests differ from another's in a horizon of steps within kWindow although
/// both had the same inputs computes other plans (another mathematical library): it shares no more
/// (`differs_from`). Neither does one that is late too often, since planning for all takes as many
/// times longer as there are vehicles that matter (`is_too_slow`); all of its component plan one
/// after the other then, which needs more messages, and less of each processor. Both last as long
/// as the controller runs.
class TwoRounds {
 public:
  explicit TwoRounds(ControllerFactory others) : joint_(std::move(others)) {}

  /// The vehicle whose plans differ although the inputs agree; from then on no step has two rounds.
  [[nodiscard]] std::optional<VehicleId> differs_from() const { return differs_from_; }
  /// It was late in kMostLateSteps steps with two rounds within kWindow; from then on no step has
  /// two rounds.
  [[nodiscard]] bool is_too_slow() const { return is_too_slow_; }
  [[nodiscard]] bool shares() const { return !differs_from_ && !is_too_slow_; }
  /// Vehicles of the component that could not be planned for in this step.
  [[nodiscard]] std::span<const VehicleId> not_shared() const { return not_shared_; }

  /// Begins a step. Whether the own traffic is to hold its planning input.
  [[nodiscard]] bool offers(const Controller& own, const coordination::Traffic& traffic);

  /// Chooses whether this step has two rounds. @param own  after `couple`
  void choose(const Controller& own);
  [[nodiscard]] bool is_chosen() const { return is_chosen_; }

  /// Plans for all that matter, the own vehicle included. @pre is_chosen
  [[nodiscard]] coordination::Outcome plan(Controller& own);

  /// The new plans of coupled vehicles that are known now: computed and confirmed, or received.
  /// What `own` has respected without its being confirmed counts as not respected from now on. To
  /// be followed by `own.commit`. @pre plan
  [[nodiscard]] coordination::ReceivedMessages<coordination::Prediction> known_plans(
      Controller& own, const coordination::ReceivedMessages<coordination::Prediction>& predictions,
      const coordination::ReceivedMessages<coordination::Outcome>& outcomes);
  /// Instead of known_plans: the step did not end in time. To be followed by `own.fall_back`.
  void end_late(Controller& own);

  static constexpr std::size_t kMostLateSteps = 3;
  static constexpr std::uint64_t kWindow = 50;  ///< control steps

 private:
  /// Steps within kWindow of the last one.
  class RecentSteps {
   public:
    void add(StepIndex step);
    [[nodiscard]] std::size_t count() const { return steps_.size(); }

   private:
    std::vector<StepIndex> steps_;
  };

  void compare(VehicleId vehicle, bool is_same, const coordination::PlanDigests& received,
               const Controller& own);

  JointPlanning joint_;
  bool is_offered_{};
  bool is_chosen_{};
  std::vector<VehicleId> not_shared_;
  coordination::ReceivedMessages<coordination::Prediction> computed_;
  std::uint64_t inputs_{};  ///< digest
  /// In the last step with two rounds a coupled vehicle had not computed the same.
  bool is_prediction_needed_{};
  std::map<VehicleId, RecentSteps> differing_steps_;
  std::optional<VehicleId> differs_from_;
  RecentSteps late_steps_;
  bool is_too_slow_{};
};

}  // namespace hlc::controller
