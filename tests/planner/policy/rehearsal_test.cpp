#include "planner/policy/rehearsal.hpp"

#include <gtest/gtest.h>

#include "tests/planner/policy/driven_controller.hpp"

namespace hlc::rehearsal_test {
namespace {

using test::DrivenController;

constexpr double kWay_m = 0.8 * 0.2;  // in a step at reference speed
const BeforeStep kStays = [](Controller&) {};

RehearsalSettings of_steps(std::size_t steps, std::vector<PlanningWeight> weights = {}) {
  return {.steps = steps, .criterion_weights = std::move(weights), .max_expansions = 400'000};
}

/// c_k of a step that was really driven.
double driven_cost_m2(const Controller& controller, StepIndex now) {
  const Plan& plan = controller.plan_in_force();
  const Pose from = plan.pose_at({now.value + 1});
  const Pose to = plan.pose_at({now.value + 2});
  return (to.position_m() - Point(from.x_m + kWay_m, 0.0)).squaredNorm();
}

ConvexPolygon square(double x_m, double y_m) {
  constexpr double kHalf_m = 0.1;
  return {{{x_m - kHalf_m, y_m - kHalf_m},
           {x_m + kHalf_m, y_m - kHalf_m},
           {x_m + kHalf_m, y_m + kHalf_m},
           {x_m - kHalf_m, y_m + kHalf_m}}};
}

/// Vehicle 1, which stands.
Traffic standing(StepIndex step, const ConvexPolygon& area) {
  return {.vehicle = {1},
          .step = step,
          .next_pose = {},
          .next_trim = {},
          .running = {.first = step, .areas_m = {area}, .final_area_m = area},
          .reachable_area_m = area,
          .silent = {}};
}

TEST(Rehearsal, CostsWhatIsThenReallyDriven) {
  DrivenController car;
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(car.step());
    const double rehearsed_m2 = rehearsed_cost_m2(*car, {}, of_steps(5), kStays);
    double driven_m2 = 0.0;
    DrivenController ahead = car.clone();
    for (int i = 0; i < 5; ++i) {
      const Report report = ahead.step();
      driven_m2 += driven_cost_m2(*ahead, report.step);
    }
    EXPECT_NEAR(rehearsed_m2, driven_m2, 1e-15) << "step " << k;
  }
}

TEST(Rehearsal, WhoStandsPaysForTheWayNotDriven) {
  DrivenController car;
  static_cast<void>(car.step());
  DrivenController stands;
  stands->set_drives_out(true);
  static_cast<void>(stands.step());
  EXPECT_NEAR(rehearsed_cost_m2(*stands, {}, of_steps(4), kStays), 4.0 * kWay_m * kWay_m, 1e-12);
  EXPECT_LT(rehearsed_cost_m2(*car, {}, of_steps(4), kStays), 4.0 * kWay_m * kWay_m);
}

TEST(Rehearsal, EveryManeuverCostsItsCriteria) {
  DrivenController car;
  static_cast<void>(car.step());
  const double plain_m2 = rehearsed_cost_m2(*car, {}, of_steps(6), kStays);
  EXPECT_NEAR(rehearsed_cost_m2(*car, {}, of_steps(6, {{"one", 0.25}}), kStays),
              plain_m2 + 6 * 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(rehearsed_cost_m2(*car, {}, of_steps(6, {{"fast", 0.25}}), kStays), plain_m2);
}

TEST(Rehearsal, ChangesNothing) {
  DrivenController car;
  DrivenController other;
  for (int k = 0; k < 10; ++k) {
    const Report report = car.step();
    EXPECT_EQ(report.planned_pose, other.step().planned_pose);
    const auto fast = prepare_subgraph(test::subgraph_of_label("fast"), 8, {});
    static_cast<void>(rehearsed_cost_m2(*car, {}, of_steps(8), [&](Controller& one) {
      if (one.prepared_subgraph().subgraph != fast.subgraph) one.switch_to(fast);
    }));
    EXPECT_EQ(car->last_step(), report.step);
    EXPECT_EQ(car->subgraph().spec().name, "slow");
  }
}

TEST(Rehearsal, AnotherCarStandsInTheWayWhereItTold) {
  DrivenController car;
  for (int k = 0; k < 5; ++k) static_cast<void>(car.step());
  const double x_m = car->plan_in_force().pose_at(car.next_step()).x_m;
  const auto cost_m2 = [&](double y_m) {
    DrivenController one = car.clone();
    const StepIndex now = one.next_step();
    const ConvexPolygon area = square(x_m + 1.2, y_m);
    const Prediction prediction{
        .vehicle = {1},
        .step = now,
        .is_new = false,
        .areas = {.first = {now.value + 1}, .areas_m = {area}, .final_area_m = area}};
    static_cast<void>(one.step({standing(now, area)}, {prediction}));
    return rehearsed_cost_m2(*one, {.traffic = {standing(now, area)}, .predictions = {prediction}},
                             of_steps(8), kStays);
  };
  EXPECT_GT(cost_m2(0.0), cost_m2(3.0) + 1e-3);
}

// Which of them have come when a step is over is a matter of chance.
TEST(Rehearsal, APredictionThatTheControllerDidNotWaitForDoesNotCount) {
  DrivenController car;
  for (int k = 0; k < 5; ++k) static_cast<void>(car.step());
  const StepIndex now = car.next_step();
  const Traffic far = standing(now, square(0.0, 20.0));
  const double x_m = car->plan_in_force().pose_at(now).x_m;
  const ConvexPolygon in_the_way = square(x_m + 1.0, 0.0);
  const Prediction prediction{
      .vehicle = {1},
      .step = now,
      .is_new = true,
      .areas = {.first = {now.value + 1}, .areas_m = {in_the_way}, .final_area_m = in_the_way}};
  static_cast<void>(car.step({far}));
  ASSERT_TRUE(car->coupled().empty());
  EXPECT_EQ(
      rehearsed_cost_m2(*car, {.traffic = {far}, .predictions = {prediction}}, of_steps(8), kStays),
      rehearsed_cost_m2(*car, {.traffic = {far}, .predictions = {}}, of_steps(8), kStays));
}

}  // namespace
}  // namespace hlc::rehearsal_test
