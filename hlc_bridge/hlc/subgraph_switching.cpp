#include "hlc_bridge/hlc/subgraph_switching.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "hlc_bridge/hlc/observation.hpp"

namespace hlc::high_level_controller {
namespace {

std::string switch_line(const std::string& subgraph, StepIndex step) {
  return fmt::format("planning on subgraph {} from step {} on", subgraph, step.value);
}

void publish(const AutomatonAnswer& answer, HlcActions& actions) {
  actions.add(answer);
  switch (answer.outcome) {
    case RequestOutcome::kAccepted:
      return;
    case RequestOutcome::kInForce:
      return actions.info(switch_line(answer.text, answer.step));
    case RequestOutcome::kRefused:
    case RequestOutcome::kStale:
      return actions.warn("subgraph request refused: " + answer.text);
  }
}

}  // namespace

RequestBase SubgraphSwitching::request_base(const controller::Controller& controller) const {
  const controller::ControllerOptions& options = controller.options();
  return {.subgraph = selector_.base(),
          .limits_mps = selector_.limits_mps(),
          .horizon_steps = options.horizon_steps,
          .search = options.search};
}

void SubgraphSwitching::receive(const AutomatonRequest& request) {
  waiting_.push_back(request);
  if (waiting_.size() > kMaxWaiting) waiting_.pop_front();
}

void SubgraphSwitching::receive(const PreparedRequest& prepared) {
  is_in_work_ = false;
  prepared_.push_back(prepared);
}

void SubgraphSwitching::prepare_next(HlcActions& actions) {
  if (is_in_work_ || !has_next()) return;
  is_in_work_ = true;
  actions.add(PrepareRequest{std::move(waiting_.front())});
  waiting_.pop_front();
}

void SubgraphSwitching::begin_step(controller::Controller& controller, const VehicleStateList& list,
                                   StepIndex step, std::optional<StepIndex> first_step,
                                   HlcActions& actions) {
  for (PreparedRequest& prepared : std::exchange(prepared_, {})) {
    for (const AutomatonAnswer& answer : reconfiguration_.take(std::move(prepared), step)) {
      publish(answer, actions);
    }
  }
  std::optional<AutomatonAnswer> answer = reconfiguration_.begin_step(selector_, step, list.t_now);
  const bool has_switched = selector_.begin_step(
      controller, step, first_step, battery_voltage_v(list, controller.options().vehicle));
  const std::string& name = controller.subgraph().spec().name;
  if (answer) {
    answer->text = name;
    publish(*answer, actions);
  } else if (has_switched) {
    actions.info(switch_line(name, step));
  }
}

}  // namespace hlc::high_level_controller
