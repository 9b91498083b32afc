#include "planner/policy/subgraph_choice.hpp"

#include <algorithm>
#include <cassert>
#include <variant>

#include "planner/policy/policy_check.hpp"
#include "planner/policy/speed_zones.hpp"

namespace hlc {
namespace {

/// Times are multiples of a step, which a double does not hold.
constexpr double kStepRounding_s = 1e-6;

double fastest_trim_mps(const UniversalAutomaton& automaton) {
  return std::ranges::max(automaton.trims, {}, &Trim::speed_mps).speed_mps;
}

}  // namespace

SubgraphChoice::SubgraphChoice(const Controller& controller,
                               const ReconfigurationSettings& settings)
    : base_(controller.prepared_subgraph()),
      zones_(settings.zones),
      limits_mps_(hlc::limits_mps(zones_)),
      step_s_(base_.subgraph->automaton().step_s),
      min_stay_s_(settings.min_stay_s) {
  ahead_m_ = static_cast<double>(kStepsBeforeZone) * step_s_ *
             fastest_trim_mps(base_.subgraph->automaton());
  const ControllerOptions& options = controller.options();
  for (const SubgraphRequest& request : requests_of(settings)) {
    choices_.emplace_back(request, PreparedChoice(base_, request, limits_mps_,
                                                  options.horizon_steps, options.search));
  }
  for (const PolicySettings& one : settings.policies) {
    if (const auto* look_ahead = std::get_if<LookAheadSettings>(&one)) {
      auto policy = std::make_unique<LookAhead>(*look_ahead);
      look_aheads_.push_back(policy.get());
      policies_.push_back(std::move(policy));
    } else {
      policies_.push_back(make_rule_policy(one));
    }
  }
}

const PreparedChoice& SubgraphChoice::prepared(const SubgraphRequest& request) const {
  const auto found =
      std::ranges::find(choices_, request, [](const auto& one) { return one.first; });
  assert(found != choices_.end() && "policies name all that they may ask for");
  return found->second;
}

std::optional<double> SubgraphChoice::limit_for(const Controller& controller) const {
  if (!controller.path_s_m()) return std::nullopt;
  return limit_on(zones_, controller.route().path, *controller.path_s_m(), ahead_m_);
}

void SubgraphChoice::let_policies_choose(StepIndex step, std::optional<double> battery_v) {
  const auto seconds_since = [&](StepIndex then) {
    return step_s_ * static_cast<double>(step.value - then.value);
  };
  first_step_ = first_step_.value_or(step);
  const PolicyView view{.time_s = seconds_since(*first_step_),
                        .last = last_ ? &*last_ : nullptr,
                        .battery_v = battery_v};
  std::optional<SubgraphRequest> wish;
  for (const auto& policy : policies_) {  // all are asked: they remember
    const std::optional<SubgraphRequest> one = policy->wish(view);
    if (!wish) wish = one;
  }
  const SubgraphRequest wished = wish.value_or(SubgraphRequest{});
  if (wished == wished_) return;
  if (wished_since_ && seconds_since(*wished_since_) + kStepRounding_s < min_stay_s_) return;
  wished_ = wished;
  wished_since_ = step;
}

bool SubgraphChoice::begin_step(Controller& controller, StepIndex step, bool is_running,
                                std::optional<double> battery_v) {
  if (is_running) let_policies_choose(step, battery_v);
  const PreparedChoice& choice = operator_ ? *operator_ : prepared(wished_);
  const PreparedSubgraph& next = choice.under(limit_for(controller));
  if (next.subgraph == controller.prepared_subgraph().subgraph) return false;
  controller.switch_to(next);
  return true;
}

void SubgraphChoice::end_step(const Controller& controller, const Report& report,
                              const HeardInStep& heard) {
  last_ = report;
  if (!looks_ahead()) return;
  const auto limited = [this](const SubgraphRequest& candidate,
                              const Controller& one) -> const PreparedSubgraph& {
    return prepared(candidate).under(limit_for(one));
  };
  for (LookAhead* policy : look_aheads_) policy->rehearse(controller, heard, limited);
}

}  // namespace hlc
