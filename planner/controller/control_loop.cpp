#include "planner/controller/control_loop.hpp"

#include <utility>

#include "planner/common/demand.hpp"

namespace hlc::controller {
namespace {

constexpr std::uint64_t kMaxStepsAhead = 10;

}  // namespace

ControlLoop::ControlLoop(Controller& controller, Stopwatch stopwatch)
    : controller_(&controller), stopwatch_(std::move(stopwatch)) {
  if (!stopwatch_) stopwatch_ = [] { return std::uint64_t{}; };
}

StepOutput ControlLoop::begin(const Observation& observation) {
  HLC_DEMAND(!is_in_step(), phase_);
  advance_to(observation.step);
  active_ = observation.active;
  planning_ns_ = 0;
  phase_ = StepPhase::kTraffic;
  return {.traffic = controller_->observe(observation)};
}

coordination::Report ControlLoop::stand_by(const Observation& observation) {
  HLC_DEMAND(!is_in_step(), phase_);
  advance_to(observation.step);
  return controller_->stand_by(observation);
}

void ControlLoop::advance_to(StepIndex step) {
  step_ = step;
  const auto drop_old = [step](auto& messages) {
    messages.erase(messages.begin(), messages.lower_bound(step));
  };
  std::apply([&](auto&... kinds) { (drop_old(kinds), ...); }, received_);
}

template <class Message>
void ControlLoop::receive(std::shared_ptr<const Message> message) {
  if (message->vehicle == controller_->options().vehicle || message->step < step_ ||
      message->step.value > step_.value + kMaxStepsAhead) {
    return;
  }
  auto& of_step = std::get<Received<Message>>(received_)[message->step];
  of_step.put(std::move(message));
}

template void ControlLoop::receive(std::shared_ptr<const coordination::Traffic> message);
template void ControlLoop::receive(std::shared_ptr<const coordination::Prediction> message);
template void ControlLoop::receive(std::shared_ptr<const coordination::Outcome> message);

void ControlLoop::receive(const coordination::Traffic& message) {
  receive(std::make_shared<const coordination::Traffic>(message));
}
void ControlLoop::receive(const coordination::Prediction& message) {
  receive(std::make_shared<const coordination::Prediction>(message));
}
void ControlLoop::receive(const coordination::Outcome& message) {
  receive(std::make_shared<const coordination::Outcome>(message));
}

template <class Message>
Awaited ControlLoop::missing_of(MessageKind kind, const std::vector<VehicleId>& from) const {
  Awaited awaited{.kind = kind, .from = {}};
  const auto& messages = std::get<Received<Message>>(received_);
  const auto of_step = messages.find(step_);
  for (const VehicleId vehicle : from) {
    if (vehicle == controller_->options().vehicle) continue;
    if (of_step == messages.end() || !of_step->second.contains(vehicle)) {
      awaited.from.push_back(vehicle);
    }
  }
  return awaited;
}

bool ControlLoop::needs_votes() const {
  return controller_->options().strategies.coordination.commit.needs_votes;
}

Awaited ControlLoop::awaited() const {
  switch (phase_) {
    case StepPhase::kIdle:
      break;
    case StepPhase::kTraffic:
      return missing_of<coordination::Traffic>(MessageKind::kTraffic, active_);
    case StepPhase::kPredecessors:
      return missing_of<coordination::Prediction>(MessageKind::kPrediction,
                                                  controller_->predecessors());
    case StepPhase::kCommit:
      return needs_votes() ? missing_of<coordination::Outcome>(MessageKind::kOutcome,
                                                               controller_->component())
                           : missing_of<coordination::Prediction>(MessageKind::kPrediction,
                                                                  controller_->coupled());
  }
  HLC_DEMAND(is_in_step());  // nothing is awaited outside a step
  return {};
}

StepOutput ControlLoop::proceed(SharedStep* shared) {
  switch (phase_) {
    case StepPhase::kIdle:
      break;
    case StepPhase::kTraffic: {
      SharedStep alone;
      controller_->couple(received<coordination::Traffic>(), shared != nullptr ? *shared : alone);
      phase_ = StepPhase::kPredecessors;
      return {};
    }
    case StepPhase::kPredecessors:
      phase_ = StepPhase::kCommit;
      return plan();
    case StepPhase::kCommit:
      phase_ = StepPhase::kIdle;
      return {.report = controller_->commit(received<coordination::Prediction>(),
                                            received<coordination::Outcome>())};
  }
  HLC_DEMAND(is_in_step());
  return {};
}

StepOutput ControlLoop::plan() {
  const auto& predictions = received<coordination::Prediction>();
  const std::uint64_t from_ns = stopwatch_();
  StepOutput output{.prediction = controller_->plan(predictions)};
  planning_ns_ = stopwatch_() - from_ns;
  if (needs_votes()) output.outcome = controller_->vote();
  return output;
}

StepOutput ControlLoop::fall_back(coordination::FallbackReason reason) {
  HLC_DEMAND(is_in_step());
  phase_ = StepPhase::kIdle;
  return {.report = controller_->fall_back(reason)};
}

}  // namespace hlc::controller
