#include "planner/controller/control_loop.hpp"

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"

namespace hlc::controller {
namespace {

constexpr std::uint64_t kMaxStepsAhead = 10;

}  // namespace

ControlLoop::ControlLoop(Controller& controller, Stopwatch stopwatch, Rounds rounds)
    : controller_(&controller), stopwatch_(std::move(stopwatch)) {
  if (!stopwatch_) stopwatch_ = [] { return std::uint64_t{}; };
  if (rounds == Rounds::kTwo && controller.options().others && !needs_votes()) {
    two_rounds_.emplace(controller.options().others);
  }
}

StepOutput ControlLoop::begin(const Observation& observation) {
  HLC_DEMAND(!is_in_step(), phase_);
  advance_to(observation.step);
  active_ = observation.active;
  planning_ns_ = 0;
  phase_ = StepPhase::kTraffic;
  StepOutput output{.traffic = controller_->observe(observation)};
  if (!two_rounds_ || !two_rounds_->offers(*controller_, *output.traffic)) {
    output.traffic->planning.reset();
  }
  return output;
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

/// Who has sent an outcome with digests sends a prediction only where this states it.
Awaited ControlLoop::missing_plans_of(MessageKind kind, const std::vector<VehicleId>& from) const {
  Awaited awaited = missing_of<coordination::Prediction>(kind, from);
  const auto& outcomes = std::get<Received<coordination::Outcome>>(received_);
  const auto of_step = outcomes.find(step_);
  if (of_step == outcomes.end()) return awaited;
  std::erase_if(awaited.from, [&](VehicleId vehicle) {
    const auto outcome = of_step->second.find(vehicle, step_);
    return outcome != nullptr && outcome->digests && !outcome->digests->is_prediction_published;
  });
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
      if (is_in_two_rounds()) return {.kind = MessageKind::kPrediction, .from = {}};
      return missing_plans_of(MessageKind::kPrediction, controller_->predecessors());
    case StepPhase::kCommit:
      if (needs_votes()) {
        return missing_of<coordination::Outcome>(MessageKind::kOutcome, controller_->component());
      }
      return missing_plans_of(is_in_two_rounds() ? MessageKind::kOutcome : MessageKind::kPrediction,
                              controller_->coupled());
  }
  HLC_DEMAND(is_in_step());  // nothing is awaited outside a step
  return {};
}

StepOutput ControlLoop::proceed(SharedStep* shared) {
  switch (phase_) {
    case StepPhase::kIdle:
      break;
    case StepPhase::kTraffic:
      phase_ = StepPhase::kPredecessors;
      couple(shared);
      return {};
    case StepPhase::kPredecessors:
      phase_ = StepPhase::kCommit;
      return plan();
    case StepPhase::kCommit:
      phase_ = StepPhase::kIdle;
      return commit();
  }
  HLC_DEMAND(is_in_step());
  return {};
}

void ControlLoop::couple(SharedStep* shared) {
  SharedStep alone;
  controller_->couple(received<coordination::Traffic>(), shared != nullptr ? *shared : alone);
  if (!two_rounds_) return;
  const std::uint64_t from_ns = stopwatch_();
  two_rounds_->choose(*controller_);
  planning_ns_ = stopwatch_() - from_ns;
}

StepOutput ControlLoop::plan() {
  StepOutput output;
  const auto& predictions = received<coordination::Prediction>();
  const std::uint64_t from_ns = stopwatch_();
  if (is_in_two_rounds()) {
    output.outcome = two_rounds_->plan(*controller_);
    if (output.outcome->digests->is_prediction_published) {
      output.prediction = controller_->prediction();
    }
  } else {
    output.prediction = controller_->plan(predictions);
  }
  planning_ns_ += stopwatch_() - from_ns;
  if (needs_votes()) output.outcome = controller_->vote();
  return output;
}

StepOutput ControlLoop::commit() {
  const auto& outcomes = received<coordination::Outcome>();
  const auto& predictions = received<coordination::Prediction>();
  if (!is_in_two_rounds()) return {.report = controller_->commit(predictions, outcomes)};
  return {.report = controller_->commit(
              two_rounds_->known_plans(*controller_, predictions, outcomes), outcomes)};
}

StepOutput ControlLoop::fall_back(coordination::FallbackReason reason) {
  HLC_DEMAND(is_in_step());
  const bool has_planned = phase_ == StepPhase::kCommit;
  phase_ = StepPhase::kIdle;
  if (is_in_two_rounds() && has_planned) two_rounds_->end_late(*controller_);
  return {.report = controller_->fall_back(reason)};
}

}  // namespace hlc::controller
