#include "vehicle_sim/campaign/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/plot/scenario_plot.hpp"
#include "tests/support/folders.hpp"

namespace hlc::campaign::figures_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<DrivenRun> runs_of(const std::string& scenario, std::vector<std::string> subgraphs,
                               std::vector<std::string> policies = {}) {
  const Campaign campaign(
      {.scenarios = {test::source_folder() + "/launch_scripts/scenarios/" + scenario + ".yaml"},
       .profiles = {"default"},
       .subgraphs = std::move(subgraphs),
       .policies = std::move(policies),
       .steps = 15});
  Nanoseconds now = 0;
  std::vector<DrivenRun> runs;
  for (std::size_t i = 0; i < campaign.runs().size(); ++i) {
    runs.push_back(campaign.drive(i, {.cpu = [&now] { return now += 50'000; }}));
  }
  return runs;
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t sum = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++sum;
  }
  return sum;
}

/// Numbers that no figure may hold.
void expect_finite(const std::string& svg) {
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Figures, PathsShowEverySubgraphAndTheLaneAndAPartEnlarged) {
  const std::vector<DrivenRun> runs = runs_of("paper_red_alone", {"B", "D"});
  const std::string svg = paths_figure(runs, plot::map_of(runs.front().scenario));
  for (const char* text : {"subgraph B", "subgraph D", "centre of the lane", "x [m]", "y [m]"}) {
    EXPECT_THAT(svg, HasSubstr(std::string(">") + text + "<"));
  }
  EXPECT_EQ(count(svg, "<clipPath"), 1U);
  EXPECT_EQ(count(svg, "stroke=\"#1f4fd8\" stroke-width=\"1.50\""), 2U);  // whole and enlarged
  EXPECT_GT(count(svg, "#f0f0f0"), 10U);
  expect_finite(svg);
  const std::string on_open_ground = paths_figure(runs, std::nullopt);
  EXPECT_THAT(on_open_ground, HasSubstr(">reference path<"));
  EXPECT_EQ(count(on_open_ground, "#f0f0f0"), 0U);
}

TEST(Figures, ThePartEnlargedIsWhereTwoDifferThoughAThirdStands) {
  std::vector<DrivenRun> runs = runs_of("paper_red_alone", {"B", "D"});
  const auto ticks = [&](const std::string& svg) {
    const std::string panel = svg.substr(0, svg.find("where they differ most"));
    return panel.substr(panel.rfind("<g>"));  // grid and ticks of the second panel
  };
  const std::string of_two = ticks(paths_figure(runs, std::nullopt));
  DrivenRun standing = runs.front();
  result::Drive& drive = standing.experiment.drives.begin()->second;
  for (result::DrivenSample& sample : drive) sample.pose = drive.front().pose;
  runs.push_back(standing);
  EXPECT_EQ(ticks(paths_figure(runs, std::nullopt)), of_two);
}

TEST(Figures, ErrorIsDrawnForEverySubgraphAndALapIsMarked) {
  const std::string svg = error_figure(runs_of("paper_red_alone", {"B", "D"}));
  for (const char* text :
       {"subgraph B", "subgraph D", "one lap", "distance to the lane's centre [mm]"}) {
    EXPECT_THAT(svg, HasSubstr(std::string(">") + text + "<"));
  }
  EXPECT_EQ(count(svg, "<polyline"), 3U);
  expect_finite(svg);
}

TEST(Figures, VerticesHaveOnePanelPerSubgraphWithTwoLinesPerVehicle) {
  const std::string svg = vertices_figure(runs_of("paper_three_cars", {"B", "D"}));
  EXPECT_EQ(count(svg, ">subgraph "), 2U);
  EXPECT_EQ(count(svg, "<polyline"), 2U * 3U * 2U);
  EXPECT_EQ(count(svg, ">red<"), 1U);
  EXPECT_THAT(svg, HasSubstr(">100<"));  // a power of ten among the ticks
  expect_finite(svg);
}

TEST(Figures, PlanningTimesThatNobodyMeasuredAreLeftOut) {
  std::vector<DrivenRun> runs = runs_of("paper_red_alone", {"B"});
  const std::string measured = planning_time_figure(runs);
  expect_finite(measured);
  for (ReportRecord& record : runs.front().experiment.reports) record.planning_ns = 0;
  const std::string unmeasured = planning_time_figure(runs);
  expect_finite(unmeasured);
  EXPECT_NE(measured, unmeasured);
  EXPECT_THAT(measured, HasSubstr(">length of a step<"));
}

TEST(Figures, DistancesHaveALinePerPairAndThoseOfContactAndMargins) {
  const std::string svg = distance_figure(runs_of("paper_three_cars", {"B"}));
  for (const char* text :
       {"red and green", "contact", "safety margins of both", "distance of footprints [m]"}) {
    EXPECT_EQ(count(svg, std::string(">") + text + "<"), 1U) << text;
  }
  // These do not come within the 0.6 m that are shown.
  EXPECT_THAT(svg, Not(HasSubstr("red and blue")));
  EXPECT_THAT(svg, Not(HasSubstr("blue and green")));
  EXPECT_EQ(count(svg, "<polyline"), 3U + 2U);
  expect_finite(svg);
}

TEST(Figures, SubgraphsHaveABandPerStretchWithTheSpeedAndTheZone) {
  std::vector<DrivenRun> runs = runs_of("reconfiguration", {}, {"zone", "time"});
  runs.erase(runs.begin() + 1);
  ASSERT_EQ(runs.back().scenario.policy, "time");
  DrivenRun& timed = runs.back();
  // As if vehicle 1 had planned in steps 5 ... 7 on another one.
  for (ReportRecord& record : timed.experiment.reports) {
    const std::uint64_t step =
        record.report.step.value - timed.experiment.facts.first_step.value_or(0);
    const bool is_other = record.report.vehicle == VehicleId{1} && step >= 5 && step < 8;
    record.report.subgraph = is_other ? "A < B" : "B";
  }
  const std::string of_policy = subgraphs_figure(runs);
  for (const char* text : {"policy time, red", "policy time, blue", "policy time, green", "B",
                           "A &lt; B", "speed", "speed [m/s]"}) {
    EXPECT_THAT(of_policy, HasSubstr(std::string(">") + text + "<"));
  }
  EXPECT_THAT(of_policy, Not(HasSubstr("subgraph J2")));  // fixed: nothing to see
  EXPECT_EQ(count(of_policy, "<polygon"), 3U + 1U + 1U);
  EXPECT_EQ(count(of_policy, "<polygon fill=\"" + plot::series_colour(1) + "\""), 1U);
  EXPECT_EQ(count(of_policy, "<polyline"), 3U);
  EXPECT_THAT(of_policy, Not(HasSubstr("zone")));
  expect_finite(of_policy);
}

TEST(Figures, SubgraphsShadeTheTimeInZones) {
  std::vector<DrivenRun> runs = runs_of("reconfiguration", {}, {"zone"});
  const std::string svg = subgraphs_figure(runs);
  for (const char* text : {"in a speed zone", "its limit", "J2", "J2, at most 0.6 m/s"}) {
    EXPECT_EQ(count(svg, std::string(">") + text + "<"), 1U) << text;
  }
  EXPECT_GT(count(svg, "<polygon fill=\"#e4e4e4\""), 0U);
  EXPECT_EQ(count(svg, "<polygon fill=\"#e4e4e4\""), count(svg, "stroke-dasharray") - 1);
  // Without a policy there are no zones, and fixed subgraphs are drawn.
  runs.pop_back();
  const std::string fixed = subgraphs_figure(runs);
  EXPECT_THAT(fixed, HasSubstr(">subgraph J2, red<"));
  EXPECT_THAT(fixed, Not(HasSubstr("zone")));
}

}  // namespace
}  // namespace hlc::campaign::figures_test
