#include "planner/policy/subgraph_selector.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"
#include "planner/policy/policy_check.hpp"
#include "planner/policy/speed_zones.hpp"

namespace hlc::policy {
namespace {

/// Times are multiples of a step, which a double does not represent exactly.
constexpr double kStepRounding_s = 1e-6;
/// Added to the steps in which a vehicle slows down: see the header.
constexpr std::size_t kStepsUntilItSlowsDown = 3;

}  // namespace

SubgraphSelector::SubgraphSelector(const controller::Controller& controller,
                                   const ReconfigurationSettings& settings)
    : base_(controller.prepared_subgraph()),
      settings_(settings),
      reference_speed_mps_(controller.options().reference_speed_mps),
      limits_mps_(policy::limits_mps(settings.zones)),
      step_s_(base_.subgraph->automaton().step_s) {
  const controller::ControllerOptions& options = controller.options();
  for (const SubgraphRequest& request : requests_of(settings)) {
    choices_.emplace_back(request, PreparedChoice(base_, request, limits_mps_,
                                                  options.horizon_steps, options.search));
    see_zones_for(choices_.back().second);
  }
  for (const PolicySettings& one : settings.policies) policies_.push_back(make_policy(one));
}

void SubgraphSelector::see_zones_for(const PreparedChoice& choice) {
  const auto steps = static_cast<double>(choice.steps_to_slow_down() + kStepsUntilItSlowsDown);
  zone_ahead_m_ = std::max(zone_ahead_m_, steps * step_s_ * choice.top_speed_mps());
}

void SubgraphSelector::ask(std::shared_ptr<const PreparedChoice> request) {
  operator_ = std::move(request);
  if (operator_) see_zones_for(*operator_);
}

const PreparedChoice& SubgraphSelector::prepared(const SubgraphRequest& request) const {
  const auto found =
      std::ranges::find(choices_, request, [](const auto& one) { return one.first; });
  HLC_DEMAND(found != choices_.end() && "policies name all that they may ask for");
  return found->second;
}

const PreparedChoice& SubgraphSelector::in_force() const {
  return operator_ ? *operator_ : prepared(proposed_);
}

SubgraphSelector::Decision SubgraphSelector::decision() const {
  Decision decision{.choice = &in_force(),
                    .is_operators = operator_ != nullptr,
                    .policy = {},
                    .zone = zone_,
                    .subgraph_limit_mps = subgraph_limit_mps(zone_),
                    .own = &prepared({})};
  if (!operator_ && proposed_by_ != kNoPolicyCounts) decision.policy = proposed_by_;
  return decision;
}

std::optional<double> SubgraphSelector::subgraph_limit_mps(std::optional<std::size_t> zone) const {
  if (!zone || settings_.zones_limit != ZonesLimit::kSubgraph) return std::nullopt;
  return limit_mps(*zone);
}

bool SubgraphSelector::apply(const PreparedChoice& choice, std::optional<std::size_t> zone,
                             controller::Controller& controller) const {
  if (settings_.zones_limit == ZonesLimit::kReference) {
    const double most_mps = zone ? limit_mps(*zone) : reference_speed_mps_;
    controller.set_reference_speed(std::min(reference_speed_mps_, most_mps));
  }
  const controller::PreparedSubgraph& next = choice.under(subgraph_limit_mps(zone));
  if (next.subgraph == controller.prepared_subgraph().subgraph) return false;
  controller.switch_to(next);
  return true;
}

std::optional<std::size_t> SubgraphSelector::zone_for(const controller::Controller& controller,
                                                      StepIndex step) const {
  if (settings_.zones.empty() || !controller.has_plan()) return std::nullopt;
  const std::optional<double> s_m =
      controller.path_s_m_of(controller.plan_in_force().pose_at(step).position_m());
  if (!s_m) return std::nullopt;
  return least_zone_on(settings_.zones, controller.route().path, *s_m, zone_ahead_m_);
}

void SubgraphSelector::let_policies_choose(StepIndex step, StepIndex start,
                                           std::optional<double> battery_v) {
  const auto seconds_since = [&](StepIndex then) {
    return step_s_ * static_cast<double>(step.value - std::min(step, then).value);
  };
  const PolicyView view{
      .time_s = seconds_since(start), .last = last_ ? &*last_ : nullptr, .battery_v = battery_v};
  SubgraphRequest proposed;
  counts_ = kNoPolicyCounts;
  for (std::size_t i = 0; i < policies_.size(); ++i) {  // all are called: they have a state
    const std::optional<SubgraphRequest> proposal = policies_[i]->propose(view);
    if (!proposal || counts_ != kNoPolicyCounts) continue;
    proposed = *proposal;
    counts_ = i;
  }
  if (proposed == proposed_) return;
  const bool has_stayed =
      !proposed_since_ || seconds_since(*proposed_since_) + kStepRounding_s >= settings_.min_stay_s;
  if (!has_stayed && counts_ >= proposed_by_) return;
  proposed_ = proposed;
  proposed_by_ = counts_;
  proposed_since_ = step;
}

bool SubgraphSelector::begin_step(controller::Controller& controller, StepIndex step,
                                  std::optional<StepIndex> start, std::optional<double> battery_v) {
  if (start) let_policies_choose(step, *start, battery_v);
  zone_ = zone_for(controller, step);
  return apply(in_force(), zone_, controller);
}

bool SubgraphSelector::looks_ahead() const {
  return !operator_ && std::ranges::any_of(policies_, &Policy::looks_ahead);
}

void SubgraphSelector::end_step(const controller::Controller& controller,
                                const coordination::Report& report, bool may_look_ahead) {
  last_ = report;
  if (operator_ || !may_look_ahead) return;
  const auto switch_to = [this](const SubgraphRequest& request, controller::Controller& one) {
    apply(prepared(request), zone_for(one, {one.last_step().value + 1}), one);
  };
  for (std::size_t i = 0; i < policies_.size(); ++i) {
    if (i <= counts_) policies_[i]->look_ahead(controller, switch_to);
  }
}

}  // namespace hlc::policy
