#include "hlc_bridge/hlc/reconfiguration.hpp"

#include <exception>
#include <utility>

namespace hlc::high_level_controller {
namespace {

/// It quotes the request, whose texts are as long as its sender likes, and is logged.
constexpr std::size_t kLongestRefusal = 1000;

}  // namespace

PreparedRequest prepare(const RequestBase& base, const AutomatonRequest& request,
                        WeightDesign* weights, const std::stop_token& stop) {
  PreparedRequest prepared{.request = request, .choice = {}, .refusal = {}};
  try {
    std::shared_ptr<const automaton::UniversalAutomaton> automaton;
    if (weights != nullptr && !request.subgraph.weights.empty()) {
      automaton = weights->automaton_for(
          automaton::requested_spec(*base.subgraph.subgraph, request.subgraph),
          request.subgraph.weights, stop);
    }
    auto choice = std::make_shared<const policy::PreparedChoice>(
        base.subgraph, request.subgraph, base.limits_mps, base.horizon_steps, base.search,
        automaton);
    for (const auto& [limit, one] : choice->by_limit()) {
      if (weights != nullptr) weights->check(*one.subgraph);
    }
    prepared.choice = std::move(choice);
  } catch (const std::exception& error) {
    prepared.refusal = std::string(error.what()).substr(0, kLongestRefusal);
  }
  return prepared;
}

std::vector<AutomatonAnswer> Reconfiguration::take(PreparedRequest prepared, StepIndex now) {
  const auto answer_to = [now](const AutomatonRequest& request, RequestOutcome outcome,
                               const std::string& text) {
    return AutomatonAnswer{.vehicle = request.vehicle,
                           .id = request.id,
                           .outcome = outcome,
                           .step = now,
                           .text = text};
  };
  const std::string later = "a later request counts";
  if (prepared.request.id <= newest_id_) {
    return {answer_to(prepared.request, RequestOutcome::kStale, later)};
  }
  if (!prepared.choice) {
    return {answer_to(prepared.request, RequestOutcome::kRefused, prepared.refusal)};
  }
  newest_id_ = prepared.request.id;
  std::vector<AutomatonAnswer> answers;
  if (waiting_) answers.push_back(answer_to(waiting_->request, RequestOutcome::kStale, later));
  answers.push_back(answer_to(prepared.request, RequestOutcome::kAccepted,
                              prepared.choice->under({}).subgraph->spec().name));
  waiting_ = std::move(prepared);
  return answers;
}

std::optional<AutomatonAnswer> Reconfiguration::begin_step(policy::SubgraphSelector& selector,
                                                           StepIndex step, Nanoseconds t_now) {
  if (!waiting_ || t_now < waiting_->request.valid_from) return std::nullopt;
  PreparedRequest now = *std::exchange(waiting_, std::nullopt);
  const bool gives_back = now.request.subgraph == SubgraphRequest{};
  selector.ask(gives_back ? nullptr : std::move(now.choice));
  return AutomatonAnswer{.vehicle = now.request.vehicle,
                         .id = now.request.id,
                         .outcome = RequestOutcome::kInForce,
                         .step = step,
                         .text = {}};
}

}  // namespace hlc::high_level_controller
