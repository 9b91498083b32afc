#include "vehicle_sim/campaign/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/campaign/paper_comparison.hpp"
#include "vehicle_sim/campaign/sweep_csv.hpp"
#include "vehicle_sim/campaign/sweep_report.hpp"
#include "vehicle_sim/campaign/sweep_tables.hpp"
#include "vehicle_sim/campaign/trims_front.hpp"

namespace hlc::campaign::sweep_test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml";

Sweep built_sweep(const std::string& rest) {
  const test::TemporaryFolder folder;
  test::put(folder / "sweep.yaml", "scenarios: [" + kScenario + "]\n" + rest);
  Sweep sweep(read_sweep(folder / "sweep.yaml"));
  for (std::size_t i = 0; i < sweep.num_automata(); ++i) sweep.build(i);
  return sweep;
}

std::vector<RunFigures> driven(const Sweep& sweep) {
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < sweep.runs().size(); ++i) runs.push_back(sweep.drive(i).figures);
  return runs;
}

/// With the paper's lab figures of D.
RunFigures papers_run(RunFigures run) {
  run.error_mean_mm = 17.0;
  run.error_std_mm = 16.1;
  run.generated_max = 291.0;
  run.lap_s = 16.0;
  return run;
}

TEST(Sweep, TwoScenariosOfOneNameAreRefused) {
  const test::TemporaryFolder folder;
  std::ifstream stream(kScenario);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;) {
    text.replace(at, 3, test::source_folder() + "/launch_scripts/");
  }
  test::put(folder / "copy.yaml", text);
  test::put(folder / "sweep.yaml", "scenarios: [" + kScenario + ", copy.yaml]\nsubgraphs: [B]\n" +
                                       "settings: {lap: [standing]}");
  try {
    const Sweep sweep(read_sweep(folder / "sweep.yaml"));
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("name = paper_red_alone as in"));
  }
}

TEST(Sweep, OfTheFilesOwnSettingsDrivesAsThePlainCampaign) {
  const Sweep sweep = built_sweep(
      "subgraphs: [B, D]\nstarts: 2\nsteps: 30\nsettings: {profile: ['2022'], drivable: [lanes], "
      "reference_rule: ['2022'], search: ['2022'], reference_speed_mps: [0.8], wheelbase_m: "
      "[0.15], acceleration_mps2: [12], steering_rate_radps: [6.2], width_m: [0.107], "
      "safety_margin_m: [0.01], lap: [standing]}");
  const Campaign campaign({.scenarios = {kScenario},
                           .profiles = {"2022"},
                           .subgraphs = {"B", "D"},
                           .starts = 2,
                           .steps = 30});
  ASSERT_EQ(sweep.runs().size(), campaign.runs().size());
  for (std::size_t i = 0; i < sweep.runs().size(); ++i) {
    const SweepResult one = sweep.drive(i);
    const result::RunSummary other = campaign.result_of(campaign.drive(i, {})).summary;
    EXPECT_EQ(one.figures.failure, "");
    EXPECT_EQ(one.trace_sha256, other.trace_sha256);
    EXPECT_EQ(one.figures.error_mean_mm, 1e3 * other.vehicles[0].reference_error_m->mean);
    EXPECT_EQ(one.figures.generated_max, other.vehicles[0].generated->max);
  }
}

TEST(Sweep, EverySettingReachesTheScenario) {
  const Sweep sweep = built_sweep(
      "subgraphs: [B]\nsteps: 30\nsettings: {profile: [default], coordination: [strict], drivable: "
      "[everywhere], "
      "reference_rule: ['2022'], search: ['2022'], reference_speed_mps: [0.7], contouring_weight: "
      "[50], wheelbase_m: "
      "[0.2], acceleration_mps2: [14], steering_rate_radps: [8], width_m: [0.1], "
      "safety_margin_m: [0.02], trims: [[2, 7, 12]]}");
  ASSERT_EQ(sweep.runs().size(), 1U);
  const scenario::Scenario scenario = sweep.scenario_of(0);
  EXPECT_EQ(scenario.steps, 30U);
  EXPECT_EQ(scenario.reference_speed_mps, 0.7);
  EXPECT_EQ(scenario.contouring_weight, 50.0);
  EXPECT_EQ(scenario.profile.reference_rule, road::half_speed_last);
  EXPECT_EQ(scenario.profile.strategies.coordination, controller::kStrictCoordination);
  EXPECT_EQ(scenario.profile.strategies.incumbent, &controller::no_incumbent);
  EXPECT_EQ(scenario.search.engine, search::Engine::kBestFirst);
  EXPECT_EQ(scenario.search.cost_to_go, search::CostToGo::kReferenceSpeed);
  EXPECT_TRUE(scenario.vehicles[0].corridor.pieces().empty());
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  EXPECT_EQ(automaton.limits.acceleration_mps2, 14.0);
  EXPECT_EQ(automaton.limits.steering_rate_radps, 8.0);
  EXPECT_EQ(automaton.vehicle.wheelbase_m, 0.2);
  EXPECT_DOUBLE_EQ(automaton.vehicle.rear_axle_to_cg_m, 0.1);
  EXPECT_EQ(automaton.vehicle.footprint.width_m, 0.1);
  EXPECT_EQ(automaton.vehicle.safety_margin_m, 0.02);
  EXPECT_EQ(scenario.subgraph->spec().trims,
            (std::vector<TrimId>{TrimId{0}, TrimId{1}, TrimId{6}, TrimId{11}}));
}

