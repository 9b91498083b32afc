#include "planner/scenario/strategy_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "planner/common/text_file.hpp"
#include "planner/controller/coordination_rules.hpp"
#include "planner/coordination/coupling_rule.hpp"
#include "planner/right_of_way/grant_order.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::strategy_values_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Profile chosen(const std::string& text) {
  Profile profile = profile_from_name("default");
  choose_strategies(read_strategies(Node::parse_yaml(text, "file.yaml")), profile);
  return profile;
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(chosen(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string key(const std::string& name, std::string_view value) {
  return name + ": " + std::string(value);
}

TEST(StrategyValues, AreTheProfilesByDefault) {
  const Profile profile = chosen("name: x");
  EXPECT_EQ(profile.strategies, profile_from_name("default").strategies);
  EXPECT_EQ(profile.reference_rule, road::half_speed_last);
}

TEST(StrategyValues, AreTheEntriesOfTheirRegistries) {
  for (const auto& [name, rule] : controller::coordination_rules()) {
    EXPECT_EQ(chosen(key("coordination", name)).strategies.coordination, rule);
    EXPECT_EQ(controller::name_of(rule), name);
  }
  for (const coordination::CouplingRule* rule : coordination::coupling_rules()) {
    EXPECT_EQ(chosen(key("coupling", rule->name)).strategies.coupling, rule);
  }
  for (const road::NamedReferenceRule& one : road::reference_rules()) {
    EXPECT_EQ(chosen(key("reference_rule", one.name)).reference_rule, one.rule);
    EXPECT_EQ(road::name_of(one.rule), one.name);
  }
  for (const right_of_way::GrantOrder* order : right_of_way::grant_orders()) {
    EXPECT_EQ(chosen(key("right_of_way_order", order->name)).strategies.grant_order, order);
  }
}

TEST(StrategyValues, ThatAreUnknownAreRefusedWithTheKnownOnes) {
  EXPECT_THAT(refusal("coordination: none"),
              AllOf(HasSubstr("file.yaml:1: coordination = none"), HasSubstr("cooperative")));
  EXPECT_THAT(refusal("coupling: none"),
              AllOf(HasSubstr("coupling = none"), HasSubstr("reachable_areas, all")));
  EXPECT_THAT(refusal("reference_rule: none"), HasSubstr("half_speed_last, mean_speed_first"));
  EXPECT_THAT(refusal("right_of_way_order: none"), HasSubstr("longest_wait, nearest_end"));
}

TEST(StrategyValues, AnOrderWithoutRightOfWayIsRefused) {
  const std::string file = test::source_folder() + "/launch_scripts/scenarios/town.yaml";
  const auto parse = [&](const std::string& text) {
    static_cast<void>(parse_scenario(Node::parse_yaml(text, file), file));
  };
  std::string text = read_file(file) + "\nright_of_way_order: nearest_end\n";
  EXPECT_NO_THROW(parse(text));
  text.replace(text.find("right_of_way: true"), 18, "right_of_way: false");
  EXPECT_THROW(parse(text), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::strategy_values_test
