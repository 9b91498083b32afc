#include "hlc_bridge/core/hlc_core.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hlc_bridge/core/command.hpp"
#include "planner/automaton/yaml_text.hpp"

namespace hlc {

HlcCore::HlcCore(std::unique_ptr<Controller> controller) : controller_(std::move(controller)) {}

std::string HlcCore::problem_with(const VehicleStateList& list) const {
  const double step_s = controller_->subgraph().automaton().step_s;
  const bool fits =
      list.period_ms > 0 && std::abs(1e-3 * static_cast<double>(list.period_ms) - step_s) <= 1e-9;
  if (fits) return {};
  return "the middleware's period is " + std::to_string(list.period_ms) +
         " ms, the automaton's step is " + shortest_text(step_s) + " s";
}

std::optional<Observation> HlcCore::observe(const VehicleStateList& list) {
  Observation observation = observation_of(list);
  if (last_step_ && observation.step <= *last_step_) return std::nullopt;
  last_step_ = observation.step;
  return observation;
}

void HlcCore::note(const VehicleStateList& list) {
  for (const VehicleState& state : list.states) {
    if (is_usable(state, list.t_now)) settled_[{state.vehicle_id}].add(state);
  }
}

bool HlcCore::have_all_settled(const Observation& observation) const {
  return std::ranges::all_of(observation.active, [this](VehicleId id) {
    const auto found = settled_.find(id);
    return found != settled_.end() && found->second.have_settled();
  });
}

bool HlcCore::begins(const VehicleStateList& list, const Observation& observation,
                     bool logical_time, const std::optional<Nanoseconds>& trigger) {
  if (has_begun_ || !controller_->has_plan()) return has_begun_;
  has_begun_ = logical_time ? is_complete(observation) && have_all_settled(observation)
                            : trigger && list.t_now >= *trigger;
  return has_begun_;
}

AnswerToList HlcCore::answer(const VehicleStateList& list) const {
  const Plan* plan = controller_->has_plan() ? &controller_->plan_in_force() : nullptr;
  AnswerToList result{command_of(controller_->options().vehicle, plan, step_of(list), list.t_now,
                                 period_of(list), controller_->subgraph().automaton().vehicle),
                      std::nullopt};
  if (!result.command.points.empty()) result.copy = copy_for_later(result.command);
  return result;
}

}  // namespace hlc
