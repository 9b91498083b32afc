#include "vehicle_sim/campaign/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/campaign/sweep_report.hpp"
#include "vehicle_sim/campaign/trims_front.hpp"

namespace hlc {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kScenario = HLC_SOURCE_DIR "/launch_scripts/scenarios/paper_red_alone.yaml";

Sweep built_sweep(const std::string& rest) {
  const TemporaryFolder folder;
  put(folder / "sweep.yaml", "scenarios: [" + kScenario + "]\n" + rest);
  Sweep sweep(read_sweep(folder / "sweep.yaml"));
  for (std::size_t i = 0; i < sweep.num_automata(); ++i) sweep.build(i);
  return sweep;
}

std::vector<RunFigures> driven(const Sweep& sweep) {
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < sweep.runs().size(); ++i) runs.push_back(sweep.drive(i).figures);
  return runs;
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
    const RunSummary other = campaign.result_of(campaign.drive(i, {})).summary;
    EXPECT_EQ(one.figures.failure, "");
    EXPECT_EQ(one.trace_sha256, other.trace_sha256);
    EXPECT_EQ(one.figures.error_mean_mm, 1e3 * other.vehicles[0].reference_error_m->mean);
    EXPECT_EQ(one.figures.generated_max, other.vehicles[0].generated->max);
  }
}

TEST(Sweep, EverySettingReachesTheScenario) {
  const Sweep sweep = built_sweep(
      "subgraphs: [B]\nsteps: 30\nsettings: {profile: [default], drivable: [everywhere], "
      "reference_rule: ['2022'], search: ['2022'], reference_speed_mps: [0.7], wheelbase_m: "
      "[0.2], acceleration_mps2: [14], steering_rate_radps: [8], width_m: [0.1], "
      "safety_margin_m: [0.02], trims: [[2, 7, 12]]}");
  ASSERT_EQ(sweep.runs().size(), 1U);
  const Scenario scenario = sweep.scenario_of(0);
  EXPECT_EQ(scenario.steps, 30U);
  EXPECT_EQ(scenario.reference_speed_mps, 0.7);
  EXPECT_EQ(scenario.profile.reference_rule, ReferenceRule::k2022);
  EXPECT_EQ(scenario.profile.settle_rule, SettleRule::kStrict);
  EXPECT_EQ(scenario.search.engine, Engine::kBestFirst);
  EXPECT_EQ(scenario.search.cost_to_go, CostToGo::k2022);
  EXPECT_TRUE(scenario.vehicles[0].corridor.pieces().empty());
  const UniversalAutomaton& automaton = scenario.subgraph->automaton();
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
  const RunSummary whole = result_of(run, std::nullopt).summary;
  const RunSummary flying = result_of(run, std::nullopt, kFlyingStep).summary;
  EXPECT_EQ(whole.vehicles[0].steps, 120U);
  EXPECT_EQ(flying.vehicles[0].steps, 120U - kFlyingStep);
  EXPECT_EQ(sweep.drive(0).trace_sha256, whole.trace_sha256);
  EXPECT_EQ(sweep.drive(1).trace_sha256, flying.trace_sha256);
  EXPECT_EQ(sweep.drive(1).figures.lap_s, flying.vehicles[0].lap_s);
  EXPECT_NE(flying.vehicles[0].lap_s, whole.vehicles[0].lap_s);
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

TEST(SweepReport, SaysWhichSettingsAreNearestToThePaper) {
  const Sweep sweep =
      built_sweep("subgraphs: [D]\nstarts: 2\nsettings: {width_m: [0.09, 0.1, 0.11]}");
  std::vector<RunFigures> runs;
  const std::vector<double> laps_s{32.0, 32.0, 15.0, 17.0, 16.5, 16.5};
  for (std::size_t i = 0; i < 6; ++i) {
    RunFigures run = sweep.heading_of(i);
    run.error_mean_mm = 17.0;
    run.error_std_mm = 16.1;
    run.generated_max = 291.0;
    run.lap_s = laps_s[i];
    runs.push_back(run);
  }
  const std::string text = sweep_markdown(sweep, runs, {.command = "evaluate"});
  // ln(15/16)^2 / 4 = 0.0010, ln(17/16)^2 / 4 = 0.0009.
  EXPECT_THAT(text, HasSubstr("| 1 | 0.1 | 0.0000 | 0.0009 … 0.0010 | 1.000 | 0 of 4 |"));
  EXPECT_THAT(text, HasSubstr("| 2 | 0.11 | 0.0002 |"));
  EXPECT_THAT(text, HasSubstr("2 of 3 combinations are as good as the best"));
  EXPECT_THAT(text, HasSubstr("| width_m | 0.09 | 1 | 1.414 | 1.414 | 0 |"));
  EXPECT_THAT(text, HasSubstr("| paper_red_alone | D | lap_s | 16.0 | 16.0 | 1.00 |"));
}

TEST(SweepReport, SaysWhichSubgraphIsMoreAccurateAndWhen) {
  const Sweep sweep = built_sweep(
      "subgraphs: [C, D]\nstarts: 2\nsettings: {drivable: [lanes, everywhere], width_m: [0.1, "
      "0.11]}");
  // By combination: the errors of C and of D, each from two starts.
  const std::vector<double> errors_mm{20, 22, 19, 19,  // lanes, 0.1: 19 / 21
                                      20, 22, 21, 21,  // lanes, 0.11: equal
                                      20, 20, 30, 30,  // everywhere, 0.1: 30 / 20
                                      20, 20, 5,  5};  // everywhere, 0.11: D without lap
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    RunFigures run = sweep.heading_of(i);
    run.error_mean_mm = errors_mm[i];
    if (i != 15) run.lap_s = 16.0;
    runs.push_back(run);
  }
  const std::string text = sweep_markdown(sweep, runs, {});
  EXPECT_THAT(text, HasSubstr("| setting | value | D against C |\n|---|---|---|\n"));
  EXPECT_THAT(text, HasSubstr("| all |  | 1 of 3, 1.00 |"));
  EXPECT_THAT(text, HasSubstr("| drivable | lanes | 1 of 2, 1.00 |"));
  EXPECT_THAT(text, HasSubstr("| drivable | everywhere | 0 of 1, 1.50 |"));
  EXPECT_THAT(text, HasSubstr("| width_m | 0.1 | 1 of 2, 1.50 |"));
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
  EXPECT_THAT(text, HasSubstr("trims of B: 1 choices beat it"));
  EXPECT_THAT(text, Not(HasSubstr("| 5.00 |")));
}

}  // namespace
}  // namespace hlc
