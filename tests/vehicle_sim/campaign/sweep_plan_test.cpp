#include "vehicle_sim/campaign/sweep_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign::sweep_plan_test {
namespace {

using testing::HasSubstr;

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

std::string file_with(const std::string& settings, const std::string& more = "") {
  return "scenarios: [" + kScenarios + "paper_red_alone.yaml]\nsubgraphs: [A, D]\n" + more +
         "settings: " + settings + "\n";
}

SweepPlan plan_of(const std::string& text) {
  const test::TemporaryFolder folder;
  test::put(folder / "sweep.yaml", text);
  return read_sweep(folder / "sweep.yaml");
}

TEST(SweepPlan, GridHoldsEveryCombinationOnceTheLastSettingChangingFirst) {
  const SweepPlan plan =
      plan_of(file_with("{width_m: [0.1, 0.11], lap: [standing, flying], drivable: [lanes]}"));
  EXPECT_EQ(plan.runs_each(), 2U);
  ASSERT_EQ(plan.axes.size(), 3U);  // drivable, width_m, lap: in the order of the settings
  EXPECT_EQ(plan.axes[1].setting, "width_m");
  EXPECT_EQ(combinations_of(plan),
            (std::vector<SweepCombination>{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}}));
}

TEST(SweepPlan, SampleIsTheSameTwiceAndAnotherWithAnotherSeed) {
  const std::string settings =
      "{width_m: [1, 2, 3, 4, 5, 6], wheelbase_m: [1, 2, 3, 4, 5, 6], lap: [standing, flying]}";
  const auto sample = [&](const std::string& seed) {
    return combinations_of(plan_of(file_with(settings, "runs: 21\nseed: " + seed + "\n")));
  };
  const std::vector<SweepCombination> first = sample("1");
  EXPECT_EQ(first.size(), 11U);  // two runs each: at least 21
  EXPECT_EQ(std::set(first.begin(), first.end()).size(), 11U);
  EXPECT_EQ(first, sample("1"));
  EXPECT_NE(first, sample("2"));
}

TEST(SweepPlan, SamplesOfManySeedsHoldEveryCombinationEquallyOften) {
  const std::string settings = "{width_m: [1, 2, 3, 4, 5]}";
  std::vector<int> counts(5);
  SweepPlan plan = plan_of(file_with(settings, "runs: 4\n"));
  constexpr int kSeeds = 2000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    plan.seed = static_cast<std::uint64_t>(seed);
    for (const SweepCombination& one : combinations_of(plan)) ++counts[one[0]];
  }
  // Each in 2 of 5: 800 on average, standard deviation 22.
  for (const int count : counts) EXPECT_NEAR(count, 800, 110);
}

TEST(SweepPlan, SampleLargerThanTheGridIsTheGrid) {
  EXPECT_EQ(combinations_of(plan_of(file_with("{width_m: [0.1, 0.11]}", "runs: 1000\n"))),
            (std::vector<SweepCombination>{{0}, {1}}));
}

TEST(SweepPlan, SubsetsAreAllChoicesOfMovingTrimsWithStandstill) {
  const SweepPlan plan = plan_of(file_with("{trims: subsets}"));
  ASSERT_EQ(plan.axes[0].values.size(), 2047U);
  std::set<std::vector<TrimId>> different;
  for (const SweepValue& value : plan.axes[0].values) {
    EXPECT_EQ(value.trims.front(), TrimId{0});
    EXPECT_GE(value.trims.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(value.trims));
    different.insert(value.trims);
  }
  EXPECT_EQ(different.size(), 2047U);
}

TEST(SweepPlan, TrimsOfTheFileAreSortedAndHaveStandstill) {
  const SweepPlan plan = plan_of(file_with("{trims: [[12, 2, 7]]}"));
  EXPECT_EQ(plan.axes[0].values[0].text, "1 2 7 12");
}

TEST(SweepPlan, TablesNameSettingsOfTheFile) {
  const SweepPlan plan = plan_of(file_with("{width_m: [0.1], lap: [flying], drivable: [lanes]}",
                                           "tables: [[lap, width_m]]\n"));
  // drivable, width_m, lap: in the order of the settings.
  EXPECT_EQ(plan.tables, (std::vector<std::vector<std::size_t>>{{2, 1}}));
}

