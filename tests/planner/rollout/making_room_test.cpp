// Cars that make room get on where they would stand in front of each other forever.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::rollout {
namespace {

using controller::CoordinationRule;

scenario::Scenario shipped(const std::string& name, std::optional<std::size_t> cars = {}) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml",
       .cars = cars});
}

/// Cars that still stand because of others after so many steps.
std::size_t num_waiting(scenario::Scenario scenario, const CoordinationRule& rule, int steps) {
  scenario.profile.strategies.coordination = rule;
  Rollout rollout = make_rollout(scenario);
  std::vector<coordination::Report> reports;
  for (int i = 0; i < steps; ++i) {
    reports = rollout.step();
    EXPECT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << i;
  }
  for (std::size_t i = 0; i < reports.size(); ++i) {
    rollout.controllers()[i]->note_causes(reports[i]);
  }
  return static_cast<std::size_t>(std::ranges::count_if(
      reports, [](const auto& report) { return !report.waiting.vehicles.empty(); }));
}

class CarsOnACircle : public testing::TestWithParam<std::size_t> {};

TEST_P(CarsOnACircle, AllGetToTheOtherSide) {
  EXPECT_EQ(num_waiting(shipped("circle", GetParam()), controller::kCooperativeCoordination, 60),
            0U);
}

INSTANTIATE_TEST_SUITE_P(Cars, CarsOnACircle, testing::Values(2, 5, 6, 9, 12, 16),
                         testing::PrintToStringParamName());

TEST(MakingRoom, IsWhatBringsThemThere) {
  EXPECT_EQ(num_waiting(shipped("circle", 6), controller::kStrictCoordination, 60), 3U);
}

/// The scenario's cars somewhere on their routes, at least 0.4 m apart.
scenario::Scenario from_random_starts(scenario::Scenario scenario, std::mt19937& random) {
  std::vector<Point> taken_m;
  for (scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    std::uniform_real_distribution<double> anywhere_m(0.0, vehicle.path.length_m());
    const auto is_taken = [&](double s_m) {
      return std::ranges::any_of(
          taken_m, [&](const Point& other) { return (other - vehicle.path.at(s_m)).norm() < 0.4; });
    };
    double s_m = anywhere_m(random);
    while (is_taken(s_m)) s_m = anywhere_m(random);
    taken_m.push_back(vehicle.path.at(s_m));
    vehicle.start = {taken_m.back().x(), taken_m.back().y(), vehicle.path.heading_rad_at(s_m)};
    vehicle.start_s_m = s_m;
  }
  return scenario;
}

TEST(MakingRoom, ThePapersCarsDriveOnFromAnyStart) {
  const scenario::Scenario scenario = shipped("paper_three_cars");
  for (unsigned seed = 0; seed < test::num_costly_seeds(10); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    EXPECT_EQ(num_waiting(from_random_starts(scenario, random),
                          controller::kCooperativeCoordination, 300),
              0U);
  }
}

}  // namespace
}  // namespace hlc::rollout
