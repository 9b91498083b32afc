#include "hlc_bridge/hlc/control_step.hpp"

#include <fmt/format.h>

#include <utility>

#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::high_level_controller {

void ControlStep::receive(const coordination::Traffic& message) {
  silent_.erase(message.vehicle);
  loop_.receive(message);
}

void ControlStep::begin(const VehicleStateList& list, const controller::Observation& observation,
                        const Instant& now, HlcActions& actions) {
  list_ = {.t_now = list.t_now, .period_ms = list.period_ms};
  record_ = {};
  is_warm_ = !warms_up_;
  phase_ends_ = now.wall + kMessageTimeout;
  num_awaited_ = 0;
  actions.add(*loop_.begin(observation).traffic);
}

std::optional<ReportRecord> ControlStep::advance(const Instant& now,
                                                 const IsReachable& is_reachable, bool is_over,
                                                 HlcActions& actions) {
  // Not in `begin`: traffic is published first, and warming up uses the wait for the others'
  // traffic.
  if (!is_warm_) static_cast<void>(loop_.warm_up());
  is_warm_ = true;
  while (is_over || ends_phase(now, is_reachable, actions)) {
    phase_ends_ = now.wall + kMessageTimeout;
    num_awaited_ = 0;
    controller::StepOutput output = end_phase(now);
    if (output.report) {
      record_.report = *std::move(output.report);
      record_.planning_ns = loop_.planning_ns();
      return std::exchange(record_, {});
    }
    if (output.prediction) actions.add(*std::move(output.prediction));
    if (output.outcome) actions.add(*output.outcome);
    if (output.prediction || output.outcome) return std::nullopt;
  }
  return std::nullopt;
}

bool ControlStep::ends_phase(const Instant& now, const IsReachable& is_reachable,
                             HlcActions& actions) {
  std::vector<VehicleId> awaited = loop_.awaited().from;
  std::erase_if(awaited, [&](VehicleId vehicle) {
    return silent_.contains(vehicle) || !is_reachable(vehicle);
  });
  num_awaited_ = awaited.size();
  if (awaited.empty()) return true;
  if (deadlines_) return now.run >= deadline();
  if (now.wall < phase_ends_) return false;
  for (const VehicleId vehicle : awaited) {
    actions.warn(fmt::format("{}: no message for {} s; no longer waiting",
                             controller_name(vehicle.value),
                             kMessageTimeout / kNanosecondsPerSecond));
    silent_.insert(vehicle);
  }
  return true;
}

controller::StepOutput ControlStep::end_phase(const Instant& now) {
  if (deadlines_ && loop_.phase() == controller::StepPhase::kCommit) {
    const Nanoseconds latest = deadline_in_step(list_, deadlines_->command);
    if (now.run > latest) {
      record_.deadline_missed = true;
      record_.late_ns = now.run - latest;
      return loop_.fall_back(coordination::FallbackReason::kLate);
    }
  }
  return loop_.proceed();
}

Nanoseconds ControlStep::deadline() const {
  switch (loop_.phase()) {
    case controller::StepPhase::kTraffic:
      return deadline_in_step(list_, deadlines_->traffic);
    case controller::StepPhase::kPredecessors:
      return deadline_in_step(list_, deadlines_->predecessors);
    case controller::StepPhase::kCommit:
    case controller::StepPhase::kIdle:
      break;
  }
  return deadline_in_step(list_, deadlines_->commit);
}

WakeUp ControlStep::wake_up() const {
  if (num_awaited_ == 0) return {.wall = Nanoseconds{0}};
  if (deadlines_) return {.run = deadline()};
  return {.wall = phase_ends_};
}

}  // namespace hlc::high_level_controller
