// A controller whose car follows its plan with an error that is no disturbance.
#include <gtest/gtest.h>

#include "planner/controller/drift.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/planner/controller/east_bound.hpp"
#include "tests/support/folders.hpp"

namespace hlc::controller::east_bound {
namespace {

coordination::Report step(Controller& one, const Observation& observation) {
  static_cast<void>(one.observe(observation));
  one.couple({});
  static_cast<void>(one.plan({}));
  return one.commit({}, {});
}

class AtItsGoal : public testing::Test {
 protected:
  /// A car of lab_circle that stands where its path ends.
  AtItsGoal() { static_cast<void>(one_->stand_by(at(100, {measured_at(goal_)}))); }

  [[nodiscard]] double margin_m() const {
    return scenario_.subgraph->automaton().vehicle.safety_margin_m;
  }
  [[nodiscard]] static coordination::MeasuredVehicle measured_at(const Pose& pose) {
    return {.vehicle = {1}, .pose = pose};
  }

  const scenario::Scenario scenario_{scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_circle.yaml"})};
  std::unique_ptr<Controller> one_{scenario::make_controller(scenario_, {1})};
  const Pose goal_{[&] {
    const road::ReferencePath& path = scenario_.vehicles.front().path;
    const Point end_m = path.at(path.length_m());
    return Pose{end_m.x(), end_m.y(), path.heading_rad_at(path.length_m())};
  }()};
};

// With the lab's vehicles a car at its goal had 48 steps of 75 in `conflict` with nobody near: to
// stand where it stood, beside its plan, it needed an area beyond those that a plan could reach.
TEST_F(AtItsGoal, ACarThatStandsBesideItsPlanWithNobodyNearPlansOn) {
  std::size_t tested = 0;
  std::uint64_t k = 100;
  for (const double along_m : {-0.009, 0.0, 0.009}) {
    for (const double turn_rad : {-0.12, -0.08, 0.08, 0.12}) {
      const Pose pose = compose(goal_, {along_m, 0.0, turn_rad});
      const coordination::Report report = step(*one_, at(++k, {measured_at(pose)}));
      if (report.deviation_m > 0.5 * margin_m() && report.deviation_m <= margin_m()) ++tested;
      EXPECT_EQ(report.status, coordination::StepStatus::kPlanned)
          << to_string(report.reason) << ": " << along_m << " m along, turned by " << turn_rad
          << ", deviation " << report.deviation_m;
    }
  }
  EXPECT_GT(tested, 4U) << "where the plan may drift";
}

TEST(TrackingError, UpToThatOfUndisturbedCarsThePlanDoesNotMoveToTheCar) {
  for (const double bound_m : {0.0, 0.009}) {
    Controller one(
        ControllerOptions{.vehicle = {1}, .deviation = {.tracking_error_max_m = bound_m}},
        subgraph(), road::ReferencePath({Point(0.0, 0.0), Point(9.0, 0.0)}, false), {});
    static_cast<void>(one.stand_by(at(100, {seen(1, 0.0, 0.0)})));
    const coordination::Traffic traffic = one.observe(at(101, {seen(1, 0.0, 0.008)}));
    EXPECT_NEAR(traffic.next_pose.y_m, bound_m > 0.0 ? 0.0 : 0.008, 1e-9);
  }
}

TEST(TrackingError, APoseOfATimeAfterTheListsStepBeganIsComparedWithThePlanOfThatTime) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  for (std::uint64_t k = 101; k < 106; ++k) {
    static_cast<void>(step(*one, at(k, {following(*one, k)})));
  }
  const vehicle::State then =
      one->plan_in_force().state_at({106}, 0.04, automaton::paper_automaton()->vehicle);
  coordination::MeasuredVehicle measured = seen(1, then.pose.x_m, then.pose.y_m, then.speed_mps);
  measured.age_s = -0.04;
  EXPECT_NEAR(step(*one, at(106, {measured})).deviation_m, 0.0, 1e-9);
}

TEST(SeenAt, ATimeLiesInTheStepThatContainsIt) {
  const auto time_of = [](double age_s) {
    coordination::MeasuredVehicle measured{.vehicle = {1}, .age_s = age_s};
    const SeenAt at = seen_at(measured, {10}, 0.2);
    EXPECT_GE(at.time_s, 0.0);
    EXPECT_LT(at.time_s, 0.2 + 1e-12);
    return 0.2 * static_cast<double>(at.step.value) + at.time_s;
  };
  for (const double age_s : {-0.25, -0.2, -0.04, 0.0, 0.04, 0.2, 0.25}) {
    EXPECT_NEAR(time_of(age_s), 2.0 - age_s, 1e-9) << age_s;
  }
}

}  // namespace
}  // namespace hlc::controller::east_bound
