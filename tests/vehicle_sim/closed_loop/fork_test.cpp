#include "vehicle_sim/closed_loop/fork.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <random>
#include <stdexcept>

#include "hlc_bridge/result/first_difference.hpp"
#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/scenario/profile.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/vehicle_sim/closed_loop/forked_scenarios.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::closed_loop::fork_test {
namespace {

using Rows = std::vector<result::StepRecord>;

constexpr std::uint64_t kSteps = 60;

Rows rows_of(const ExperimentOptions& options, const scenario::Scenario& scenario = three_cars()) {
  const Experiment experiment = drive_experiment(scenario, options);
  EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  return result::step_records(experiment.reports, experiment.drives, experiment.facts);
}

const Rows& as_it_was() {
  static const Rows kRows = rows_of({.steps = kSteps});
  return kRows;
}

Rows with(std::uint64_t from, std::vector<Fork::Change> changes) {
  return rows_of({.steps = kSteps, .forks = {{.from = from, .changes = std::move(changes)}}});
}

const coordination::Report& report_of(const Rows& rows, std::uint64_t step, std::uint8_t vehicle) {
  return std::ranges::find_if(rows,
                              [&](const result::StepRecord& row) {
                                return row.step == step &&
                                       row.record.report.vehicle.value == vehicle;
                              })
      ->record.report;
}

/// The first step in which vehicle a is coupled with vehicle b.
std::uint64_t first_coupled(std::uint8_t a, std::uint8_t b) {
  std::uint64_t step = 0;
  while (!std::ranges::count(report_of(as_it_was(), step, a).coupled, VehicleId{b})) ++step;
  return step;
}

TEST(Fork, WithNothingChangedGivesTheSameTrace) {
  const std::string trace = result::trace_sha256(as_it_was());
  const Fork::Change same_order = Fork::Priorities{{{1}, {2}, {3}}};
  const Fork::Change same_rule = Fork::Coordination{controller::kCooperativeCoordination};
  for (std::uint64_t seed = 0; seed < test::num_seeds(20); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const std::uint64_t from = std::uniform_int_distribution<std::uint64_t>(0, kSteps - 1)(random);
    std::vector<Fork::Change> changes;
    if (random() % 2 == 0) changes.push_back(same_order);
    if (random() % 2 == 0) changes.push_back(same_rule);
    EXPECT_EQ(result::trace_sha256(with(from, changes)), trace);
  }
}

TEST(Fork, WithAnotherOrderDiffersFromThatStepOnWhereVehiclesAreCoupled) {
  const std::uint64_t coupled = first_coupled(1, 2);
  for (const std::uint64_t from : {coupled, coupled + 3}) {
    const Rows rows = with(from, {Fork::Priorities{{{3}, {2}}}});
    const auto difference = result::first_difference(as_it_was(), rows);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->step, from);
    EXPECT_GT(report_of(rows, from, 1).level, report_of(rows, from, 2).level);
  }
}

TEST(Fork, ALostMessageIsMissedByItsReceiverOnlyAndOnlyThen) {
  const Rows rows = with(20, {Fork::Lost{.from = {1}, .to = {3}, .steps = 2}});
  for (std::uint64_t step = 18; step < 25; ++step) {
    const bool is_lost = step == 20 || step == 21;
    EXPECT_EQ(report_of(rows, step, 3).missing,
              is_lost ? std::vector<VehicleId>{{1}} : std::vector<VehicleId>{})
        << "step " << step;
    EXPECT_THAT(report_of(rows, step, 2).missing, testing::IsEmpty());
    EXPECT_THAT(report_of(rows, step, 1).missing, testing::IsEmpty());
  }
}

TEST(Fork, AVehicleThatIsGoneIsInNoLaterStepAndNobodyMissesIt) {
  constexpr std::uint64_t kFrom = 12;
  const Rows rows = with(kFrom, {Fork::Without{{2}}});
  for (const result::StepRecord& row : rows) {
    EXPECT_FALSE(row.step >= kFrom && row.record.report.vehicle == VehicleId{2});
    if (row.step < kFrom) continue;
    EXPECT_EQ(std::ranges::count(row.record.report.coupled, VehicleId{2}), 0);
    EXPECT_THAT(row.record.report.missing, testing::IsEmpty());
    EXPECT_EQ(row.record.report.status, coordination::StepStatus::kPlanned);
  }
  EXPECT_EQ(rows.back().step, kSteps - 1);
  const auto difference = result::first_difference(as_it_was(), rows);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->step, kFrom);
}