TEST(Sweep, AutomataAreDesignedOncePerDifferentOne) {
  const Sweep sweep = built_sweep(
      "subgraphs: [B]\nsettings: {acceleration_mps2: [12, 14], drivable: [lanes, everywhere], "
      "lap: [standing, flying]}");
  EXPECT_EQ(sweep.combinations().size(), 8U);
  EXPECT_EQ(sweep.num_automata(), 2U);
}

TEST(Sweep, WhatCannotBeDrivenFailsWithItsReasonAndStopsNobody) {
  // 0.6 rad in 0.2 s need 3 rad/s.
  const Sweep sweep =
      built_sweep("subgraphs: [B]\nsteps: 20\nsettings: {steering_rate_radps: [2, 6.2]}");
  const std::vector<RunFigures> runs = driven(sweep);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_THAT(runs[0].failure, HasSubstr("maneuver 1 -> 2 (J2)"));
  EXPECT_FALSE(runs[0].error_mean_mm);
  EXPECT_EQ(runs[1].failure, "");
  EXPECT_TRUE(runs[1].error_mean_mm);
  const std::string markdown = sweep_markdown(sweep, runs, {});
  EXPECT_THAT(markdown, HasSubstr("Runs that do not count: 1"));
  EXPECT_THAT(markdown, HasSubstr("* 1 times subgraph B: "));
}

TEST(Sweep, FlyingLapLeavesTheStartOut) {
  const Sweep sweep =
      built_sweep("subgraphs: [B]\nsteps: 120\nsettings: {lap: [standing, flying]}");
  const DrivenRun run = drive_run(sweep.scenario_of(0), {});
  const result::RunSummary whole = result_of(run, std::nullopt).summary;
  const result::RunSummary flying = result_of(run, std::nullopt, kFlyingStep).summary;
  EXPECT_EQ(whole.vehicles[0].steps, 120U);
  EXPECT_EQ(flying.vehicles[0].steps, 120U - kFlyingStep);
  EXPECT_EQ(sweep.drive(0).trace_sha256, whole.trace_sha256);
  EXPECT_EQ(sweep.drive(1).trace_sha256, flying.trace_sha256);
  EXPECT_EQ(sweep.drive(1).figures.lap_s, flying.vehicles[0].lap_s);
  EXPECT_NE(flying.vehicles[0].lap_s, whole.vehicles[0].lap_s);
}

TEST(Sweep, FlyingLapIsNotFaultedForWhatWasBefore) {
  const Sweep sweep = built_sweep("subgraphs: [B]\nsteps: 30\nsettings: {lap: [flying]}");
  DrivenRun run = drive_run(sweep.scenario_of(0), {});
  // A second car where the first one is, for some ticks in mid-run.
  const Nanoseconds begin = run.experiment.facts.first_step.value() * run.experiment.facts.period;
  const auto touch = [&](std::uint64_t step) {
    DrivenRun touched = run;
    scenario::ScenarioVehicle other = run.scenario.vehicles.front();
    other.id = VehicleId{9};
    touched.scenario.vehicles.push_back(other);
    result::Drive far = run.experiment.drives.begin()->second;
    for (result::DrivenSample& sample : far) {
      if (sample.t / run.experiment.facts.period != begin / run.experiment.facts.period + step) {
        sample.pose.x_m += 50.0;
      }
    }
    touched.experiment.drives[9] = far;
    return touched;
  };
  EXPECT_EQ(result_of(touch(3), std::nullopt, kFlyingStep).fault, "");
  EXPECT_EQ(result_of(touch(3), std::nullopt).fault, "vehicles collided 1 times");
  EXPECT_EQ(result_of(touch(15), std::nullopt, kFlyingStep).fault, "vehicles collided 1 times");
}

