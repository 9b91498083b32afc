#include "planner/scenario/policy_file.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/policy/policy_check.hpp"
#include "planner/scenario/search_values.hpp"

namespace hlc::scenario {
namespace {

constexpr double kLongest_s = 86'400.0;
constexpr std::size_t kMostCandidates = 100;
constexpr double kMostVolts = 1000.0;

std::vector<TrimId> read_trims(const Node& node, const std::string& key) {
  std::vector<TrimId> trims;
  for (const Node& entry : node.optional_list(key)) {
    trims.push_back({entry.as<std::size_t>(at_least(1.0)) - 1});
  }
  return trims;
}

SubgraphRequest read_request(const Node& node) {
  SubgraphRequest request;
  for (const Node& label : node.optional_list("labels")) {
    request.labels.push_back(label.as<std::string>());
  }
  if (node.has("labels") && request.labels.empty())
    node.fail("labels", "a list with at least one label");
  const double max_speed_mps = node.optional<double>("max_speed_mps", 0.0, above(0.0));
  if (node.has("max_speed_mps")) request.max_speed_mps = max_speed_mps;
  request.enable_trims = read_trims(node, "enable_trims");
  request.disable_trims = read_trims(node, "disable_trims");
  node.check_no_unknown_keys();
  return request;
}

std::pair<double, double> read_range(const Node& node, const std::string& key) {
  const std::vector<Node> bounds = node.list(key);
  if (bounds.size() != 2) node.fail(key, "two numbers, [from, to]");
  const auto from = bounds[0].as<double>();
  const auto to = bounds[1].as<double>(above(from));
  return {from, to};
}

policy::SpeedZone read_zone(const Node& node) {
  policy::SpeedZone zone;
  std::tie(zone.min_x_m, zone.max_x_m) = read_range(node, "x_m");
  std::tie(zone.min_y_m, zone.max_y_m) = read_range(node, "y_m");
  zone.max_speed_mps = node.required<double>("max_speed_mps", above(0.0));
  node.check_no_unknown_keys();
  return zone;
}

policy::TimePolicySettings read_time(const Node& rule) {
  policy::TimePolicySettings settings;
  double last_s = 0.0;
  for (const Node& node : rule.list("time")) {
    const bool is_first = settings.changes.empty();
    const auto from_s = node.required<double>(
        "from_s", is_first ? between(0.0, kLongest_s) : above(last_s, kLongest_s));
    settings.changes.push_back({.from_s = from_s, .request = read_request(node.map("request"))});
    node.check_no_unknown_keys();
    last_s = from_s;
  }
  if (settings.changes.empty()) rule.fail("time", "a list with at least one entry");
  return settings;
}

policy::SituationPolicySettings read_situation(const Node& rule) {
  const Node node = rule.map("situation");
  policy::SituationPolicySettings settings{.open_road = read_request(node.map("open_road")),
                                           .conflict = read_request(node.map("conflict"))};
  settings.after_conflict_s = node.optional<double>("after_conflict_s", settings.after_conflict_s,
                                                    between(0.0, kLongest_s));
  node.check_no_unknown_keys();
  return settings;
}

policy::BatteryPolicySettings read_battery(const Node& rule) {
  const Node node = rule.map("battery");
  policy::BatteryPolicySettings settings;
  settings.below_v = node.required<double>("below_v", above(0.0, kMostVolts));
  settings.back_above_v = node.optional<double>("back_above_v", settings.below_v,
                                                between(settings.below_v, kMostVolts));
  settings.request = read_request(node.map("request"));
  node.check_no_unknown_keys();
  return settings;
}

policy::LookAheadSettings read_look_ahead(const Node& rule) {
  const Node node = rule.map("look_ahead");
  policy::LookAheadSettings settings;
  for (const Node& candidate : node.list("candidates")) {
    settings.candidates.push_back(read_request(candidate));
  }
  const std::size_t candidates = settings.candidates.size();
  if (candidates < 2 || candidates > kMostCandidates) {
    node.fail("candidates", fmt::format("a list of 2 ... {} requests", kMostCandidates));
  }
  settings.steps = node.optional<std::size_t>("steps", settings.steps, between(1.0, 64.0));
  settings.criterion_weights = read_criterion_weights(node);
  settings.least_gain =
      node.optional<double>("least_gain", settings.least_gain, between(0.0, 0.99));
  const std::size_t most = policy::kMostLookAheadExpansions / (candidates * settings.steps);
  settings.max_expansions = node.required<std::size_t>("max_expansions", at_least(1.0));
  if (settings.max_expansions > most) {
    node.fail("max_expansions",
              fmt::format("in 1 ... {}: with {} candidates over {} steps {} in all", most,
                          candidates, settings.steps, policy::kMostLookAheadExpansions));
  }
  node.check_no_unknown_keys();
  return settings;
}

policy::PolicySettings read_rule(const Node& node) {
  const std::vector<std::string> keys = node.keys();
  if (keys.size() == 1) {
    const std::string& kind = keys.front();
    if (kind == "time") return read_time(node);
    if (kind == "situation") return read_situation(node);
    if (kind == "battery") return read_battery(node);
    if (kind == "look_ahead") return read_look_ahead(node);
  }
  node.fail("a map of one key: time, situation, battery or look_ahead");
}

policy::ZonesLimit read_zones_limit(const Node& node) {
  if (!node.has("zones_limit")) return policy::ZonesLimit::kSubgraph;
  const auto limited = node.required<std::string>("zones_limit", one_of({"reference", "subgraph"}));
  if (!node.has("zones")) node.fail("zones_limit", "absent, unless there are `zones`");
  return limited == "reference" ? policy::ZonesLimit::kReference : policy::ZonesLimit::kSubgraph;
}

policy::ReconfigurationSettings read_policy(const Node& node) {
  policy::ReconfigurationSettings settings;
  for (const Node& zone : node.optional_list("zones")) {
    settings.zones.push_back(read_zone(zone));
  }
  settings.zones_limit = read_zones_limit(node);
  for (const Node& rule : node.optional_list("rules")) {
    settings.policies.push_back(read_rule(rule));
  }
  settings.min_stay_s =
      node.optional<double>("min_stay_s", settings.min_stay_s, between(0.0, kLongest_s));
  node.check_no_unknown_keys();
  if (settings.zones.empty() && settings.policies.empty()) {
    node.fail("rules", "a list with at least one rule, unless there are `zones`");
  }
  return settings;
}

}  // namespace

std::map<std::string, policy::ReconfigurationSettings> read_policies(const Node& scenario) {
  std::map<std::string, policy::ReconfigurationSettings> policies;
  const Node node = scenario.optional_map("policies");
  for (const std::string& name : node.keys()) {
    if (name == policy::kNoPolicy) {
      throw std::invalid_argument(scenario.place("policies") + ": policy '" + name +
                                  "', must be another name: it means no policy");
    }
    policies.emplace(name, read_policy(node.map(name)));
  }
  return policies;
}

void check_policy(const Node& scenario, const std::string& name,
                  const policy::ReconfigurationSettings& settings, const automaton::Subgraph& base,
                  std::size_t horizon_steps, const std::optional<vehicle::LabLimits>& lab) {
  try {
    policy::check_reconfiguration(base, settings, horizon_steps, lab);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scenario.map("policies").place(name) + ": " + error.what());
  }
}

}  // namespace hlc::scenario