TEST(Fork, AVehicleIsAsSlowAsItsLimitAndOthersAreNotLimited) {
  const Rows rows = with(10, {Fork::MaxSpeed{.vehicle = {1}, .max_speed_mps = 0.5}});
  const auto longest_step_m = [&](std::uint8_t vehicle) {
    double longest_m = 0.0;
    for (std::uint64_t step = 20; step + 1 < kSteps; ++step) {
      const Point from_m = report_of(rows, step, vehicle).planned_pose.position_m();
      const Point to_m = report_of(rows, step + 1, vehicle).planned_pose.position_m();
      longest_m = std::max(longest_m, (to_m - from_m).norm());
    }
    return longest_m;
  };
  EXPECT_LT(longest_step_m(1), 0.5 * 0.2 + 1e-9);
  EXPECT_GT(longest_step_m(2), 0.6 * 0.2);
}

TEST(Fork, FromTheFirstStepOnIsTheRunWithTheseRules) {
  const auto run_with = [](const controller::ControllerStrategies& strategies) {
    scenario::Scenario scenario = three_cars();
    scenario.profile.strategies = strategies;
    return rows_of({.steps = kSteps}, scenario);
  };
  controller::ControllerStrategies strategies = three_cars().profile.strategies;
  strategies.coordination = controller::kAgreedCoordination;
  const Rows agreed = with(0, {Fork::Coordination{strategies.coordination}});
  EXPECT_FALSE(result::first_difference(agreed, run_with(strategies)));
  EXPECT_TRUE(result::first_difference(agreed, as_it_was()));
  strategies = three_cars().profile.strategies;
  strategies.priorities.first = {{3}, {2}};
  const Rows reversed = with(0, {Fork::Priorities{{{3}, {2}}}});
  EXPECT_FALSE(result::first_difference(reversed, run_with(strategies)));
  EXPECT_TRUE(result::first_difference(reversed, as_it_was()));
}

// The controllers' replicas of the others used to keep the former order, so that nobody could plan
// for anybody: all steps were sequential.
TEST(Fork, WithAnotherOrderKeepsTwoRounds) {
  scenario::Scenario two_rounds = three_cars();
  two_rounds.rounds = controller::Rounds::kTwo;
  const std::vector<Fork> forks{{.from = 10, .changes = {Fork::Priorities{{{3}, {2}}}}}};
  // Without predictions only two rounds have the others' plans.
  ExperimentOptions options{.steps = kSteps, .forks = forks};
  options.rules.is_lost = [](const controller::Delivery& delivery) {
    return delivery.kind == controller::MessageKind::kPrediction;
  };
  EXPECT_EQ(result::trace_sha256(rows_of(options, two_rounds)),
            result::trace_sha256(rows_of({.steps = kSteps, .forks = forks})));
}

TEST(Fork, SeveralForksOfARunHoldTogetherWhateverTheirOrder) {
  const Fork gone{.from = 40, .changes = {Fork::Without{{3}}}};
  const Fork slow{.from = 10, .changes = {Fork::MaxSpeed{.vehicle = {3}, .max_speed_mps = 0.4}}};
  EXPECT_EQ(result::trace_sha256(rows_of({.steps = kSteps, .forks = {gone, slow}})),
            result::trace_sha256(rows_of({.steps = kSteps, .forks = {slow, gone}})));
}

// The request of a vehicle that was gone used to be passed on to nobody.
TEST(Fork, AChangeOfAVehicleThatIsGoneInTheSameStepHasNoEffect) {
  const Fork::Change slow = Fork::MaxSpeed{.vehicle = {2}, .max_speed_mps = 0.4};
  const Fork::Change gone = Fork::Without{{2}};
  const Rows rows = with(10, {slow, gone});
  EXPECT_FALSE(result::first_difference(with(10, {gone}), rows));
}

TEST(Fork, IsCheckedInTheOrderOfSteps) {
  const Fork gone{.from = 20, .changes = {Fork::Without{{2}}}};
  const Fork slow{.from = 10, .changes = {Fork::MaxSpeed{.vehicle = {2}, .max_speed_mps = 0.4}}};
  EXPECT_NO_THROW(check_forks({gone, slow}, three_cars(), kSteps));
  const Fork later{.from = 30, .changes = {Fork::MaxSpeed{.vehicle = {2}, .max_speed_mps = 0.4}}};
  EXPECT_THROW(check_forks({later, gone}, three_cars(), kSteps), std::invalid_argument);
}

