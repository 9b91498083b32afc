#include "hlc_bridge/middleware/experiment_cycle.hpp"

#include <fmt/format.h>

#include <utility>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::middleware {

ExperimentCycle::ExperimentCycle(std::vector<std::uint8_t> vehicle_ids, Nanoseconds offset,
                                 bool keep_running)
    : vehicle_ids_{std::move(vehicle_ids)}, offset_{offset}, keep_running_{keep_running} {}

void ExperimentCycle::take(const ReadyStatus& status) {
  for (const std::uint8_t id : vehicle_ids_) {
    if (status.source_id == controller_ready_id(id)) ready_.insert(id);
  }
}

void ExperimentCycle::take(const SystemTrigger& trigger) {
  const bool is_stop = trigger.next_start == kStopSymbol;
  is_between_ = keep_running_ && is_stop;
  if (!is_triggered_ && !is_stop) starts_at_ = trigger.next_start;
  is_triggered_ = !is_between_;
  is_stopped_ = is_stopped_ || (is_stop && !keep_running_);
  if (is_between_) {
    ready_.clear();
    next_.begin();
  }
}

void ExperimentCycle::take(const Parameter& parameter) {
  if (is_between_) next_.take(parameter);
}

std::string ExperimentCycle::begin(const RunParameters& parameters) {
  std::string problem = validate(parameters, vehicle_ids_, offset_);
  if (problem.empty()) parameters_ = parameters;
  return problem;
}

void ExperimentCycle::prepare_next(Nanoseconds now, MiddlewareActions& actions) {
  if (!is_between_) return;
  if (next_.request_is_due(now)) {
    for (const char* name : {kPeriodParameter, kActiveIdsParameter}) {
      actions.emplace_back(ParameterRequest{.name = name});
    }
  }
  NextExperiment::Outcome next = next_.evaluate(vehicle_ids_, offset_, parameters_.period());
  if (!next.problem.empty()) {
    actions.emplace_back(machine::error("not ready for the next experiment: " + next.problem));
  }
  if (next.parameters) {
    parameters_ = *std::move(next.parameters);
    actions.emplace_back(SubscribeToVehicles{parameters_.active_ids()});
  }
}

void ExperimentCycle::take(GoalState goal) {
  if (num_goals_ == kMostGoals) return;
  ++num_goals_;
  goals_.push_back(std::move(goal));
}

void ExperimentCycle::forward_goals(MiddlewareActions& actions) {
  if (goals_.empty() || !unready_controllers().empty()) return;
  for (GoalState& goal : goals_) actions.emplace_back(std::move(goal));
  goals_.clear();
}

void ExperimentCycle::announce_readiness(Nanoseconds now, MiddlewareActions& actions) {
  if (is_triggered_) return;
  if (!notice_) notice_.emplace(now);
  const std::vector<std::string> unready = unready_controllers();
  if (!unready.empty()) {
    if (notice_->is_due(now)) {
      actions.emplace_back(
          machine::info(fmt::format("waiting for {} to be ready", fmt::join(unready, ", "))));
    }
  } else if (!is_between_ || next_.is_known()) {
    actions.emplace_back(ReadyStatus{.source_id = middleware_ready_id(vehicle_ids_)});
  }
}

std::vector<std::string> ExperimentCycle::unready_controllers() const {
  std::vector<std::string> names;
  for (const std::uint8_t id : vehicle_ids_) {
    if (!ready_.contains(id)) names.push_back(controller_name(id));
  }
  return names;
}

}  // namespace hlc::middleware
