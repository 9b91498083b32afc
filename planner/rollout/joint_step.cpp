#include "planner/rollout/joint_step.hpp"

#include <set>

namespace hlc {

std::vector<Report> joint_step(std::span<Controller* const> controllers,
                               const Observation& observation, const JointStepRules& rules) {
  const auto heard = [&](MessageKind kind, const auto& messages, const Controller& receiver) {
    const VehicleId to = receiver.options().vehicle;
    auto result = messages;
    std::erase_if(result, [&](const auto& message) {
      return message.vehicle == to ||
             (rules.is_lost && rules.is_lost({kind, observation.step, message.vehicle, to}));
    });
    return result;
  };

  std::vector<Traffic> traffic;
  std::vector<Prediction> predictions;
  std::vector<Outcome> outcomes;
  std::vector<Report> reports;
  for (Controller* one : controllers) {
    traffic.push_back(one->observe(observation));
    if (rules.told) rules.told(*one, traffic.back());
  }
  for (Controller* one : controllers) one->couple(heard(MessageKind::kTraffic, traffic, *one));
  std::set<const Controller*> late;
  for (Controller* one : controllers) {
    if (rules.is_late && rules.is_late(*one)) {
      late.insert(one);
      continue;
    }
    const std::vector<Prediction> of_others = heard(MessageKind::kPrediction, predictions, *one);
    predictions.push_back(rules.plan ? rules.plan(*one, of_others) : one->plan(of_others));
  }
  for (Controller* one : controllers) {
    if (!late.contains(one)) outcomes.push_back(one->vote());
  }
  for (Controller* one : controllers) {
    if (late.contains(one)) {
      reports.push_back(one->give_up(FallbackReason::kLate));
      continue;
    }
    reports.push_back(one->settle(heard(MessageKind::kPrediction, predictions, *one),
                                  heard(MessageKind::kOutcome, outcomes, *one)));
  }
  return reports;
}

}  // namespace hlc
