#include "planner/plot/scenario_plot.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "tests/support/folders.hpp"

namespace hlc::plot {
namespace {

std::string plot_of(const std::string& scenario) {
  const scenario::Scenario read = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + scenario + ".yaml"});
  return scenario_plot(read, map_of(read));
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t sum = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++sum;
  }
  return sum;
}

TEST(ScenarioPlot, ShowsLanesPathsAndVehiclesWithTheirIds) {
  const std::string plot = plot_of("paper_three_cars");
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(plot.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  for (const char* text : {"vehicle 1: red", "vehicle 2: blue", "vehicle 3: green", "x [m]"}) {
    EXPECT_EQ(count(plot, std::string(">") + text + "<"), 1U) << text;
  }
  const std::size_t lanelets =
      road::read_lanelet_map(test::source_folder() + "/launch_scripts/maps/lab_like.xml")
          .lanelets.size();
  EXPECT_EQ(count(plot, "<polygon fill=\"#f0f0f0\""), lanelets);
  EXPECT_EQ(count(plot, "<polyline"), 2 * lanelets + 3);
  for (const char* colour : {"#d62728", "#1f4fd8", "#2ca02c"}) {  // footprint in the path's colour
    EXPECT_EQ(count(plot, std::string("<polygon fill=\"") + colour), 1U);
    EXPECT_EQ(count(plot, std::string("<polyline fill=\"none\" stroke=\"") + colour), 1U);
  }
}

TEST(ScenarioPlot, TheSheetHasThePosesToPlaceTheVehiclesBy) {
  const scenario::Scenario ring = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_ring.yaml"});
  const std::string sheet = scenario_plot(ring, map_of(ring), true);
  EXPECT_EQ(count(sheet, ">vehicle 1: one, x 3.16 m, y 3.89 m, yaw -0.04 rad (-3 deg)<"), 1U);
  EXPECT_EQ(count(sheet, " rad ("), 4U);
  EXPECT_EQ(count(scenario_plot(ring, map_of(ring)), " rad ("), 0U);
}

TEST(ScenarioPlot, OpenGroundHasNoLanes) {
  const std::string plot = plot_of("circle");
  EXPECT_EQ(count(plot, "#f0f0f0"), 0U);
  EXPECT_EQ(count(plot, "<polyline"), 4U);
  EXPECT_EQ(plot, plot_of("circle"));
}

}  // namespace
}  // namespace hlc::plot
