#include "planner/controller/joint_step.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "planner/controller/order_of_component.hpp"

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

/// Where the controllers do not do so themselves, as they would if each received the others.
void choose_orders(std::span<ControlLoop* const> loops) {
  std::map<VehicleId, Controller*> open;
  for (ControlLoop* one : loops) {
    if (one->two_rounds() == nullptr)
      open[one->controller().options().vehicle] = &one->controller();
  }
  while (!open.empty()) {
    std::vector<Controller*> component;
    bool is_complete = true;
    const Controller& any = *open.begin()->second;
    for (const VehicleId vehicle : any.component()) {
      const auto found = open.find(vehicle);
      is_complete = is_complete && found != open.end() &&
                    found->second->component() == any.component() &&
                    found->second->missing().empty();
      if (found != open.end()) component.push_back(found->second);
    }
    if (is_complete) choose_order(component);
    for (const Controller* one : component) open.erase(one->options().vehicle);
  }
}

/// Each loop after those of its predecessors, as far as that is possible: where messages were lost
/// two may each take the other for its predecessor.
std::vector<std::size_t> planning_order(std::span<ControlLoop* const> loops) {
  std::set<VehicleId> waiting;
  std::vector<std::size_t> rest(loops.size());
  std::iota(rest.begin(), rest.end(), std::size_t{});
  for (const ControlLoop* one : loops) waiting.insert(one->controller().options().vehicle);
  std::vector<std::size_t> order;
  while (!rest.empty()) {
    auto next = std::ranges::find_if(rest, [&](std::size_t i) {
      return std::ranges::none_of(loops[i]->controller().predecessors(),
                                  [&](VehicleId other) { return waiting.contains(other); });
    });
    if (next == rest.end()) next = rest.begin();
    waiting.erase(loops[*next]->controller().options().vehicle);
    order.push_back(*next);
    rest.erase(next);
  }
  return order;
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
  choose_orders(loops);

  std::vector<coordination::Report> reports(loops.size());
  for (const std::size_t i : planning_order(loops)) {
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
