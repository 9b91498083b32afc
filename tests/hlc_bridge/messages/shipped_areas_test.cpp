// No message of ours may be refused: the areas of the shipped automata, wherever the vehicle is.
#include <gtest/gtest.h>

#include <numbers>
#include <ostream>
#include <random>
#include <string>

#include "hlc_bridge/messages/validate.hpp"
#include "planner/automaton/reachable_sets.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::shipped_areas_test {
namespace {

struct Shipped {
  std::string scenario;
  std::string subgraph;
};
void PrintTo(const Shipped& one, std::ostream* out) { *out << one.scenario << "_" << one.subgraph; }

class ShippedAreas : public testing::TestWithParam<Shipped> {
 protected:
  void expect_valid(const ConvexPolygon& area) {
    ASSERT_TRUE(is_valid_area(area));
    for (int i = 0; i < 20; ++i) {
      const Pose pose{position_m_(random_), position_m_(random_), heading_rad_(random_)};
      ASSERT_TRUE(is_valid_area(transformed(area, pose)))
          << pose.x_m << " " << pose.y_m << " " << pose.heading_rad;
    }
  }

 private:
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> position_m_{-1000.0, 1000.0};
  std::uniform_real_distribution<double> heading_rad_{-std::numbers::pi, std::numbers::pi};
};

TEST_P(ShippedAreas, AreValidAnywhere) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + GetParam().scenario + ".yaml",
       .subgraph = GetParam().subgraph});
  const auto& automaton = scenario.subgraph->automaton();
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) {
    expect_valid(maneuver.swept_area_m);
    expect_valid(maneuver.lane_area_m);
  }
  constexpr std::size_t kSteps = 4;
  const automaton::ReachableSets reachable{*scenario.subgraph, kSteps};
  for (std::size_t trim = 0; trim < automaton.trims.size(); ++trim) {
    for (std::size_t step = 0; step <= kSteps; ++step) {
      const TrimId id{trim};
      expect_valid(reachable.swept_area_m(id, step));
      expect_valid(reachable.swept_area_until_m(id, step));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ShippedAreas,
                         testing::Values(Shipped{"paper_three_cars", "A"},
                                         Shipped{"grid_red_alone", "J2"},
                                         Shipped{"lab_circle", "B"},
                                         Shipped{"passenger_cars", "effort"},
                                         Shipped{"passenger_cars", "comfort"}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace hlc::shipped_areas_test
