#include "hlc_bridge/hlc/operator_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>
#include <span>
#include <utility>

#include "hlc_bridge/hlc/placement_line.hpp"

namespace hlc::high_level_controller {
namespace {

/// Why this step has no two rounds. A message without planning input does not name its reason.
std::string not_shared_line(VehicleId own, std::span<const VehicleId> not_shared) {
  const bool is_own = std::ranges::find(not_shared, own) != not_shared.end();
  const std::string cause =
      is_own ? fmt::format(
                   "the others cannot plan for this vehicle {}: it is not seen, misses another "
                   "controller, is off its route, or changes its subgraph",
                   own.value)
             : fmt::format(
                   "vehicle{} {} cannot be planned for here: not seen, missing another controller, "
                   "off the route, changing the subgraph, no longer in two rounds, or with another "
                   "scenario or automaton",
                   not_shared.size() == 1 ? "" : "s",
                   fmt::join(not_shared | std::views::transform(&VehicleId::value), ", "));
  return "no two rounds in this step, vehicles plan one after the other: " + cause +
         " (logged once)";
}

}  // namespace

void OperatorNotes::note_placement(const controller::Controller& controller, HlcActions& actions) {
  const bool fits = controller.fits_route();
  if (!controller.placement() || logged_fit_ == fits) return;
  logged_fit_ = fits;
  actions.add(fits ? machine::info(placement_line(controller))
                   : machine::error(placement_line(controller)));
}

void OperatorNotes::note_pose_lead(const controller::Controller& controller,
                                   const controller::Observation& observation,
                                   HlcActions& actions) {
  if (const auto line = pose_lead_.note(controller, observation)) actions.warn(*line);
}

void OperatorNotes::note_step(const controller::Controller& controller,
                              const coordination::Report& report, HlcActions& actions) {
  const bool is_off_route = report.reason == coordination::FallbackReason::kOffRoute;
  const bool is_over_budget = report.reason == coordination::FallbackReason::kBudget;
  if ((is_off_route && !is_off_route_logged_) || (is_over_budget && !is_budget_logged_)) {
    actions.error(stuck_line(controller, report.reason));
  }
  is_off_route_logged_ = is_off_route;
  note_disturbance(controller, report, actions);
  is_budget_logged_ |= is_over_budget;
  const bool stays =
      controller.is_cut_off() && report.reason == coordination::FallbackReason::kMissing;
  cut_off_steps_ = stays ? cut_off_steps_ + 1 : 0;
  if (cut_off_steps_ == coordination::kSilentSteps) {
    actions.warn(
        "vehicle stays until another controller is received: none is, and one of them may drive");
  }
  const coordination::PriorityRule& priorities = controller.options().strategies.priorities;
  if (priorities.is_beyond(controller.component().size()) && !is_beyond_logged_) {
    is_beyond_logged_ = true;
    actions.warn(fmt::format(
        "{} vehicles are coupled, priorities {} compare orders of {} at most: larger groups get {}",
        controller.component().size(), priorities.strategy->name,
        priorities.strategy->most_vehicles, priorities.beyond->name));
  }
  if (const auto line = stuck_.note(report, controller.subgraph().automaton().step_s)) {
    actions.warn(*line);
  }
}

void OperatorNotes::note_rounds(VehicleId own, const controller::TwoRounds& rounds,
                                HlcActions& actions) {
  if (!rounds.not_shared().empty() && !is_not_shared_logged_) {
    actions.warn(not_shared_line(own, rounds.not_shared()));
    is_not_shared_logged_ = true;
  }
  if (rounds.shares() || is_end_of_sharing_logged_) return;
  is_end_of_sharing_logged_ = true;
  if (rounds.differs_from()) {
    actions.error(fmt::format(
        "plans of vehicle {} differ from those computed here from the same traffic; vehicles plan "
        "one after the other from now on",
        rounds.differs_from()->value));
  } else {
    actions.warn(fmt::format(
        "{} of {} steps with two rounds ended late (planning for the others took too long, the "
        "machine was busy, or messages came late); vehicles plan one after the other from now on",
        controller::TwoRounds::kMostLateSteps, controller::TwoRounds::kWindow));
  }
}

void OperatorNotes::note_fault(StepIndex step, const AnswerToList& answer, HlcActions& actions) {
  if (!answer.fault.empty() && answer.fault != last_fault_) {
    actions.error(fmt::format("command of step {} not sent, {}: {}", step.value,
                              answer.command.points.empty() ? "nor anything in its place"
                                                            : "republished the last good one",
                              answer.fault));
  }
  last_fault_ = answer.fault;
}

void OperatorNotes::note_disturbance(const controller::Controller& controller,
                                     const coordination::Report& report, HlcActions& actions) {
  const auto disturbance = [&] {
    if (!controller.is_vehicle_seen()) return Disturbance::kUnseen;
    if (controller.is_vehicle_elsewhere()) return Disturbance::kElsewhere;
    return report.reason == coordination::FallbackReason::kDeviation ? Disturbance::kOffPlan
                                                                     : Disturbance::kNone;
  }();
  if (disturbance == std::exchange(logged_disturbance_, disturbance)) return;
  switch (disturbance) {
    case Disturbance::kNone:
      return actions.info(fmt::format("vehicle {} plans on", report.vehicle.value));
    case Disturbance::kUnseen:
      return actions.warn(
          fmt::format("vehicle {} is not seen: the state lists show no state of it that is valid "
                      "and new; it drives the last command that it has received to its end",
                      report.vehicle.value));
    case Disturbance::kOffPlan:
      return actions.warn(
          fmt::format("vehicle {} is off its plan by {:.0f} mm: it drives that to its end, then is "
                      "planned from where it stands",
                      report.vehicle.value, 1e3 * report.deviation_m));
    case Disturbance::kElsewhere:
      return actions.error(elsewhere_line(controller));
  }
}

}  // namespace hlc::high_level_controller