TEST(ChangeText, IsReadAsWritten) {
  const auto read = [](const std::string& text) { return change_from_text(text, three_cars()); };
  EXPECT_EQ(read("priorities=3,1"), Fork::Change(Fork::Priorities{{{3}, {1}}}));
  EXPECT_EQ(read("coordination=strict"),
            Fork::Change(Fork::Coordination{controller::kStrictCoordination}));
  EXPECT_EQ(read("criteria=2:J2+J3"),
            Fork::Change(Fork::Labels{.vehicle = {2}, .labels = {"J2", "J3"}}));
  EXPECT_EQ(read("speed=2:0.4"),
            Fork::Change(Fork::MaxSpeed{.vehicle = {2}, .max_speed_mps = 0.4}));
  EXPECT_EQ(read("without=3"), Fork::Change(Fork::Without{{3}}));
  EXPECT_EQ(read("lost=1>2"), Fork::Change(Fork::Lost{.from = {1}, .to = {2}, .steps = 1}));
  EXPECT_EQ(
      read("obstacle=1.5,2,0.3,0.1,-0.5"),
      Fork::Change(Fork::Obstacle{.pose = {1.5, 2.0, -0.5}, .length_m = 0.3, .width_m = 0.1}));
  EXPECT_EQ(read("obstacle=1.5,2,0.3,0.1"),
            Fork::Change(Fork::Obstacle{.pose = {1.5, 2.0, 0.0}, .length_m = 0.3, .width_m = 0.1}));
  EXPECT_EQ(read("route=2:red"), Fork::Change(Fork::Route{.vehicle = {2}, .name = "red"}));
  EXPECT_EQ(read("lost=1>2:7"), Fork::Change(Fork::Lost{.from = {1}, .to = {2}, .steps = 7}));
}

struct BadChange {
  std::string text;
  std::string named;
};
void PrintTo(const BadChange& one, std::ostream* out) { *out << '"' << one.text << '"'; }

class BadChangeText : public testing::TestWithParam<BadChange> {};

TEST_P(BadChangeText, IsRefusedInOneLine) {
  try {
    static_cast<void>(change_from_text(GetParam().text, three_cars()));
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().named));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fork, BadChangeText,
    testing::Values(
        BadChange{"", "priorities="}, BadChange{"speed", "speed="},
        BadChange{"colour=red", "lost="}, BadChange{"without=4", "1, 2, 3"},
        BadChange{"without=", "1, 2, 3"}, BadChange{"without=257", "1, 2, 3"},
        BadChange{"priorities=1,1", "twice"}, BadChange{"priorities=1,,2", "1, 2, 3"},
        BadChange{"coordination=none", "cooperative"}, BadChange{"speed=1", "m/s"},
        BadChange{"speed=1:0", "above 0"}, BadChange{"speed=1:nan", "above 0"},
        BadChange{"criteria=J2", "VEHICLE:CRITERION"}, BadChange{"lost=1", "VEHICLE>VEHICLE"},
        BadChange{"lost=1>1", "two vehicles"}, BadChange{"criteria=1:", "CRITERION"},
        BadChange{"lost=1>2:0", "1 ..."}, BadChange{"lost=1>2:3:4", "1 ..."},
        BadChange{"route=1", "VEHICLE:ROUTE"}, BadChange{"route=1:ring", "blue, green, red"},
        BadChange{"route=9:red", "1, 2, 3"}, BadChange{"obstacle=1,2,0.3", "WIDTH"},
        BadChange{"obstacle=1,2,0.3,0.1,0,0", "WIDTH"}, BadChange{"obstacle=1,2,0.3,0", "above 0"},
        BadChange{"obstacle=1,nan,0.3,0.1", "at most 1000"},
        BadChange{"obstacle=1,2,0.3,1e9", "at most 1000"},
        BadChange{"obstacle=1,2,x,0.1", "at most 1000"}, BadChange{"lost=1>2\n:3", "1, 2, 3"}));

TEST(Fork, OneThatCannotBeDrivenIsRefused) {
  const auto refusal = [](const std::vector<Fork>& forks) -> std::string {
    try {
      check_forks(forks, three_cars(), kSteps);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  const Fork::Change without_two = Fork::Without{{2}};
  EXPECT_EQ(refusal({{.from = 1, .changes = {without_two}}}), "");
  EXPECT_THAT(refusal({{.from = 0, .changes = {without_two}}}), testing::HasSubstr("at least 1"));
  EXPECT_THAT(refusal({{.from = kSteps, .changes = {}}}), testing::HasSubstr("60 steps"));
  EXPECT_THAT(
      refusal({{.from = 1, .changes = {without_two}}, {.from = 3, .changes = {without_two}}}),
      testing::HasSubstr("still there"));
  EXPECT_THAT(
      refusal({{.from = 1, .changes = {without_two, Fork::Without{{1}}, Fork::Without{{3}}}}}),
      testing::HasSubstr("at least one"));
  scenario::Scenario two_rounds = three_cars();
  two_rounds.rounds = controller::Rounds::kTwo;
  const std::vector<Fork> agreed{
      {.from = 1, .changes = {Fork::Coordination{controller::kAgreedCoordination}}}};
  EXPECT_THROW(check_forks(agreed, two_rounds, kSteps), std::invalid_argument);
  EXPECT_NO_THROW(check_forks(agreed, three_cars(), kSteps));
}

TEST(Fork, ManeuversThatTheAutomatonLacksAreRefusedBeforeTheRunBegins) {
  EXPECT_THROW(static_cast<void>(with(5, {Fork::Labels{.vehicle = {1}, .labels = {"J9"}}})),
               std::invalid_argument);
}

}  // namespace
}  // namespace hlc::closed_loop::fork_test
