#include "vehicle_sim/closed_loop/fault_campaign.hpp"

#include <gtest/gtest.h>

#include "planner/coordination/priorities/strategies.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::closed_loop {
namespace {

const FaultCampaign& campaign() {
  static const FaultCampaign campaign(
      {.scenario_folder = test::source_folder() + "/launch_scripts/scenarios",
       .cars = 3,
       .kinds = fault_kinds_of({})});
  return campaign;
}

std::string text_of(const FaultCase& the_case, const FaultRunResult& result) {
  std::string text = describe(the_case);
  for (const Violation& violation : result.violations) {
    text += violation.check + ": " + violation.text + "\n";
  }
  return text;
}

TEST(FaultCampaign, NothingIsViolatedInRunsWithFaultsOfAllKinds) {
  FaultTotals totals;
  for (std::uint64_t seed = 1; seed <= 60 / test::kThinning; ++seed) {
    const FaultCase the_case = campaign().draw(seed);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
  }
  // The cars drive, and they meet.
  EXPECT_GT(totals.planned, totals.car_steps / 2) << describe(totals);
  EXPECT_LT(totals.smallest_distance_m, 0.1) << describe(totals);
}

TEST(FaultCampaign, NothingIsViolatedAmongCarsWithRightOfWay) {
  const std::string folder = test::source_folder() + "/launch_scripts/scenarios";
  const FaultCampaign on_lab_network({.scenario_folder = folder,
                                      .scenario = folder + "/lab_cars.yaml",
                                      .cars = 6,
                                      .kinds = fault_kinds_of({})});
  FaultTotals totals;
  for (std::uint64_t seed = 1; seed <= 6 / test::kThinning; ++seed) {
    const FaultCase the_case = on_lab_network.draw(seed);
    EXPECT_EQ(the_case.scenario.vehicles.size(), 6U);
    EXPECT_NE(the_case.scenario.conflicts, nullptr);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
  }
  EXPECT_GT(totals.planned, totals.car_steps / 2) << describe(totals);
}

// Steps, horizons, copies of a command and cars of another kind than the lab's.
TEST(FaultCampaign, NothingIsViolatedAmongPassengerCars) {
  const std::string folder = test::source_folder() + "/launch_scripts/scenarios";
  const FaultCampaign in_town({.scenario_folder = folder,
                               .scenario = folder + "/passenger_cars_in_town.yaml",
                               .cars = 3,
                               .kinds = fault_kinds_of({})});
  FaultTotals totals;
  for (std::uint64_t seed = 1; seed <= 6 / test::kThinning; ++seed) {
    const FaultCase the_case = in_town.draw(seed);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
  }
  EXPECT_GT(totals.planned, totals.car_steps / 2) << describe(totals);
}

TEST(FaultCampaign, NothingIsViolatedAmongObstacles) {
  const scenario::Scenario field = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/obstacle_field.yaml", .cars = 3});
  FaultTotals totals;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    FaultCase the_case = campaign().draw(seed);
    the_case.scenario = field;
    the_case.run.lab.prepared = scenario::prepare_subgraph_of(field);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
  }
  EXPECT_GT(totals.planned, totals.car_steps / 2) << describe(totals);
}

TEST(FaultCampaign, NothingIsViolatedInTwoRounds) {
  const FaultCampaign in_two_rounds(
      {.scenario_folder = test::source_folder() + "/launch_scripts/scenarios",
       .cars = 3,
       .kinds = fault_kinds_of({}),
       .has_two_rounds = true});
  FaultTotals totals;
  FaultTotals sequential;
  for (std::uint64_t seed = 1; seed <= 30 / test::kThinning; ++seed) {
    const FaultCase the_case = in_two_rounds.draw(seed);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
    sequential.add(FaultCampaign::run(campaign().draw(seed)));
  }
  EXPECT_LT(totals.smallest_distance_m, 0.1) << describe(totals);
  // Losses cost no more plans than in the sequential way, but for a hundredth.
  EXPECT_GT(totals.planned, sequential.planned - sequential.planned / 100)
      << describe(totals) << "\n"
      << describe(sequential);
}

class FaultCampaignWith : public testing::TestWithParam<const coordination::PriorityStrategy*> {};

// Where messages are lost, controllers order the vehicles differently: each may believe that it is
// the other's turn, or that it is its own.
TEST_P(FaultCampaignWith, PrioritiesThatChangeViolatesNothing) {
  const FaultCampaign with({.scenario_folder = test::source_folder() + "/launch_scripts/scenarios",
                            .cars = 4,
                            .kinds = fault_kinds_of({}),
                            .priorities = GetParam()});
  FaultTotals totals;
  for (std::uint64_t seed = 1; seed <= 8 / test::kThinning; ++seed) {
    const FaultCase the_case = with.draw(seed);
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    totals.add(result);
  }
  EXPECT_GT(totals.planned, totals.car_steps / 2) << describe(totals);
}

INSTANTIATE_TEST_SUITE_P(Strategies, FaultCampaignWith,
                         testing::Values(&coordination::kRandomPriorities,
                                         &coordination::kMostCollisionsFirst,
                                         &coordination::kWaitingTimePriorities,
                                         &coordination::kBestOrder),
                         [](const auto& tested) { return std::string(tested.param->name); });

TEST(FaultCampaign, WithoutFaultsEverybodyPlansInEveryStep) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FaultCase the_case = campaign().draw(seed, {});
    const FaultRunResult result = FaultCampaign::run(the_case);
    EXPECT_TRUE(result.violations.empty()) << text_of(the_case, result);
    EXPECT_GT(result.planned, 0U) << text_of(the_case, result);
  }
}

TEST(FaultCampaign, TheSameSeedGivesTheSameHashAndAnotherSeedAnother) {
  for (std::uint64_t seed = 1; seed <= 8 / test::kThinning; ++seed) {
    const FaultRunResult first = FaultCampaign::run(campaign().draw(seed));
    const FaultRunResult again = FaultCampaign::run(campaign().draw(seed));
    EXPECT_EQ(first.hash, again.hash) << seed;
    EXPECT_NE(first.hash, FaultCampaign::run(campaign().draw(seed + 1)).hash) << seed;
  }
}

TEST(FaultCampaign, LookingOnChangesNothing) {
  std::size_t lines = 0;
  const FaultCase the_case = campaign().draw(4);
  const FaultRunResult seen =
      FaultCampaign::run(the_case, [&](Nanoseconds, const std::string&) { ++lines; });
  EXPECT_GT(lines, 100U);
  EXPECT_EQ(seen.hash, FaultCampaign::run(the_case).hash);
}

TEST(FaultCampaign, AFaultThatIsNotThereCannotBeKept) {
  EXPECT_THROW(static_cast<void>(campaign().draw(1, {1000})), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::closed_loop