TEST(SweepReport, CsvHasOneRowPerRunWithItsSettings) {
  const Sweep sweep =
      built_sweep("subgraphs: [B, D]\nsettings: {drivable: [lanes, everywhere], width_m: [0.1]}");
  std::vector<RunFigures> runs(4);
  for (std::size_t i = 0; i < 4; ++i) runs[i] = sweep.heading_of(i);
  runs[0].lap_s = 15.5;
  runs[0].error_mean_mm = 20.0;
  runs[3].failure = "one, two";
  const std::string csv = sweep_csv(sweep, runs);
  EXPECT_THAT(csv, HasSubstr("run,combination,scenario,subgraph,start,drivable,width_m,lap_s,"));
  EXPECT_THAT(csv, HasSubstr("\n0,0,paper_red_alone,B,0,lanes,0.1,15.5000,20.0000,"));
  EXPECT_THAT(csv, HasSubstr("\n3,1,paper_red_alone,D,0,everywhere,0.1,,,,"));
  EXPECT_THAT(csv, HasSubstr(",one; two\n"));
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
}

TEST(SweepReport, ChoosesTheNearestByHalfOfTheStartsAndTellsItsDistanceByTheOthers) {
  const Sweep sweep =
      built_sweep("subgraphs: [D]\nstarts: 4\nsettings: {width_m: [0.09, 0.1, 0.11]}");
  // The second is the paper's over the starts that choose, and off by a factor 2 over the others.
  const std::vector<double> laps_s{20, 20, 20, 20, 16, 16, 32, 32, 17, 17, 17.01, 16.99};
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < laps_s.size(); ++i) {
    RunFigures run = papers_run(sweep.heading_of(i));
    run.lap_s = laps_s[i];
    runs.push_back(run);
  }
  const std::vector<JudgedCombination> judged = judged_combinations(sweep, runs);
  ASSERT_EQ(judged.size(), 3U);
  EXPECT_EQ(judged[0].combination, 1U);
  EXPECT_EQ(judged[0].choosing.mean_square, 0.0);
  EXPECT_NEAR(judged[0].held_out->mean_square, std::pow(std::log(2.0), 2) / 4.0, 1e-12);
  EXPECT_EQ(judged[1].combination, 2U);
  for (const JudgedCombination& one : judged) EXPECT_TRUE(one.may_be_as_near);
  const std::string text = sweep_markdown(sweep, runs, {.command = "evaluate"});
  EXPECT_THAT(text, HasSubstr("off by a factor of 1.414 over the held-out starts"));
  EXPECT_THAT(text, HasSubstr("| 1 | 0.1 | 1.000 | 0 of 4 | 1.414 | 0 |"));
  EXPECT_THAT(text, HasSubstr("| width_m | 0.09 | 1 | 1.118 | 1.118 | 1.118 | 1 |"));
  EXPECT_THAT(text, HasSubstr("| paper_red_alone | D | lap_s | 16.0 | 16.0 | 32.0 | 2.00 |"));
}

TEST(SweepReport, WhatIsFartherInEveryHeldOutStartIsNotAsNear) {
  const Sweep sweep = built_sweep("subgraphs: [D]\nstarts: 4\nsettings: {width_m: [0.1, 0.11]}");
  const std::vector<double> laps_s{16, 16, 16.1, 16.2, 20, 20, 20, 20.1};
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < laps_s.size(); ++i) {
    RunFigures run = papers_run(sweep.heading_of(i));
    run.lap_s = laps_s[i];
    runs.push_back(run);
  }
  const std::vector<JudgedCombination> judged = judged_combinations(sweep, runs);
  EXPECT_TRUE(judged[0].may_be_as_near);
  EXPECT_FALSE(judged[1].may_be_as_near);
  // exp of the mean of ln(1.25) / 2, the same, and what is held out: 0.10986 +- 0.00317.
  EXPECT_THAT(sweep_markdown(sweep, runs, {}),
              HasSubstr("| width_m | 0.11 | 0.1 |  | 1.116 [1.113 … 1.120] |"));
}

TEST(SweepReport, WithOneStartNothingIsHeldOut) {
  const Sweep sweep = built_sweep("subgraphs: [D]\nsettings: {width_m: [0.1]}");
  const std::string text = sweep_markdown(sweep, {papers_run(sweep.heading_of(0))}, {});
  EXPECT_THAT(text, HasSubstr("with a single start nothing is held out"));
  EXPECT_THAT(text, HasSubstr("off by a factor of - over the held-out starts"));
}

