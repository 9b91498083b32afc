#include "planner/controller/joint_step.hpp"

#include <memory>
#include <utility>

namespace hlc::controller {
namespace {

/// Delivers messages to all but their sender, unless they are lost.
class Exchange {
 public:
  Exchange(std::span<ControlLoop* const> loops, StepIndex step, const JointStepRules& rules)
      : loops_(loops), step_(step), rules_(&rules) {}

  template <class Message>
  void deliver(MessageKind kind, Message message) const {
    const auto shared = std::make_shared<const Message>(std::move(message));
    for (ControlLoop* receiver : loops_) {
      const VehicleId to = receiver->controller().options().vehicle;
      if (to == shared->vehicle) continue;
      if (rules_->is_lost && rules_->is_lost({kind, step_, shared->vehicle, to})) continue;
      receiver->receive(shared);
    }
  }

  void deliver(StepOutput output) const {
    if (output.prediction) deliver(MessageKind::kPrediction, *std::move(output.prediction));
    if (output.outcome) deliver(MessageKind::kOutcome, *output.outcome);
  }

  void deliver(const ExternalMessages& messages) const {
    for (const coordination::Traffic& one : messages.traffic) deliver(MessageKind::kTraffic, one);
    for (const coordination::Prediction& one : messages.predictions)
      deliver(MessageKind::kPrediction, one);
    for (const coordination::Outcome& one : messages.outcomes) deliver(MessageKind::kOutcome, one);
  }

 private:
  std::span<ControlLoop* const> loops_;
  StepIndex step_;
  const JointStepRules* rules_;
};

StepOutput plan(ControlLoop& loop, const JointStepRules& rules) {
  StepOutput output;
  const auto proceed = [&] { output = loop.proceed(); };
  if (rules.around_planning) {
    rules.around_planning(proceed);
  } else {
    proceed();
  }
  if (rules.on_prediction) rules.on_prediction(loop.controller(), loop.controller().prediction());
  return output;
}

}  // namespace

std::vector<coordination::Report> joint_step(std::span<ControlLoop* const> loops,
                                             const Observation& observation,
                                             const JointStepRules& rules) {
  const Exchange exchange(loops, observation.step, rules);
  std::vector<coordination::Traffic> traffic;
  traffic.reserve(loops.size());
  for (ControlLoop* one : loops) {
    traffic.push_back(*one->begin(observation).traffic);
    if (rules.on_traffic) rules.on_traffic(one->controller(), traffic.back());
  }
  exchange.deliver(rules.external);
  for (coordination::Traffic& one : traffic) {
    exchange.deliver(MessageKind::kTraffic, std::move(one));
  }
  SharedStep shared;
  for (ControlLoop* one : loops) static_cast<void>(one->proceed(&shared));

  std::vector<coordination::Report> reports(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (rules.is_late && rules.is_late(loops[i]->controller())) {
      reports[i] = *loops[i]->fall_back(coordination::FallbackReason::kLate).report;
      continue;
    }
    exchange.deliver(plan(*loops[i], rules));
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i]->is_in_step()) reports[i] = *loops[i]->proceed().report;
  }
  return reports;
}

std::vector<coordination::Report> joint_step(std::span<Controller* const> controllers,
                                             const Observation& observation,
                                             const JointStepRules& rules) {
  std::vector<ControlLoop> loops;
  std::vector<ControlLoop*> pointers;
  loops.reserve(controllers.size());
  for (Controller* one : controllers) {
    pointers.push_back(&loops.emplace_back(*one, Stopwatch{}, rules.rounds));
  }
  return joint_step(pointers, observation, rules);
}

}  // namespace hlc::controller
