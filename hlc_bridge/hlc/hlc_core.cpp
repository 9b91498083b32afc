#include "hlc_bridge/hlc/hlc_core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hlc_bridge/hlc/command.hpp"
#include "hlc_bridge/hlc/own_command_check.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/controller/command_time.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::high_level_controller {
namespace {

AnswerToList with_copies(TrajectoryCommand command, std::size_t num_copies) {
  AnswerToList result{.command = std::move(command), .copies = {}, .fault = ""};
  if (result.command.points.empty()) return result;
  for (std::size_t number = 1; number <= num_copies; ++number) {
    result.copies.push_back(copy_for_later(result.command, number));
  }
  return result;
}

std::size_t num_copies(const controller::Controller& controller) {
  return controller::num_copies(controller.options().horizon_steps,
                                controller.subgraph().automaton().step_s);
}

}  // namespace

HlcCore::HlcCore(std::unique_ptr<controller::Controller> controller)
    : controller_(std::move(controller)) {}

std::string HlcCore::validate(const VehicleStateList& list) const {
  const double step_s = controller_->subgraph().automaton().step_s;
  const bool fits =
      list.period_ms > 0 && std::abs(1e-3 * static_cast<double>(list.period_ms) - step_s) <= 1e-9;
  if (fits) return {};
  return fmt::format("middleware period = {} ms, must be the automaton's step of {} s",
                     list.period_ms, shortest_text(step_s));
}

std::optional<controller::Observation> HlcCore::observe(const VehicleStateList& list) {
  controller::Observation observation =
      observation_of(list, vehicle::pose_lead_s(controller_->options().lab));
  // The lab's list names them as any other vehicle.
  for (const coordination::Guest& guest : controller_->options().guests) {
    std::erase(observation.active, guest.vehicle);
  }
  if (last_step_ && observation.step <= *last_step_) return std::nullopt;
  last_step_ = observation.step;
  return observation;
}

void HlcCore::note(const VehicleStateList& list, const controller::Observation& observation) {
  for (const VehicleState& state : list.states) {
    if (is_usable(state, list.t_now)) settled_[{state.vehicle_id}].add(state);
  }
  const coordination::MeasuredVehicle* vehicle = own(observation);
  is_seen_from_begin_ |= vehicle != nullptr && list.t_now < SettledStates::kSpan;
  stood_lists_ =
      vehicle != nullptr && coordination::is_seen_standing(*vehicle, {}) ? stood_lists_ + 1 : 0;
}

bool HlcCore::has_settled(VehicleId vehicle) const {
  const auto found = settled_.find(vehicle);
  return found != settled_.end() && found->second.have_settled();
}

bool HlcCore::have_all_settled(const controller::Observation& observation) const {
  return std::ranges::all_of(observation.active,
                             [this](VehicleId vehicle) { return has_settled(vehicle); });
}

const coordination::MeasuredVehicle* HlcCore::own(
    const controller::Observation& observation) const {
  const auto found = std::ranges::find(observation.states, controller_->options().vehicle,
                                       &coordination::MeasuredVehicle::vehicle);
  return found == observation.states.end() ? nullptr : &*found;
}

bool HlcCore::may_stand_by(const controller::Observation& observation, StartRule rule) const {
  const bool is_together = rule == StartRule::kTogether;
  if (controller_->has_plan()) {
    const coordination::MeasuredVehicle* vehicle = own(observation);
    return is_together || vehicle == nullptr || coordination::is_seen_standing(*vehicle, {});
  }
  return (is_together && is_seen_from_begin_) ||
         (stood_lists_ >= controller_->options().horizon_steps &&
          has_settled(controller_->options().vehicle));
}

bool HlcCore::begins(const VehicleStateList& list, const controller::Observation& observation,
                     StartRule rule, const std::optional<Nanoseconds>& trigger) {
  if (has_begun_ || !controller_->has_plan() || !controller_->fits_route()) return has_begun_;
  has_begun_ = rule == StartRule::kTogether
                   ? is_complete(observation) && have_all_settled(observation)
                   : trigger && list.t_now >= *trigger && own(observation) != nullptr &&
                         may_stand_by(observation, rule);
  return has_begun_;
}

AnswerToList HlcCore::answer(const VehicleStateList& list) {
  const bool has_way = controller_->has_plan() && !controller_->is_vehicle_elsewhere();
  AnswerToList result = answer_with(has_way ? &controller_->plan_in_force() : nullptr, list);
  std::string fault = validate(result);
  if (fault.empty()) {
    if (has_way) last_good_ = result.command;
    return result;
  }
  result = last_good_ && may_repeat(*last_good_, list)
               ? with_copies(republished(*last_good_, list.t_now, num_copies(*controller_)),
                             num_copies(*controller_))
               : answer_with(nullptr, list);
  result.fault = std::move(fault);
  return result;
}

AnswerToList HlcCore::answer_with(const coordination::Plan* plan,
                                  const VehicleStateList& list) const {
  const controller::ControllerOptions& options = controller_->options();
  const std::size_t copies = num_copies(*controller_);
  return with_copies(
      command_of(options.vehicle, plan, step_of(list), list.t_now, period_of(list),
                 controller_->subgraph().automaton().vehicle,
                 options.lab ? options.lab->point_interval_s : controller::kPointInterval_s,
                 copies),
      copies);
}

/// The vehicle is not too far from every point to follow the command.
bool HlcCore::may_repeat(const TrajectoryCommand& command, const VehicleStateList& list) const {
  const controller::Observation observation =
      observation_of(list, vehicle::pose_lead_s(controller_->options().lab));
  const coordination::MeasuredVehicle* vehicle = own(observation);
  return vehicle == nullptr ||
         std::ranges::any_of(command.points, [&](const TrajectoryPoint& point) {
           const Point off_m = Point(point.x_m, point.y_m) - vehicle->pose.position_m();
           return off_m.norm() <= vehicle::kStopBound_m;
         });
}

std::string HlcCore::validate(const AnswerToList& answer) const {
  const std::optional<vehicle::LabLimits>& lab = controller_->options().lab;
  std::string fault = validate_own_command(answer.command, lab);
  // What the last copy fulfils, those before it do, too.
  if (fault.empty() && !answer.copies.empty()) {
    fault = validate_own_command(answer.copies.back(), lab);
  }
  return fault;
}

coordination::Report with_answer(coordination::Report report, const AnswerToList& answer) {
  if (answer.fault.empty()) return report;
  report.reason = coordination::FallbackReason::kUndrivable;
  if (report.status == coordination::StepStatus::kPlanned)
    report.status = coordination::StepStatus::kFallback;
  return report;
}

}  // namespace hlc::high_level_controller
