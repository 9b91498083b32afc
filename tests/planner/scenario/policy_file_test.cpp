#include "planner/scenario/policy_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::scenario::policy_file_test {
namespace {

using testing::HasSubstr;

std::map<std::string, policy::ReconfigurationSettings> read(const std::string& text) {
  static const automaton::Subgraph base =
      test::make_test_subgraph({test::kSlow, test::kFast}, test::kAllTrims);
  const Node node = Node::parse_yaml(text, "test.yaml");
  auto policies = read_policies(node);
  for (const auto& [name, settings] : policies) check_policy(node, name, settings, base, 8, {});
  return policies;
}

std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PolicyFile, ReadsEveryKind) {
  const auto policies = read(R"(
policies:
  zone:
    zones: [{x_m: [1.0, 2.0], y_m: [-1, 3.5], max_speed_mps: 0.5}]
  rules:
    min_stay_s: 0.4
    rules:
      - time: [{from_s: 0, request: {labels: [slow]}}, {from_s: 2.5, request: {}}]
      - battery: {below_v: 7.0, back_above_v: 7.4, request: {max_speed_mps: 0.6, disable_trims: [12]}}
      - situation: {open_road: {labels: [slow]}, conflict: {labels: [slow, fast]}, after_conflict_s: 0}
      - look_ahead: {candidates: [{labels: [slow]}, {}], steps: 5, least_gain: 0.1, max_expansions: 4000}
)");
  ASSERT_EQ(policies.size(), 2U);
  const policy::ReconfigurationSettings zone{
      .zones =
          {{.min_x_m = 1.0, .max_x_m = 2.0, .min_y_m = -1.0, .max_y_m = 3.5, .max_speed_mps = 0.5}},
      .policies = {},
      .min_stay_s = 1.0};
  EXPECT_EQ(policies.at("zone"), zone);
  const std::string zones =
      "policies: {a: {zones: [{x_m: [1, 2], y_m: [-1, 3.5], max_speed_mps: 0.5}]";
  EXPECT_EQ(read(zones + ", zones_limit: reference}}").at("a").zones_limit,
            policy::ZonesLimit::kReference);
  EXPECT_EQ(read(zones + ", zones_limit: subgraph}}").at("a"), read(zones + "}}").at("a"));
  const SubgraphRequest slow{.labels = {"slow"}};
  const policy::ReconfigurationSettings rules{
      .zones = {},
      .policies = {policy::TimePolicySettings{.changes = {{0.0, slow}, {2.5, {}}}},
                   policy::BatteryPolicySettings{
                       .below_v = 7.0,
                       .back_above_v = 7.4,
                       .request = {.max_speed_mps = 0.6, .disable_trims = {{11}}}},
                   policy::SituationPolicySettings{.open_road = slow,
                                                   .conflict = {.labels = {"slow", "fast"}},
                                                   .after_conflict_s = 0.0},
                   policy::LookAheadSettings{.candidates = {slow, {}},
                                             .steps = 5,
                                             .criterion_weights = {},
                                             .least_gain = 0.1,
                                             .max_expansions = 4000}},
      .min_stay_s = 0.4};
  EXPECT_EQ(policies.at("rules"), rules);
  EXPECT_TRUE(read("name: none").empty());
}

