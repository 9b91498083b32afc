#include "planner/rollout/rollout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "planner/common/demand.hpp"
#include "planner/controller/followed_plan.hpp"
#include "planner/coordination/priority.hpp"

namespace hlc::rollout {
namespace {

constexpr StepIndex kFirstStep{1};  // all stand in step 0

VehicleId id(const std::unique_ptr<controller::Controller>& controller) {
  return controller->options().vehicle;
}

}  // namespace

Rollout::Rollout(std::vector<std::unique_ptr<controller::Controller>> controllers,
                 const std::vector<Pose>& starts)
    : controllers_(std::move(controllers)) {
  HLC_DEMAND(controllers_.size() == starts.size(), controllers_.size(), starts.size());
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    controller::Controller& controller = *controllers_[i];
    const vehicle::State standing{.pose = starts[i]};
    static_cast<void>(controller.stand_by(
        {.step = next_step_,
         .active = {id(controllers_[i])},
         .states = {controller::as_measured(id(controllers_[i]), standing,
                                            controller.subgraph().automaton())}}));
  }
  HLC_DEMAND(!controllers_.empty());
  std::ranges::sort(controllers_, {}, id);
  ++next_step_.value;
}

void Rollout::choose_by(const policy::ReconfigurationSettings& settings) {
  choices_.clear();
  for (const auto& controller : controllers_) choices_.emplace_back(*controller, settings);
}

Rollout Rollout::clone() const {
  Rollout result;
  for (const auto& controller : controllers_) {
    result.controllers_.push_back(std::make_unique<controller::Controller>(*controller));
  }
  result.next_step_ = next_step_;
  return result;
}

std::vector<coordination::MeasuredVehicle> Rollout::measure(StepIndex step) const {
  std::vector<coordination::MeasuredVehicle> states;
  for (const auto& controller : controllers_)
    states.push_back(controller::on_its_plan(*controller, step));
  return states;
}

std::vector<coordination::Report> Rollout::step() {
  controller::Observation observation{.step = next_step_, .states = measure(next_step_)};
  for (const auto& controller : controllers_) observation.active.push_back(id(controller));
  std::ranges::sort(observation.active);
  observation.present = observation.active;

  std::vector<controller::Controller*> controllers;
  for (const auto& controller : controllers_) controllers.push_back(controller.get());
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    static_cast<void>(choices_[i].begin_step(*controllers[i], next_step_, kFirstStep, {}));
  }
  std::vector<coordination::Report> reports =
      controller::joint_step(controllers, observation, rules_);
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    choices_[i].end_step(*controllers[i], reports[i]);
  }
  ++next_step_.value;
  return reports;
}

Rollout make_rollout(const scenario::Scenario& scenario) {
  return make_rollout(scenario, scenario::prepare_subgraph_of(scenario));
}

Rollout make_rollout(const scenario::Scenario& scenario, const controller::PreparedSubgraph& on) {
  if (!scenario.guests.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: guests = {}, must be 0 here: run_lab.sh and evaluate drive them",
                    scenario.file.string(), scenario.guests.size()));
  }
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  std::vector<Pose> starts;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(scenario::make_controller(scenario, vehicle.id, on));
    starts.push_back(vehicle.start);
  }
  Rollout rollout(std::move(controllers), starts);
  if (scenario.policy != policy::kNoPolicy) rollout.choose_by(scenario.reconfiguration);
  return rollout;
}

}  // namespace hlc::rollout
