// The shipped scenarios with vehicles that follow perfectly: what planning and coordination alone
// give.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <tuple>

#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc {
namespace {

const std::string kFolder = std::string(HLC_SOURCE_DIR) + "/launch_scripts/scenarios/";
const std::filesystem::path kLabMap =
    std::string(HLC_SOURCE_DIR) + "/../shared/data/LabMapCommonRoad.xml";

struct Course {
  std::optional<double> lap_s;
  double mean_error_mm{};
  std::uint64_t max_generated{};
  int fallbacks{};
  int steps_changed{};  ///< steps in which another vehicle changed somebody's plan
};

/// Unwrapped way along a closed path.
class Lap {
 public:
  Lap(const ReferencePath& path, double start_m) : path_(path), s_m_(start_m) {}
  double error_mm(const Point& position) {
    const auto projection = path_.project_within(position, s_m_ - 0.3, s_m_ + 1.0);
    const double length = path_.length_m();
    double moved = projection.s_m - s_m_;
    moved -= length * std::round(moved / length);
    if (!lap_steps_ && way_m_ + moved >= length) {
      lap_steps_ = step_ - (way_m_ + moved - length) / moved;
    }
    way_m_ += moved;
    s_m_ = projection.s_m;
    ++step_;
    return 1e3 * projection.distance_m;
  }
  [[nodiscard]] std::optional<double> lap_s(double step_s) const {
    return lap_steps_ ? std::optional(*lap_steps_ * step_s) : std::nullopt;
  }

 private:
  const ReferencePath& path_;
  double s_m_;
  double way_m_{};
  double step_{};
  std::optional<double> lap_steps_;
};

/// Drives `scenario` and looks at its first vehicle.
Course drive(const Scenario& scenario) {
  std::vector<std::unique_ptr<Controller>> controllers;
  std::vector<Pose> starts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(make_controller(scenario, vehicle.id));
    starts.push_back(vehicle.start);
  }
  Rollout rollout(std::move(controllers), starts);
  const ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  const auto alone = make_best_first_planner(*scenario.subgraph, reachable,
                                             {.cost_to_go = scenario.profile.cost_to_go});
  Lap lap(scenario.vehicles.front().path, scenario.vehicles.front().start_s_m);
  Course course;
  for (std::size_t step = 0; step < scenario.steps; ++step) {
    bool is_changed = false;
    const std::vector<Report> reports = rollout.step();
    for (std::size_t i = 0; i < reports.size(); ++i) {
      if (reports[i].status != StepStatus::kPlanned) {
        ++course.fallbacks;
        continue;
      }
      if (reports[i].coupled.empty()) continue;
      HorizonProblem problem = rollout.controllers()[i]->problem().value();
      problem.obstacles_m.clear();
      is_changed |= i > 0 && alone->plan(problem).cost < reports[i].cost_m2 - 1e-9;
    }
    if (is_changed) ++course.steps_changed;
    course.mean_error_mm += lap.error_mm(reports.front().planned_pose.position_m()) /
                            static_cast<double>(scenario.steps);
    course.max_generated = std::max(course.max_generated, reports.front().generated);
  }
  course.lap_s = lap.lap_s(scenario.subgraph->automaton().step_s);
  return course;
}

class PaperScenario : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  void SetUp() override {
    if (std::get<1>(GetParam()) && !std::filesystem::exists(kLabMap)) {
      GTEST_SKIP() << "the lab's own map is not there: " << kLabMap;
    }
  }
  [[nodiscard]] Scenario read(const std::string& name) const {
    const auto& [profile, on_lab_map] = GetParam();
    ScenarioChoices choices{.file = kFolder + name + ".yaml", .profile = profile};
    if (on_lab_map) choices.map_file = kLabMap;
    return read_scenario(choices);
  }
};

// The bounds are those of three independent reproductions of the paper (subgraph B, one car).
TEST_P(PaperScenario, TheRedCarAloneDrivesAsThePaperSays) {
  const Course course = drive(read("paper_red_alone"));
  ASSERT_TRUE(course.lap_s);
  EXPECT_GE(*course.lap_s, 15.5);
  EXPECT_LE(*course.lap_s, 16.2);
  EXPECT_EQ(course.fallbacks, 0);
  EXPECT_GE(course.mean_error_mm, 15.0);
  EXPECT_LE(course.mean_error_mm, 32.0);
  if (std::get<0>(GetParam()) == "2022") {
    EXPECT_LE(course.max_generated, 550U);
  }
}

TEST_P(PaperScenario, ThreeCarsMeetOftenAndNobodyFallsBack) {
  const Course alone = drive(read("paper_red_alone"));
  const Course course = drive(read("paper_three_cars"));
  EXPECT_EQ(course.fallbacks, 0);
  EXPECT_GE(course.steps_changed, 30);
  ASSERT_TRUE(course.lap_s && alone.lap_s);
  const double allowed_s = std::get<0>(GetParam()) == "2022" ? 0.2 : 0.5;
  EXPECT_NEAR(*course.lap_s, *alone.lap_s, allowed_s);
}

INSTANTIATE_TEST_SUITE_P(Profiles, PaperScenario,
                         testing::Combine(testing::Values("default", "2022"), testing::Bool()),
                         [](const auto& one) {
                           return "Profile_" + std::get<0>(one.param) +
                                  (std::get<1>(one.param) ? "_lab_map" : "_own_map");
                         });

}  // namespace
}  // namespace hlc