TEST(PolicyFile, WhatCannotBeIsRefusedInOneLineWithPlaceAndWhatIsAllowed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"none: {}", "policy 'none', must be another name"},
      {"a: {zones: [{x_m: [2, 1], y_m: [0, 1], max_speed_mps: 0.5}]}",
       "x_m[2] = 1, must be a number > 2"},
      {"a: {zones: [{x_m: [2], y_m: [0, 1], max_speed_mps: 0.5}]}", "two numbers, [from, to]"},
      {"a: {zones: [{x_m: [1, 2], y_m: [0, 1], max_speed_mps: 0.2}]}",
       "policies.a = (a map): in the zone of 0.2 m/s: speed limit 0.2 m/s, must be >= 0.4"},
      {"a: {zones_limit: car, zones: [{x_m: [1, 2], y_m: [0, 1], max_speed_mps: 0.5}]}",
       "zones_limit = car, must be one of reference, subgraph"},
      {"a: {zones_limit: reference, min_stay_s: 2}",
       "zones_limit = reference, must be absent, unless there are `zones`"},
      {"a: {rules: [{weather: {}}]}", "policies.a.rules[1] = (a map), must be a map of one key"},
      {"a: {rules: [{time: []}]}", "at least one entry"},
      {"a: {rules: [{time: [{from_s: 2, request: {}}, {from_s: 1, request: {}}]}]}",
       "from_s = 1, must be a number > 2"},
      {"a: {rules: [{time: [{from_s: 2, request: {labels: [J9]}}]}]}",
       "policies.a = (a map): label 'J9', must be one of fast, slow"},
      {"a: {rules: [{time: [{from_s: 2, request: {label: J9}}]}]}", "label"},
      {"a: {rules: [{time: [{from_s: 2, request: {disable_trims: [13]}}]}]}",
       "trim 13, must be in 1 ... 12"},
      {"a: {rules: [{battery: {below_v: 7, back_above_v: 6, request: {}}}]}", "back_above_v = 6"},
      {"a: {rules: [{look_ahead: {candidates: [{}], max_expansions: 10}}]}", "2 ... 100 requests"},
      {"a: {rules: [{look_ahead: {candidates: [{}, {labels: [slow]}]}}]}", "max_expansions"},
      {"a: {rules: [{look_ahead: {candidates: [{}, {labels: [slow]}], max_expansions: 2501}}]}",
       "max_expansions = 2501, must be in 1 ... 2500"},
      {"a: {rules: [{look_ahead: {candidates: [{}, {labels: [slow]}], max_expansions: 9, "
       "criterion_weights: {J2: 1}}}]}",
       "criterion_weights: J2, must be one of"},
      {"a: {rules: [{time: [], situation: {}}]}", "must be a map of one key"},
      {"a: {rules: [{time: [{from_s: 2, request: {labels: []}}]}]}",
       "labels = (a list), must be a list with at least one"},
      {"a: {min_stay_s: 2}", "at least one"},
      {"a: {min_stay_s: -1}", "min_stay_s = -1"},
  };
  for (const auto& [policy, expected] : cases) {
    const std::string refusal = refusal_of("policies:\n  " + policy + "\n");
    EXPECT_THAT(refusal, HasSubstr(expected)) << policy;
    EXPECT_THAT(refusal, testing::StartsWith("test.yaml:")) << policy;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << policy;
  }
}

TEST(PolicyFile, TheScenariosPolicyHoldsUnlessAnotherIsChosen) {
  const std::string file = test::source_folder() + "/launch_scripts/scenarios/reconfiguration.yaml";
  const Scenario mixed = read_scenario({.file = file});
  EXPECT_EQ(mixed.policy, "mixed");
  EXPECT_EQ(mixed.reconfiguration, mixed.policies.at("mixed"));
  const Scenario zone = read_scenario({.file = file, .policy = "zone"});
  EXPECT_EQ(zone.reconfiguration, mixed.policies.at("zone"));
  EXPECT_EQ(read_scenario({.file = file, .policy = "none"}).reconfiguration,
            policy::ReconfigurationSettings{});
  try {
    static_cast<void>(read_scenario({.file = file, .policy = "zones"}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "--policy = zones, must be one of none, look_ahead, mixed, situation, time, zone, "
                 "zone_look_ahead, zone_reference");
  }
}

// D has no trim 3 that could be switched off.
TEST(PolicyFile, OnAnotherSubgraphOnlyThePolicyThatIsDrivenMustFit) {
  const std::string folder = test::source_folder() + "/launch_scripts/";
  std::ifstream good(folder + "scenarios/paper_red_alone.yaml");
  std::string text((std::istreambuf_iterator<char>(good)), {});
  for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;) {
    text.replace(at, 3, folder);
  }
  const test::TemporaryFolder own;
  test::put(own / "s.yaml", text + R"(
policies:
  without_3: {rules: [{time: [{from_s: 0, request: {disable_trims: [3]}}]}]}
  slow: {rules: [{time: [{from_s: 0, request: {max_speed_mps: 0.7}}]}]}
)");
  const auto read_d = [&](const std::string& policy) {
    return read_scenario({.file = own / "s.yaml", .subgraph = "D", .policy = policy});
  };
  EXPECT_EQ(read_d("none").policies.size(), 2U);
  EXPECT_EQ(read_d("slow").policy, "slow");
  EXPECT_THAT([&] { static_cast<void>(read_d("without_3")); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("policies.without_3")));
}

// At the right place no car would slow down.
TEST(PolicyFile, AZoneThatNoRouteComesThroughIsRefused) {
  const std::string folder = test::source_folder() + "/launch_scripts/";
  std::ifstream shipped(folder + "scenarios/reconfiguration.yaml");
  std::string text((std::istreambuf_iterator<char>(shipped)), {});
  const auto replace_all = [&text](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
  };
  replace_all("../", folder);
  replace_all("x_m: [1.9, 2.7]", "x_m: [10.9, 12.7]");
  const test::TemporaryFolder temporary;
  const std::string file = temporary / "zone_beside_all_routes.yaml";
  std::ofstream(file) << text;
  try {
    static_cast<void>(read_scenario({.file = file}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("policies.mixed.zones[1].x_m"));
    EXPECT_THAT(error.what(), HasSubstr("must be a zone that a route passes"));
  }
}

}  // namespace
}  // namespace hlc::scenario::policy_file_test