/// Errors of C and of D, two starts each, for lanes and everywhere, each with 0.1 and 0.11 m.
std::vector<RunFigures> runs_with_errors(const Sweep& sweep, const std::vector<double>& errors_mm) {
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    RunFigures run = sweep.heading_of(i);
    run.error_mean_mm = errors_mm[i];
    run.driven_error_mean_mm = errors_mm[i] + 1.0;
    run.lap_s = 16.0;
    runs.push_back(run);
  }
  return runs;
}

const char* const kLanesAndWidths =
    "subgraphs: [C, D]\nstarts: 2\nsettings: {drivable: [lanes, everywhere], width_m: [0.1, "
    "0.11]}\ntables: [[width_m, drivable]]";

TEST(SweepReport, SaysWhichSubgraphIsMoreAccurateAndWhen) {
  const Sweep sweep = built_sweep(kLanesAndWidths);
  std::vector<RunFigures> runs = runs_with_errors(sweep, {20, 22, 19, 19,  // lanes, 0.1: 19 / 21
                                                          20, 22, 21, 21,  // lanes, 0.11: equal
                                                          20, 20, 30, 30,  // everywhere, 0.1
                                                          20, 20, 5, 5});  // everywhere, 0.11
  runs[15].lap_s.reset();
  const std::string text = sweep_markdown(sweep, runs, {});
  EXPECT_THAT(text, HasSubstr("| setting | value | D against C |\n|---|---|---|\n"));
  // Starts 0: -1, 1, 10, -15; starts 1: -3, -1, 10.
  EXPECT_THAT(text, HasSubstr("| all |  | 1 of 3, 1.00; 0.38 ± 20.65 mm |"));
  EXPECT_THAT(text, HasSubstr("| drivable | lanes | 1 of 2, 0.95; -1.00 ± 12.71 mm |"));
  EXPECT_THAT(text, HasSubstr("| drivable | everywhere | 0 of 1, 1.50; "));
  EXPECT_THAT(text, HasSubstr("| width_m, drivable | 0.1, lanes | 1 of 1, 0.90; -2.00 ± 12.71 mm"));
}

TEST(SweepReport, SaysWhatASettingDoesPairByPair) {
  const Sweep sweep = built_sweep(kLanesAndWidths);
  // 0.11 m adds 1 and 3 mm to C's error, whatever the lanes, and nothing to D's.
  std::vector<RunFigures> runs =
      runs_with_errors(sweep, {20, 40, 9, 9, 21, 43, 9, 9, 30, 10, 9, 9, 31, 13, 9, 9});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (sweep.combinations()[sweep.runs()[i].combination][1] == 1) *runs[i].lap_s += 0.5;
  }
  runs[14].lap_s.reset();  // everywhere, 0.11 m, D, start 0
  const std::string text = sweep_markdown(sweep, runs, {});
  // Means of the starts 1 and 3: 2 +- 12.7062.
  EXPECT_THAT(
      text, HasSubstr("| width_m | 0.11 | 0.1 |  | paper_red_alone, C | 4 | 4, 4 | 2.00 ± 12.71 | "
                      "0.500 ± 0.000 | 0 ± 0 |\n"));
  EXPECT_THAT(
      text,
      HasSubstr("| width_m | 0.11 | 0.1 |  | paper_red_alone, D | 4 | 3, 4 | 0.00 ± 0.00 | "));
  // The table of width_m and drivable: pairs of the last, for each value of the first.
  EXPECT_THAT(text,
              HasSubstr("| drivable | everywhere | lanes | 0.1 | paper_red_alone, C | 2 | 2, 2 | "
                        "-10.00 ± 254.12 |"));
  EXPECT_THAT(text, HasSubstr("| setting | value | against | with | factor, ratio |"));
}

TEST(SweepReport, PairsThatASampleDoesNotHoldAreLeftOut) {
  const Sweep sweep = built_sweep(
      "subgraphs: [C]\nruns: 3\nsettings: {drivable: [lanes, everywhere], width_m: [0.1, 0.11]}");
  ASSERT_EQ(sweep.combinations().size(), 3U);
  const std::string text = sweep_markdown(sweep, runs_with_errors(sweep, {10, 10, 10}), {});
  EXPECT_THAT(
      text,
      HasSubstr("| drivable | everywhere | lanes |  | paper_red_alone, C | 1 | 1, 1 | 0.00 |"));
  EXPECT_THAT(text,
              HasSubstr("| width_m | 0.11 | 0.1 |  | paper_red_alone, C | 1 | 1, 1 | 0.00 |"));
}

