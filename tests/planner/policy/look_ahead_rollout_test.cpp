#include "planner/policy/look_ahead_rollout.hpp"

#include <gtest/gtest.h>

#include "tests/planner/policy/driven_controller.hpp"

namespace hlc::policy::look_ahead_rollout_test {
namespace {

using test::DrivenController;

constexpr double kWay_m = 0.8 * 0.2;  // in a step at reference speed
const BeforeStep kStays = [](controller::Controller&) {};

LookAheadRolloutSettings of_steps(std::size_t steps,
                                  std::vector<search::PlanningWeight> weights = {}) {
  return {.steps = steps,
          .criterion_weights = std::move(weights),
          .max_expansions = 400'000,
          .most_expansions = 400'000};
}

double cost_m2(const controller::Controller& controller, const LookAheadRolloutSettings& settings) {
  return rollout_cost_m2(controller, settings, kStays).value();
}

/// c_k of a step that was really driven.
double driven_cost_m2(const controller::Controller& controller, StepIndex now) {
  const coordination::Plan& plan = controller.plan_in_force();
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
coordination::Traffic standing(StepIndex step, const ConvexPolygon& area) {
  return {.vehicle = {1},
          .step = step,
          .next_pose = {},
          .next_trim = {},
          .running = {.first = step, .areas_m = {area}, .final_area_m = area},
          .reachable_area_m = area,
          .silent = {}};
}

TEST(LookAheadRollout, CostsWhatIsThenReallyDriven) {
  DrivenController car;
  for (int k = 0; k < 20; ++k) {
    static_cast<void>(car.step());
    const double predicted_m2 = cost_m2(*car, of_steps(5));
    double driven_m2 = 0.0;
    DrivenController ahead = car.clone();
    for (int i = 0; i < 5; ++i) {
      const coordination::Report report = ahead.step();
      driven_m2 += driven_cost_m2(*ahead, report.step);
    }
    EXPECT_NEAR(predicted_m2, driven_m2, 1e-15) << "step " << k;
  }
}

TEST(LookAheadRollout, WhoStandsPaysForTheWayNotDriven) {
  DrivenController car;
  static_cast<void>(car.step());
  DrivenController stands;
  stands->set_minimal_risk_stop(true);
  static_cast<void>(stands.step());
  EXPECT_NEAR(cost_m2(*stands, of_steps(4)), 4.0 * kWay_m * kWay_m, 1e-12);
  EXPECT_LT(cost_m2(*car, of_steps(4)), 4.0 * kWay_m * kWay_m);
}

TEST(LookAheadRollout, WhoStandsOnASlowSectionPaysForTheWayThatItWouldDriveThere) {
  DrivenController stands;
  stands->set_minimal_risk_stop(true);
  static_cast<void>(stands.step());
  stands->change_route({.name = {},
                        .path = road::ReferencePath({{0.0, 0.0}, {40.0, 0.0}}, false),
                        .corridor = {},
                        .speed_sections = {{0.0, 40.0, 0.4}}});
  EXPECT_NEAR(cost_m2(*stands, of_steps(4)), kWay_m * kWay_m, 1e-12) << "half of each of 4 ways";
}

TEST(LookAheadRollout, EveryManeuverCostsItsCriteria) {
  DrivenController car;
  static_cast<void>(car.step());
  const double plain_m2 = cost_m2(*car, of_steps(6));
  EXPECT_NEAR(cost_m2(*car, of_steps(6, {{"one", 0.25}})), plain_m2 + 6 * 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(cost_m2(*car, of_steps(6, {{"fast", 0.25}})), plain_m2);
}

TEST(LookAheadRollout, ChangesNothing) {
  DrivenController car;
  DrivenController other;
  for (int k = 0; k < 10; ++k) {
    const coordination::Report report = car.step();
    EXPECT_EQ(report.planned_pose, other.step().planned_pose);
    const auto fast = controller::prepare_subgraph(test::subgraph_of_label("fast"), 8, {});
    static_cast<void>(rollout_cost_m2(*car, of_steps(8), [&](controller::Controller& one) {
      if (one.prepared_subgraph().subgraph != fast.subgraph) one.switch_to(fast);
    }));
    EXPECT_EQ(car->last_step(), report.step);
    EXPECT_EQ(car->subgraph().spec().name, "slow");
  }
}

coordination::Prediction predicted(StepIndex step, const ConvexPolygon& area, bool is_new) {
  return {.vehicle = {1},
          .step = step,
          .is_new = is_new,
          .areas = {.first = {step.value + 1}, .areas_m = {area}, .final_area_m = area}};
}

TEST(LookAheadRollout, AnotherCarStandsInTheWayWhereItAnnounced) {
  DrivenController car;
  for (int k = 0; k < 5; ++k) static_cast<void>(car.step());
  const double x_m = car->plan_in_force().pose_at(car.next_step()).x_m;
  const auto cost_with_a_car_at = [&](double y_m) {
    DrivenController one = car.clone();
    const StepIndex now = one.next_step();
    const ConvexPolygon area = square(x_m + 1.2, y_m);
    static_cast<void>(one.step({standing(now, area)}, {predicted(now, area, false)}));
    return cost_m2(*one, of_steps(8));
  };
  EXPECT_GT(cost_with_a_car_at(0.0), cost_with_a_car_at(3.0) + 1e-3);
}

// Which of them have come when a step is over is a matter of chance.
TEST(LookAheadRollout, APredictionThatTheControllerDidNotWaitForDoesNotCount) {
  DrivenController car;
  for (int k = 0; k < 5; ++k) static_cast<void>(car.step());
  const StepIndex now = car.next_step();
  const coordination::Traffic far = standing(now, square(0.0, 20.0));
  const double x_m = car->plan_in_force().pose_at(now).x_m;
  DrivenController without = car.clone();
  static_cast<void>(without.step({far}));
  static_cast<void>(car.step({far}, {predicted(now, square(x_m + 1.0, 0.0), true)}));
  ASSERT_TRUE(car->coupled().empty());
  EXPECT_EQ(cost_m2(*car, of_steps(8)), cost_m2(*without, of_steps(8)));
}

// Vehicle 1 goes before vehicle 2, which the car is; vehicle 3 after it.
TEST(LookAheadRollout, TheNewPlanOfACoupledVehicleCounts) {
  for (const std::uint8_t other : std::vector<std::uint8_t>{1, 3}) {
    DrivenController car;
    for (int k = 0; k < 5; ++k) static_cast<void>(car.step());
    const StepIndex now = car.next_step();
    const double x_m = car->plan_in_force().pose_at(now).x_m;
    coordination::Traffic traffic = standing(now, square(x_m + 1.2, 0.0));
    traffic.vehicle = {other};
    coordination::Prediction away = predicted(now, square(x_m + 1.2, 1.0), true);
    away.vehicle = {other};
    DrivenController stays = car.clone();
    coordination::Prediction none = predicted(now, square(x_m + 1.2, 0.0), false);
    none.vehicle = {other};
    static_cast<void>(stays.step({traffic}, {none}));
    static_cast<void>(car.step({traffic}, {away}));
    ASSERT_EQ(car->coupled().size(), 1U);
    EXPECT_LT(cost_m2(*car, of_steps(8)), cost_m2(*stays, of_steps(8)) - 1e-3) << int{other};
  }
}

TEST(LookAheadRollout, EndsWithoutACostWhenItsExpansionsDoNotSuffice) {
  DrivenController car;
  static_cast<void>(car.step());
  LookAheadRolloutSettings settings = of_steps(4);
  EXPECT_TRUE(rollout_cost_m2(*car, settings, kStays));
  settings.most_expansions = 3;
  EXPECT_FALSE(rollout_cost_m2(*car, settings, kStays));
}

}  // namespace
}  // namespace hlc::policy::look_ahead_rollout_test
