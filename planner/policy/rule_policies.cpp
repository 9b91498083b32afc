#include "planner/policy/rule_policies.hpp"

#include <limits>
#include <utility>

namespace hlc::policy {
namespace {

/// Times are multiples of a step, which a double does not represent exactly.
constexpr double kRounding_s = 1e-6;

class TimePolicy final : public Policy {
 public:
  explicit TimePolicy(TimePolicySettings settings) : settings_(std::move(settings)) {}

  std::optional<SubgraphRequest> propose(const PolicyView& view) override {
    std::optional<SubgraphRequest> proposed;
    for (const TimePolicySettings::Change& change : settings_.changes) {
      if (change.from_s <= view.time_s + kRounding_s) proposed = change.request;
    }
    return proposed;
  }

  std::vector<SubgraphRequest> choices() const override {
    std::vector<SubgraphRequest> choices;
    for (const auto& change : settings_.changes) choices.push_back(change.request);
    return choices;
  }

 private:
  TimePolicySettings settings_;
};

class SituationPolicy final : public Policy {
 public:
  explicit SituationPolicy(SituationPolicySettings settings) : settings_(std::move(settings)) {}

  std::optional<SubgraphRequest> propose(const PolicyView& view) override {
    const coordination::Report* last = view.last;
    if (last != nullptr &&
        (!last->coupled.empty() || last->status == coordination::StepStatus::kFallback)) {
      last_conflict_s_ = view.time_s;
    }
    const bool is_over = view.time_s - last_conflict_s_ > settings_.after_conflict_s + kRounding_s;
    return is_over ? settings_.open_road : settings_.conflict;
  }

  std::vector<SubgraphRequest> choices() const override {
    return {settings_.open_road, settings_.conflict};
  }

 private:
  SituationPolicySettings settings_;
  double last_conflict_s_{-std::numeric_limits<double>::infinity()};
};

class BatteryPolicy final : public Policy {
 public:
  explicit BatteryPolicy(BatteryPolicySettings settings) : settings_(std::move(settings)) {}

  std::optional<SubgraphRequest> propose(const PolicyView& view) override {
    if (view.battery_v && *view.battery_v < settings_.below_v) is_weak_ = true;
    if (view.battery_v && *view.battery_v > settings_.back_above_v) is_weak_ = false;
    return is_weak_ ? std::optional(settings_.request) : std::nullopt;
  }

  std::vector<SubgraphRequest> choices() const override { return {settings_.request}; }

 private:
  BatteryPolicySettings settings_;
  bool is_weak_{};
};

}  // namespace

std::unique_ptr<Policy> make_policy_of(const TimePolicySettings& settings) {
  return std::make_unique<TimePolicy>(settings);
}

std::unique_ptr<Policy> make_policy_of(const SituationPolicySettings& settings) {
  return std::make_unique<SituationPolicy>(settings);
}

std::unique_ptr<Policy> make_policy_of(const BatteryPolicySettings& settings) {
  return std::make_unique<BatteryPolicy>(settings);
}

}  // namespace hlc::policy
