#include "planner/controller/joint_step.hpp"

#include <set>

namespace hlc {
namespace {

/// What one controller hears. It ignores its own message, which may be there.
template <class Message>
struct Heard {
  std::vector<Message> copy;  ///< without the lost ones; not used if none can be lost
  std::span<const Message> messages;
};

}  // namespace

std::vector<Report> joint_step(std::span<Controller* const> controllers,
                               const Observation& observation, const JointStepRules& rules) {
  const auto heard = [&]<class Message>(MessageKind kind, const std::vector<Message>& messages,
                                        const Controller& receiver) {
    Heard<Message> result{.copy = {}, .messages = messages};
    if (!rules.is_lost) return result;
    const VehicleId to = receiver.options().vehicle;
    result.copy = messages;
    std::erase_if(result.copy, [&](const Message& message) {
      return message.vehicle != to && rules.is_lost({kind, observation.step, message.vehicle, to});
    });
    result.messages = result.copy;
    return result;
  };

  std::vector<Traffic> traffic = rules.outside.traffic;
  std::vector<Prediction> predictions = rules.outside.predictions;
  std::vector<Outcome> outcomes = rules.outside.outcomes;
  std::vector<Report> reports;
  traffic.reserve(traffic.size() + controllers.size());
  predictions.reserve(predictions.size() + controllers.size());
  outcomes.reserve(outcomes.size() + controllers.size());
  reports.reserve(controllers.size());
  for (Controller* one : controllers) {
    traffic.push_back(one->observe(observation));
    if (rules.told) rules.told(*one, traffic.back());
  }
  for (Controller* one : controllers) {
    one->couple(heard(MessageKind::kTraffic, traffic, *one).messages);
  }
  std::set<const Controller*> late;
  for (Controller* one : controllers) {
    if (rules.is_late && rules.is_late(*one)) {
      late.insert(one);
      continue;
    }
    const Heard<Prediction> so_far = heard(MessageKind::kPrediction, predictions, *one);
    predictions.push_back(rules.plan ? rules.plan(*one, so_far.messages)
                                     : one->plan(so_far.messages));
  }
  for (Controller* one : controllers) {
    if (!late.contains(one)) outcomes.push_back(one->vote());
  }
  for (Controller* one : controllers) {
    if (late.contains(one)) {
      reports.push_back(one->give_up(FallbackReason::kLate));
      continue;
    }
    reports.push_back(one->settle(heard(MessageKind::kPrediction, predictions, *one).messages,
                                  heard(MessageKind::kOutcome, outcomes, *one).messages));
  }
  return reports;
}

}  // namespace hlc