TEST(SweepTables, GroupResultsBySettingsAloneAndTogether) {
  const Sweep sweep = built_sweep(kLanesAndWidths);
  std::vector<RunFigures> runs =
      runs_with_errors(sweep, {20, 22, 9, 9, 30, 32, 9, 9, 40, 42, 9, 9, 50, 52, 9, 9});
  runs[1].lap_s.reset();
  const std::string text = sweep_tables_markdown(sweep, runs);
  EXPECT_THAT(text, HasSubstr("### paper_red_alone, by all\n\n| subgraph | combinations | laps |"));
  // Starts: 35 of four combinations, 42 of three.
  EXPECT_THAT(text, HasSubstr("| C | 4 | 7 of 8 | 38.5 ± 44.5 | 39.5 ± 44.5 | 16.00 ± 0.00 |"));
  EXPECT_THAT(text, HasSubstr("| lanes | C | 2 | 3 of 4 | 28.5 ± 44.5 |"));
  EXPECT_THAT(text, HasSubstr("by width_m, drivable\n\n| width_m | drivable | subgraph |"));
  EXPECT_THAT(text, HasSubstr("| 0.1 | lanes | C | 1 | 1 of 2 | 20.0 | 21.0 | 16.00 |"));
  const std::string csv = sweep_tables_csv(sweep, runs);
  EXPECT_THAT(csv, HasSubstr("\npaper_red_alone,width_m; drivable,0.11; everywhere,C,1,2,2,"
                             "error_mean_mm,51.000000,12.7062"));
  EXPECT_THAT(csv, HasSubstr("\npaper_red_alone,all,,C,4,8,7,lap_s,16.000000,0.000000\n"));
}

TEST(SweepReport, NamesAReasonOnceWithTheRangeOfItsNumbers) {
  const Sweep sweep = built_sweep("subgraphs: [A]\nstarts: 4\nsettings: {width_m: [0.1]}");
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < 4; ++i) runs.push_back(sweep.heading_of(i));
  runs[0].failure = "vehicle 1 was away in 12 steps by 0.5 mm";
  runs[1].failure = "vehicle 1 was away in 7 steps by 1.25 mm";
  runs[2].failure = "vehicle 1 was away in 104 steps by 0.5 mm";
  runs[3].failure = "something else";
  const std::string text = sweep_markdown(sweep, runs, {});
  EXPECT_THAT(text, HasSubstr("Runs that do not count: 4\n"));
  EXPECT_THAT(text, HasSubstr("* 3 times subgraph A: vehicle 1 was away in 7 … 104 steps by 0.5 … "
                              "1.25 mm\n* 1 times subgraph A: something else\n"));
}

TEST(TrimsFront, HoldsWhatNothingBeats) {
  const std::vector<TrimsQuality> choices{{0, 3, 30.0, 16.0, 100.0},
                                          {1, 3, 40.0, 16.0, 100.0},
                                          {2, 5, 30.0, 16.0, 100.0},
                                          {3, 5, 20.0, 16.0, 100.0},
                                          {4, 11, 25.0, 16.0, 100.0}};
  const std::vector<TrimsQuality> front = trims_front(choices);
  ASSERT_EQ(front.size(), 2U);
  EXPECT_EQ(front[0].combination, 0U);
  EXPECT_EQ(front[1].combination, 3U);
}

TEST(TrimsFront, NamesTheSmallestChoiceWithoutLossAndThePlaceOfD) {
  const Sweep sweep = built_sweep(
      "subgraphs: [C]\nsettings: {trims: [[2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12], [2, 4, 6, 7, 8, "
      "10, 12], [2, 7, 12], [7]]}");
  std::vector<RunFigures> runs;
  const std::vector<double> errors_mm{20.0, 19.0, 30.0, 5.0};
  for (std::size_t i = 0; i < 4; ++i) {
    RunFigures run = sweep.heading_of(i);
    run.error_mean_mm = errors_mm[i];
    if (i != 3) run.lap_s = 16.0;  // straight on only: no lap
    runs.push_back(run);
  }
  const std::string text = sweep_markdown(sweep, runs, {});
  EXPECT_THAT(text, HasSubstr("3 of 4 choices drive a lap"));
  EXPECT_THAT(text, HasSubstr("| 7 | 1 2 4 6 7 8 10 12 | 19.00 | 16.00 | 0 | smallest, not less"));
  EXPECT_THAT(text, HasSubstr("trims of D: on the front; number 1 of 1"));
  EXPECT_THAT(text, HasSubstr("trims of B: 1 choices dominate it"));
  EXPECT_THAT(text, Not(HasSubstr("| 5.00 |")));
}

}  // namespace
}  // namespace hlc::campaign::sweep_test
