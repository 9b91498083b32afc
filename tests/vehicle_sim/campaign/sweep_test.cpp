#include "vehicle_sim/campaign/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::campaign::sweep_test {
namespace {

using testing::HasSubstr;

const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml";

Sweep built_sweep(const std::string& rest, const std::string& scenario = kScenario) {
  const test::TemporaryFolder folder;
  test::put(folder / "sweep.yaml", "scenarios: [" + scenario + "]\n" + rest);
  Sweep sweep(read_sweep(folder / "sweep.yaml"));
  for (std::size_t i = 0; i < sweep.num_automata(); ++i) sweep.build(i);
  return sweep;
}

std::vector<RunFigures> driven(const Sweep& sweep) {
  std::vector<RunFigures> runs;
  for (std::size_t i = 0; i < sweep.runs().size(); ++i) runs.push_back(sweep.drive(i).figures);
  return runs;
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

TEST(Sweep, AContouringWeightIsAlsoThatOfHeldUpVehicles) {
  const std::string lab_guest = test::source_folder() + "/launch_scripts/scenarios/lab_guest.yaml";
  ASSERT_EQ(scenario::read_scenario({.file = lab_guest}).held_up_contouring_weight, 150.0);
  const Sweep sweep =
      built_sweep("subgraphs: [J2]\nsettings: {contouring_weight: [50]}", lab_guest);
  const scenario::Scenario scenario = sweep.scenario_of(0);
  EXPECT_EQ(scenario.contouring_weight, 50.0);
  EXPECT_EQ(scenario.held_up_contouring_weight, std::nullopt);
}

TEST(Sweep, EverySettingReachesTheScenario) {
  const Sweep sweep = built_sweep(
      "subgraphs: [B]\nsteps: 30\nsettings: {profile: [default], coordination: [strict], drivable: "
      "[everywhere], "
      "reference_rule: ['2022'], search: ['2022'], reference_speed_mps: [0.7], contouring_weight: "
      "[50], wheelbase_m: "
      "[0.2], acceleration_mps2: [14], steering_rate_radps: [8], speed_max_mps: [1.5], "
      "own_steps: [optimised], width_m: [0.1], "
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
  EXPECT_EQ(automaton.limits.speed_max_mps, 1.5);
  EXPECT_EQ(automaton.find(TrimId{1}, TrimId{1}, "J2")->label, "J2");
  EXPECT_EQ(automaton.vehicle.wheelbase_m, 0.2);
  EXPECT_DOUBLE_EQ(automaton.vehicle.rear_axle_to_cg_m, 0.1);
  EXPECT_EQ(automaton.vehicle.footprint.width_m, 0.1);
  EXPECT_EQ(automaton.vehicle.safety_margin_m, 0.02);
  EXPECT_EQ(scenario.subgraph->spec().trims,
            (std::vector<TrimId>{TrimId{0}, TrimId{1}, TrimId{6}, TrimId{11}}));
}

TEST(Sweep, ExactVehiclesAreWhereTheirPlansAre) {
  const Sweep sweep = built_sweep(
      "subgraphs: [A, B]\nstarts: 2\nsteps: 60\nsettings: {profile: ['2022'], vehicle: "
      "[identified, exact]}");
  ASSERT_EQ(sweep.runs().size(), 8U);
  for (std::size_t i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const RunFigures identified = sweep.drive(i).figures;
    const RunFigures exact = sweep.drive(i + 4).figures;
    EXPECT_EQ(exact.failure, "");
    EXPECT_EQ(exact.subgraph, identified.subgraph);
    EXPECT_NEAR(exact.deviation_max_mm, 0.0, 1e-6);
    EXPECT_NEAR(exact.driven_error_mean_mm.value(), exact.error_mean_mm.value(), 1e-6);
    EXPECT_GT(identified.deviation_max_mm, 0.1);
    if (exact.subgraph == "B") {  // the car follows its plans: none is made again from its pose
      EXPECT_DOUBLE_EQ(exact.error_mean_mm.value(), identified.error_mean_mm.value());
      EXPECT_EQ(exact.generated_max, identified.generated_max);
    }
  }
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

}  // namespace
}  // namespace hlc::campaign::sweep_test
