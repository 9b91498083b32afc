#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/pose_lead.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/two_rounds.hpp"

namespace hlc::high_level_controller {

/// Logs each fact of a step once, not in every step in which it holds.
class OperatorNotes {
 public:
  /// Before the start: where the vehicle stands, once it is seen, and again whenever it begins or
  /// ceases to fit its route.
  void note_placement(const controller::Controller& controller, HlcActions& actions);

  /// Before a step of the experiment: a wrong pose lead (pose_lead.hpp).
  void note_pose_lead(const controller::Controller& controller,
                      const controller::Observation& observation, HlcActions& actions);

  /// Why the vehicle keeps its former plan, where that may last. An exhausted budget is logged once
  /// in a run; the summary counts how often.
  /// Also that the vehicle was disturbed (rules 4 to 6 of plan_in_force.hpp), that it has become
  /// stuck (coordination/waiting.hpp), or stays because no other controller has been received for
  /// kSilentSteps (coordination/missing.hpp); and once that more vehicles are coupled than the
  /// priority strategy can compare.
  void note_step(const controller::Controller& controller, const coordination::Report& report,
                 HlcActions& actions);

  /// With two rounds: that vehicles plan one after the other, once, and which vehicles are the
  /// reason; that this controller shares no more, and why.
  void note_rounds(VehicleId own, const controller::TwoRounds& rounds, HlcActions& actions);

  /// @param answer  the step's
  void note_fault(StepIndex step, const AnswerToList& answer, HlcActions& actions);

 private:
  enum class Disturbance : std::uint8_t { kNone, kUnseen, kOffPlan, kElsewhere };

  void note_disturbance(const controller::Controller& controller,
                        const coordination::Report& report, HlcActions& actions);

  std::optional<bool> logged_fit_;  ///< whether the vehicle fits, as last logged
  bool is_off_route_logged_{};
  Disturbance logged_disturbance_{};
  bool is_budget_logged_{};
  std::uint64_t cut_off_steps_{};  ///< consecutive, in which the vehicle was kept from driving off
  coordination::StuckNotice stuck_;
  bool is_not_shared_logged_{};
  bool is_end_of_sharing_logged_{};
  bool is_beyond_logged_{};
  std::string last_fault_;
  PoseLeadCheck pose_lead_;
};

}  // namespace hlc::high_level_controller
