#include "hlc_bridge/view/lab_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::view {
namespace {

constexpr Nanoseconds kTimeToLive = 600'000'000;

const scenario::Scenario& scenario() {
  static const scenario::Scenario scenario =
      scenario::read_scenario({.file = std::filesystem::path{test::source_folder()} /
                                       "launch_scripts/scenarios/paper_three_cars.yaml"});
  return scenario;
}

/// A vehicle of the scenario that stands at its start, alone on the road.
class Car {
 public:
  explicit Car(VehicleId id)
      : vehicle_(scenario::vehicle_of(scenario(), id)),
        controller_(scenario::make_controller(scenario(), id)) {}

  coordination::Report stand_by() { return controller_->stand_by(observation()); }

  coordination::Report step() {
    static_cast<void>(controller_->observe(observation()));
    controller_->couple({});
    static_cast<void>(controller_->plan({}));
    return controller_->commit({}, {});
  }

  [[nodiscard]] controller::Controller& controller() { return *controller_; }
  [[nodiscard]] std::vector<Visualization> drawings(const coordination::Report& report) const {
    return lab_map(*controller_, report, kTimeToLive);
  }

 private:
  [[nodiscard]] controller::Observation observation() {
    ++step_;
    return {.step = {step_},
            .active = {vehicle_.id},
            .states = {{.vehicle = vehicle_.id,
                        .pose = scenario::measured_start(scenario(), vehicle_),
                        .speed_mps = 0.0}},
            .present = {vehicle_.id}};
  }

  const scenario::ScenarioVehicle& vehicle_;
  std::unique_ptr<controller::Controller> controller_;
  std::uint64_t step_{10};
};

const Visualization* text_in(const std::vector<Visualization>& drawings) {
  const auto text = std::ranges::find(drawings, DrawingKind::kText, &Visualization::kind);
  return text == drawings.end() ? nullptr : &*text;
}

std::vector<const Visualization*> lines_in(const std::vector<Visualization>& drawings) {
  std::vector<const Visualization*> lines;
  for (const Visualization& drawing : drawings) {
    if (drawing.kind == DrawingKind::kLineStrips) lines.push_back(&drawing);
  }
  return lines;
}

TEST(LabMap, SaysBeforeTheStartWhoStandsBy) {
  Car car({2});
  const std::vector<Visualization> drawings = car.drawings(car.stand_by());
  ASSERT_NE(text_in(drawings), nullptr);
  EXPECT_EQ(text_in(drawings)->text, "2: standby");
  EXPECT_EQ(lines_in(drawings).size(), 1U) << "the place where it stands, no reference";
}

TEST(LabMap, ShowsThePlanInForceAndTheReferenceOfTheSearch) {
  Car car({1});
  static_cast<void>(car.stand_by());
  const coordination::Report report = car.step();
  ASSERT_EQ(report.status, coordination::StepStatus::kPlanned);
  const std::vector<Visualization> drawings = car.drawings(report);
  const auto lines = lines_in(drawings);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]->points_m, car.controller().problems().back().problem.reference_m);
  const coordination::Plan& plan = car.controller().plan_in_force();
  EXPECT_EQ(lines[1]->points_m.front(), plan.pose_at(report.step).position_m());
  EXPECT_EQ(lines[1]->points_m.back(), plan.pose_at(plan.end()).position_m());
  EXPECT_GT((lines[1]->points_m.back() - lines[1]->points_m.front()).norm(), 0.1);
  EXPECT_EQ(text_in(drawings)->text, "1: planned");
}

TEST(LabMap, SaysWhyAStepFellBackAndShowsItInAnotherColour) {
  Car car({1});
  static_cast<void>(car.stand_by());
  const coordination::Report good = car.step();
  coordination::Report late = good;
  late.status = coordination::StepStatus::kFallback;
  late.reason = coordination::FallbackReason::kLate;
  EXPECT_EQ(text_in(car.drawings(late))->text, "1: fallback (late)");
  EXPECT_NE(text_in(car.drawings(late))->color.red, text_in(car.drawings(good))->color.red);
}

TEST(LabMap, DrawingsOfAStepReplaceThoseBeforeAndNobodyElses) {
  std::set<std::uint64_t> ids;
  std::size_t count = 0;
  for (const scenario::ScenarioVehicle& vehicle : scenario().vehicles) {
    Car car(vehicle.id);
    static_cast<void>(car.stand_by());
    std::set<std::uint64_t> own;
    for (int step = 0; step < 3; ++step) {
      for (const Visualization& drawing : car.drawings(car.step())) {
        own.insert(drawing.id);
        EXPECT_EQ(drawing.time_to_live, kTimeToLive);
      }
    }
    EXPECT_EQ(own.size(), 3U);
    count += own.size();
    ids.insert(own.begin(), own.end());
  }
  EXPECT_EQ(ids.size(), count);
}

}  // namespace
}  // namespace hlc::view
