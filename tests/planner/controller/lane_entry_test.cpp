#include "planner/controller/lane_entry.hpp"

#include <gtest/gtest.h>

#include "planner/controller/controller.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::controller {
namespace {

/// A lane along x, 0.15 m wide until x = `narrow_from_m`, then too narrow for a car.
road::DrivableRoute lane(double narrow_from_m) {
  std::vector<road::Corridor::Bound> bounds;
  for (const road::Side side : {road::Side::kLeft, road::Side::kRight}) {
    const double sign = side == road::Side::kLeft ? 1.0 : -1.0;
    road::Corridor::Bound bound{.side = side, .points_m = {}, .s_m = {}};
    for (double s_m = 0.0; s_m <= 10.0; s_m += 0.1) {
      bound.points_m.emplace_back(s_m, sign * (s_m < narrow_from_m ? 0.075 : 0.02));
      bound.s_m.push_back(s_m);
    }
    bounds.push_back(std::move(bound));
  }
  const Box ground{.min_m = {0.0, -1.0}, .max_m = {10.0, 1.0}};
  return {.name = "lane",
          .path = road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false),
          .corridor = road::Corridor(std::move(bounds), 0.0, ground)};
}

/// A car alone, which follows perfectly from where it was put.
class Car {
 public:
  Car(road::DrivableRoute route, const Pose& start, const search::SearchOptions& search = {})
      : controller_(
            {.vehicle = {1}, .search = search},
            std::make_shared<const automaton::Subgraph>(
                automaton::paper_automaton(), automaton::paper_configuration().subgraphs.front()),
            std::vector{std::move(route)}) {
    static_cast<void>(controller_.stand_by(seen(start, 0.0)));
  }

  coordination::Report step() {
    const vehicle::State state =
        controller_.plan_in_force().state_at({k_ + 1}, 0.0, automaton::paper_automaton()->vehicle);
    ++k_;
    static_cast<void>(controller_.observe(seen(state.pose, state.steering_rad)));
    controller_.couple({});
    static_cast<void>(controller_.plan({}));
    return controller_.commit({}, {});
  }

  [[nodiscard]] const Controller& controller() const { return controller_; }
  [[nodiscard]] StepIndex now() const { return {k_}; }
  [[nodiscard]] Pose pose() const { return controller_.plan_in_force().pose_at({k_}); }

 private:
  [[nodiscard]] Observation seen(Pose pose, double steering_rad) const {
    pose.heading_rad +=
        automaton::yaw_minus_heading_rad(steering_rad, automaton::paper_automaton()->vehicle,
                                         automaton::paper_automaton()->identified);
    return {
        .step = {k_}, .active = {{1}}, .states = {{.vehicle = {1}, .pose = pose}}, .present = {}};
  }

  std::uint64_t k_{100};
  Controller controller_;
};

TEST(LaneEntryTest, ACarBesideItsLaneHasAWiderAreaUntilItIsInIt) {
  Car car(lane(99.0), {1.0, 0.10, 0.2});
  EXPECT_EQ(car.step().status, coordination::StepStatus::kPlanned);
  ASSERT_TRUE(car.controller().entry_area());
  const road::Corridor area = *car.controller().entry_area();
  EXPECT_EQ(area.pieces().size(), car.controller().route().corridor.pieces().size());
  int steps = 1;
  for (; car.controller().entry_area() && steps < 30; ++steps) {
    const coordination::Plan& plan = car.controller().plan_in_force();
    EXPECT_TRUE(keeps_to(plan, car.now(), area.boundary_m(0.0, 10.0)));
    EXPECT_EQ(car.step().status, coordination::StepStatus::kPlanned);
  }
  EXPECT_LT(steps, 12);
  for (; steps < 30; ++steps) EXPECT_EQ(car.step().status, coordination::StepStatus::kPlanned);
  EXPECT_GT(car.pose().x_m, 3.0);
  EXPECT_LT(std::abs(car.pose().y_m), 0.02);
}

// It crosses no bound there, and could drive along the lane forever without crossing one.
TEST(LaneEntryTest, ACarWhollyBesideItsLaneDrivesIntoIt) {
  Car car(lane(99.0), {1.0, 0.17, 0.0});
  for (int i = 0; i < 25; ++i) EXPECT_EQ(car.step().status, coordination::StepStatus::kPlanned);
  EXPECT_GT(car.pose().x_m, 3.0);
  EXPECT_LT(std::abs(car.pose().y_m), 0.02);
}

TEST(LaneEntryTest, ACarInItsLaneNeedsNoOtherArea) {
  Car car(lane(99.0), {1.0, 0.01, 0.02});
  EXPECT_EQ(car.step().status, coordination::StepStatus::kPlanned);
  EXPECT_FALSE(car.controller().entry_area());
}

TEST(LaneEntryTest, ACarThatCannotGetIntoItsLanesStandsAndSaysSo) {
  Car car(lane(1.2), {1.0, 0.05, 0.0});
  for (int i = 0; i < 5; ++i) {
    const coordination::Report report = car.step();
    EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
    EXPECT_EQ(report.reason, coordination::FallbackReason::kOffRoute);
  }
  EXPECT_EQ(car.pose().x_m, 1.0);
}

TEST(LaneEntryTest, ASearchThatUsedUpItsBudgetDoesNotSayThatThereIsNoWay) {
  for (const search::Engine engine :
       {search::Engine::kBranchAndBound, search::Engine::kBestFirst}) {
    const search::SearchOptions search{.engine = engine, .max_expansions = 5};
    Car in_lane(lane(99.0), {1.0, 0.0, 0.0}, search);
    Car beside(lane(99.0), {1.0, 0.1, 0.0}, search);
    for (int i = 0; i < 3; ++i) {
      const coordination::Report standing = in_lane.step();  // a plan, too
      EXPECT_EQ(standing.status, coordination::StepStatus::kPlanned);
      EXPECT_EQ(standing.quality, coordination::PlanQuality::kBudget);
      const coordination::Report report = beside.step();
      EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
      EXPECT_EQ(report.reason, coordination::FallbackReason::kBudget);
    }
  }
}

TEST(LaneEntryTest, TheProblemsByWhichACarSetsOutAreTold) {
  Car beside(lane(99.0), {1.0, 0.10, 0.2});
  beside.step();
  EXPECT_GE(beside.controller().entry_problems().size(), 1U);
  EXPECT_FALSE(beside.controller().entry_problems().front().boundary_m.empty());
  EXPECT_EQ(beside.controller().problems().size(), 1U);
  beside.step();
  EXPECT_TRUE(beside.controller().entry_problems().empty());
}

TEST(LaneEntryTest, ACarWhoseLaneNarrowsBeforeItDrivesAsFarAsItIsWide) {
  Car car(lane(2.5), {1.0, 0.05, 0.1});
  for (int i = 0; i < 30; ++i) {
    EXPECT_NE(car.step().reason, coordination::FallbackReason::kOffRoute);
  }
  EXPECT_GT(car.pose().x_m, 1.5);
  EXPECT_LT(car.pose().x_m, 2.4);
}

}  // namespace
}  // namespace hlc::controller
