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
  measured.pose_lead_s = 0.04;
  EXPECT_NEAR(step(*one, at(106, {measured})).deviation_m, 0.0, 1e-9);
}

TEST(SeenAt, ATimeLiesInTheStepThatContainsIt) {
  const auto seen = [](StepIndex now, double age_s, double lead_s) {
    const SeenAt at = seen_at({.vehicle = {1}, .age_s = age_s, .pose_lead_s = lead_s}, now, 0.2);
    EXPECT_GE(at.time_s, 0.0);
    EXPECT_LT(at.time_s, 0.2 + 1e-12);
    EXPECT_LE(at.step, now);
    return 0.2 * static_cast<double>(at.step.value) + at.time_s;
  };
  for (const double age_s : {-0.15, -0.04, 0.0, 0.04, 0.2, 0.25}) {
    for (const double lead_s : {0.0, 0.02}) {
      EXPECT_NEAR(seen({10}, age_s, lead_s), 2.0 - age_s + lead_s, 1e-9) << age_s;
    }
  }
  EXPECT_NEAR(seen({10}, -0.19, 0.1), 2.2, 1e-6) << "not after the step";
  EXPECT_EQ(seen({0}, 0.06, 0.0), 0.0) << "not before all steps";
}

/// A car that is not where its plan is, with the lab's tracking errors.
class BesideItsPlan : public testing::Test {
 protected:
  static constexpr double kBound_m = 0.035;

  BesideItsPlan() { static_cast<void>(one_.stand_by(at(100, {seen(1, 0.0, 0.0)}))); }

  void drive(int steps) {
    for (int i = 0; i < steps; ++i) static_cast<void>(step_seen(Point::Zero()));
  }
  /// The traffic of a step in which the car is seen that much off its plan.
  coordination::Traffic step_seen(const Point& off_m) {
    car_ = following(one_, ++step_);
    car_.pose.x_m += off_m.x();
    car_.pose.y_m += off_m.y();
    coordination::Traffic traffic = one_.observe(at(step_, {car_}));
    one_.couple({});
    static_cast<void>(one_.plan({}));
    report_ = one_.commit({}, {});
    return traffic;
  }
  [[nodiscard]] bool holds_car(const ConvexPolygon& area) const {
    return contains(
        area, footprint_area(automaton::paper_automaton()->vehicle.footprint, car_.pose, 0.0));
  }

  Controller one_{
      ControllerOptions{.vehicle = {1}, .deviation = {.tracking_error_max_m = kBound_m}},
      subgraph(), road::ReferencePath({Point(0.0, 0.0), Point(9.0, 0.0)}, false), road::Corridor{}};
  std::uint64_t step_{100};
  coordination::MeasuredVehicle car_;
  coordination::Report report_;
};

const std::vector<Point> kUndisturbed_m{{0.0, 0.005},  {0.0, 0.025},  {0.0, -0.034}, {0.025, 0.0},
                                        {-0.025, 0.0}, {-0.034, 0.0}, {0.020, 0.020}};

TEST_F(BesideItsPlan, WhereItStandsByNoMoreThanUndisturbedCarsItAnnouncesThatForAllTime) {
  for (const Point& off_m : kUndisturbed_m) {
    static_cast<void>(one_.stand_by(at(++step_, {seen(1, 0.0, 0.0)})));
    const coordination::Traffic traffic = step_seen(off_m);
    SCOPED_TRACE(off_m.transpose());
    EXPECT_EQ(report_.status, coordination::StepStatus::kPlanned);
    EXPECT_EQ(one_.plan_in_force().pose_at({step_}).x_m, 0.0) << "not anchored there";
    for (const ConvexPolygon& area : traffic.running.areas_m) EXPECT_TRUE(holds_car(area));
    EXPECT_TRUE(holds_car(traffic.running.final_area_m));
  }
}

TEST_F(BesideItsPlan, WhereItDrivesByNoMoreThanUndisturbedCarsItPlansOnFromItsPlan) {
  for (const Point& off_m : kUndisturbed_m) {
    drive(4);
    const double next_m = one_.plan_in_force().pose_at({step_ + 2}).y_m;
    const coordination::Traffic traffic = step_seen(off_m);
    SCOPED_TRACE(off_m.transpose());
    EXPECT_EQ(report_.status, coordination::StepStatus::kPlanned) << to_string(report_.reason);
    EXPECT_EQ(traffic.next_pose.y_m, next_m);
    EXPECT_TRUE(holds_car(traffic.running.areas_m.front()));
  }
}

TEST_F(BesideItsPlan, WhereItDrivesByMoreItWasDisturbed) {
  drive(4);
  static_cast<void>(step_seen({0.0, 0.050}));
  EXPECT_EQ(report_.reason, coordination::FallbackReason::kDeviation);
}

}  // namespace
}  // namespace hlc::controller::east_bound
