// Cars that stand beside their lanes at the start, or fit none.
#include <gtest/gtest.h>

#include <array>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/simulation/observed_run.hpp"

namespace hlc::closed_loop::start_test {
namespace {

constexpr Nanoseconds kPatience = 60 * kNanosecondsPerSecond;

/// The paper's red car, started elsewhere: so far to the left of its path, turned.
scenario::Scenario red_beside(double left_m, double turned_rad) {
  scenario::Scenario red = scenario::with_starts(scenario_of("paper_red_alone"), std::array{1.0});
  red.vehicles[0].start = compose(red.vehicles[0].start, {0.0, left_m, turned_rad});
  return red;
}

double way_m(const result::Drive& drive) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    way_m += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return way_m;
}

TEST(Start, ACarBesideItsLaneDrivesOntoItsReference) {
  const scenario::Scenario red = red_beside(0.09, 0.3);
  ObservedRun run(red, {.seed = 1, .is_logical = true, .steps = 40});
  ASSERT_TRUE(run.comes_to([&] { return run.have_all_ended(); }, kPatience));
  EXPECT_EQ(run.exit_codes().at(kLabControlName), kExitGood);
  const result::Drive& drive = run.drives().at(1);
  const auto error_m = [&red](const result::DrivenSample& sample) {
    return red.vehicles[0].path.project(sample.pose.position_m()).distance_m;
  };
  EXPECT_NEAR(error_m(drive.front()), 0.09, 0.001);
  EXPECT_GT(way_m(drive), 4.0);
  double last_error_m = 0.0;
  for (std::size_t i = drive.size() / 2; i < drive.size(); ++i) {
    last_error_m = std::max(last_error_m, error_m(drive[i]));
  }
  EXPECT_LT(last_error_m, 0.07) << "as on every lap";
  EXPECT_TRUE(run.has_logged(controller_name(1), "selects route"));
  EXPECT_EQ(run.violations(), "");
}

TEST(Start, ACarThatFitsNoRouteStandsAndItsControllerSaysHowFarItIsOff) {
  const scenario::Scenario red = red_beside(0.5, 0.0);
  ObservedRun run(red, {.seed = 2});
  ASSERT_TRUE(run.comes_to([&] { return run.have_all_ended(); }, kPatience));
  EXPECT_EQ(run.exit_codes().at(kLabControlName), kExitMissing);
  EXPECT_TRUE(run.has_logged(kLabControlName, "not ready: middleware_1"));
  EXPECT_TRUE(run.has_logged(controller_name(1), "fits no route: nearest is"));
  EXPECT_TRUE(run.has_logged(controller_name(1), "mm beyond the lanes (must be <= 150 mm)"));
  EXPECT_LT(way_m(run.drives().at(1)), 1e-6);
}

}  // namespace
}  // namespace hlc::closed_loop::start_test
