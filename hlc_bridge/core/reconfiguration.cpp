#include "hlc_bridge/core/reconfiguration.hpp"

#include <exception>
#include <utility>

namespace hlc {

PreparedRequest prepare(const Subgraph& base, const AutomatonRequest& request,
                        std::size_t horizon_steps, WeightDesign* weights,
                        const std::stop_token& stop) {
  PreparedRequest prepared{.request = request, .subgraph = {}, .reachable = {}, .refusal = {}};
  try {
    std::shared_ptr<const UniversalAutomaton> automaton;
    if (weights != nullptr && !request.subgraph.weights.empty()) {
      automaton = weights->automaton_for(requested_spec(base, request.subgraph),
                                         request.subgraph.weights, stop);
    }
    const auto subgraph =
        requested_subgraph(base, request.subgraph, horizon_steps, std::move(automaton));
    if (weights != nullptr) weights->check(*subgraph);
    prepared.reachable = std::make_shared<const ReachableSets>(*subgraph, horizon_steps + 1);
    prepared.subgraph = subgraph;
  } catch (const std::exception& error) {
    prepared.refusal = error.what();
  }
  return prepared;
}

AutomatonAnswer Reconfiguration::take(PreparedRequest prepared, StepIndex now) {
  const AutomatonRequest& request = prepared.request;
  AutomatonAnswer answer{.vehicle = request.vehicle,
                         .id = request.id,
                         .outcome = RequestOutcome::kStale,
                         .step = now,
                         .text = "a later request counts"};
  if (request.id <= newest_id_) return answer;
  if (!prepared.subgraph) {
    answer.outcome = RequestOutcome::kRefused;
    answer.text = std::move(prepared.refusal);
    return answer;
  }
  newest_id_ = request.id;
  answer.outcome = RequestOutcome::kAccepted;
  answer.text = prepared.subgraph->spec().name;
  waiting_ = std::move(prepared);
  return answer;
}

std::optional<AutomatonAnswer> Reconfiguration::begin_step(Controller& controller, StepIndex step,
                                                           Nanoseconds t_now) {
  if (!waiting_ || t_now < waiting_->request.valid_from) return std::nullopt;
  const PreparedRequest now = *std::exchange(waiting_, std::nullopt);
  controller.switch_to(now.subgraph, now.reachable);
  return AutomatonAnswer{.vehicle = now.request.vehicle,
                         .id = now.request.id,
                         .outcome = RequestOutcome::kInForce,
                         .step = step,
                         .text = now.subgraph->spec().name};
}

}  // namespace hlc