TEST(SweepPlan, EveryShippedStudyCanBeDriven) {
  std::size_t studies = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(test::source_folder() + "/launch_scripts/sweeps")) {
    if (file.path().extension() != ".yaml") continue;
    SCOPED_TRACE(file.path());
    ++studies;
    SweepPlan plan;
    ASSERT_NO_THROW(plan = read_sweep(file.path()));
    EXPECT_NO_THROW(const Sweep sweep(plan));
  }
  EXPECT_GE(studies, 6U);
}

TEST(SweepPlan, ShippedStudyOfTheTableHasAtLeast10000RunsAndThatOfTrimsAllSubsets) {
  const std::string sweeps = test::source_folder() + "/launch_scripts/sweeps/";
  const SweepPlan table = read_sweep(sweeps + "table_2.yaml");
  EXPECT_GE(combinations_of(table).size() * table.runs_each(), 10000U);
  EXPECT_EQ(combinations_of(read_sweep(sweeps + "trims.yaml")).size(), 2047U);
}

struct Fault {
  std::string text;
  std::string message;  ///< part of it
};

TEST(SweepPlan, BadFilesAreRefusedInOneLineWithPlaceValueAndWhatIsAllowed) {
  const std::string good = "{width_m: [0.1]}";
  const std::vector<Fault> faults{
      {file_with("{colour: red}"), "sweep.yaml:3: settings.colour = red"},
      {file_with("{colour: red}"), "known keys: profile, coordination, priorities, reference_rule"},
      {file_with("{width_m: [wide]}"), "settings.width_m[1] = wide, must be a number"},
      {file_with("{width_m: [0.1, -1]}"), "settings.width_m[2] = -1, must be"},
      {file_with("{width_m: [0.1, 0.10]}"), "settings.width_m[2] = 0.10, must be unique"},
      {file_with("{width_m: []}"), "must be a list with at least one value"},
      {file_with("{width_m: 0.1}"), "settings.width_m = 0.1, must be a list"},
      {file_with("{search: [a_star]}"), "must be one of branch_and_bound, best_first, 2022"},
      {file_with("{trims: some}"), "settings.trims = some, must be subsets"},
      {file_with("{trims: [[2, 13]]}"), "settings.trims[1][2] = 13, must be"},
      {file_with("{trims: [[2, 2]]}"), "must be unique"},
      {file_with("{trims: [[1]]}"), "must be a list with a trim of speed > 0"},
      {file_with("{trims: [2]}"), "must be a list of trims' numbers"},
      {file_with("{}"), "must be a map with at least one setting"},
      {file_with(good, "runs: 0\n"), "runs = 0, must be"},
      {file_with(good, "starts: 0\n"), "starts = 0, must be"},
      {file_with(good, "steps: 10\n"), "steps = 10, must be a whole number >= 11"},
      {file_with(good, "jobs: 2\n"), "jobs = 2, unknown key"},
      {file_with(good, "tables: [width_m]\n"), "tables[1] = width_m, must be a list of settings"},
      {file_with(good, "tables: [[lap, width_m]]\n"), "tables[1][1] = lap, must be width_m"},
      {file_with(good, "tables: [[width_m]]\n"), "must be a list of at least two settings"},
      {file_with(good, "tables: [[width_m, width_m]]\n"), "must be unique"},
      {file_with("{trims: subsets, width_m: [1, 2, 3, 4, 5], wheelbase_m: [1, 2, 3, 4, 5]}",
                 "starts: 1000\n"),
       "must be a grid of <= 1e+07 runs"},
      {"scenarios: []\nsubgraphs: [A]\nsettings: " + good,
       "must be a list with at least one scenario"},
      {"scenarios: [x.yaml]\nsubgraphs: [A]\nsettings: " + good, "must be a scenario's file"},
      {"scenarios: [" + kScenarios + "paper_red_alone.yaml]\nsubgraphs: [E]\nsettings: " + good,
       "subgraphs[1] = E, must be one of A, B, C, D"},
      {"scenarios: [" + kScenarios + "paper_red_alone.yaml, " + kScenarios +
           "grid_red_alone.yaml]\nsubgraphs: [A]\nsettings: " + good,
       "must be a scenario on the same automaton"},
  };
  for (const Fault& fault : faults) {
    try {
      static_cast<void>(plan_of(fault.text));
      ADD_FAILURE() << "accepted: " << fault.text;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(fault.message)) << fault.text;
      EXPECT_THAT(error.what(), HasSubstr("sweep.yaml:")) << fault.text;
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n"))) << fault.text;
    }
  }
}

}  // namespace
}  // namespace hlc::campaign::sweep_plan_test
