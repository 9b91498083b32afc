#include "planner/controller/controller.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/automaton/requested_subgraph.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller {
namespace {

using namespace east_bound;

using testing::ElementsAre;
using testing::IsEmpty;

/// One step of a controller that is alone or receives what is given; returns its report.
coordination::Report step(Controller& one, const Observation& observation,
                          const std::vector<coordination::Traffic>& traffic = {},
                          const std::vector<coordination::Prediction>& predictions = {},
                          const std::vector<coordination::Outcome>& outcomes = {}) {
  static_cast<void>(one.observe(observation));
  one.couple(traffic);
  static_cast<void>(one.plan(predictions));
  return one.commit(predictions, outcomes);
}

TEST(Controller, BeforeTheStartItStandsWhereItIsSeen) {
  const auto one = controller(1);
  EXPECT_FALSE(one->has_plan());
  EXPECT_EQ(one->stand_by(at(99, {})).status, coordination::StepStatus::kStandby);
  EXPECT_FALSE(one->has_plan());
  const coordination::Report report = one->stand_by(at(100, {seen(1, 0.5, 0.1)}));
  ASSERT_TRUE(one->has_plan());
  EXPECT_NEAR(report.planned_pose.x_m, 0.5, 1e-12);
  EXPECT_NEAR(report.planned_pose.heading_rad, 0.0, 1e-12) << "the yaw is mapped to a heading";
  EXPECT_EQ(one->plan_in_force().end(), StepIndex{100});
}

TEST(Controller, AloneItDrivesAlongItsPathAndEveryPlanEndsStanding) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  for (std::uint64_t k = 101; k < 121; ++k) {
    const coordination::Report report = step(*one, at(k, {following(*one, k)}));
    ASSERT_EQ(report.status, coordination::StepStatus::kPlanned) << k;
    EXPECT_LE(one->plan_in_force().end().value, k + 1 + one->options().horizon_steps);
    EXPECT_TRUE(automaton::paper_automaton()
                    ->trims[one->plan_in_force().trim_at(one->plan_in_force().end()).index]
                    .is_equilibrium());
  }
  const Pose& pose = one->plan_in_force().pose_at({121});
  EXPECT_GT(pose.x_m, 2.5);
  EXPECT_NEAR(pose.y_m, 0.0, 1e-9);
}

TEST(Controller, TheProblemsContouringIsTheNormalOfThePathTimesTheRootOfTheWeight) {
  Controller one(ControllerOptions{.vehicle = {1}, .contouring_weight = 9.0}, subgraph(),
                 road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), road::Corridor{});
  static_cast<void>(one.stand_by(at(100, {seen(1, 0.0, 0.0)})));
  static_cast<void>(step(one, at(101, {following(one, 101)})));
  ASSERT_EQ(one.problems().size(), 1U);
  const search::HorizonProblem& problem = one.problems().front().problem;
  ASSERT_EQ(problem.contouring.size(), problem.horizon_steps());
  for (const Point& c : problem.contouring) EXPECT_LT((c - Point(0.0, 3.0)).norm(), 1e-12);
}

TEST(Controller, TheRestOfThePlanInForceIsTheIncumbent) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  for (std::uint64_t k = 101; k < 111; ++k) {
    std::vector<const automaton::Maneuver*> rest;
    for (std::size_t j = 1; j <= one->options().horizon_steps; ++j) {
      rest.push_back(&one->plan_in_force().maneuver_during({k + j}));
    }
    static_cast<void>(step(*one, at(k, {following(*one, k)})));
    ASSERT_EQ(one->problems().size(), 1U);
    const search::HorizonProblem& problem = one->problems().front().problem;
    EXPECT_EQ(problem.incumbent, rest) << k;
    EXPECT_EQ(problem.incumbent.front()->from, problem.start_trim);
    EXPECT_EQ(problem.incumbent.back()->to, one->subgraph().standstill());
  }
}

TEST(Controller, ThereIsNoIncumbentWhereThePlanIsMovedOntoTheVehicle) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  static_cast<void>(step(*one, at(101, {following(*one, 101)})));
  coordination::MeasuredVehicle beside = following(*one, 102);
  beside.pose.y_m += 0.008;  // within the margin, farther than half of it
  static_cast<void>(step(*one, at(102, {beside})));
  ASSERT_FALSE(one->problems().empty());
  EXPECT_TRUE(one->problems().front().problem.incumbent.empty());
}

// Nor after a switch, when the vehicle may drive with a trim that is disabled now.
TEST(Controller, WarmingUpChangesNothing) {
  const auto cold = controller(1);
  const auto warm = controller(1);
  const auto slower = automaton::requested_subgraph(cold->subgraph(), {.max_speed_mps = 0.4},
                                                    cold->options().horizon_steps);
  for (const auto& one : {cold.get(), warm.get()}) {
    static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  }
  for (std::uint64_t k = 101; k < 121; ++k) {
    if (k == 111) cold->switch_to(slower);
    if (k == 111) warm->switch_to(slower);
    const coordination::Report expected = step(*cold, at(k, {following(*cold, k)}));
    static_cast<void>(warm->observe(at(k, {following(*warm, k)})));
    const std::uint64_t expanded = warm->warm_up();
    const bool has_way_out = k < 111;
    EXPECT_GE(expanded, has_way_out ? warm->options().horizon_steps : 0U) << k;
    EXPECT_TRUE(warm->problems().empty());
    warm->couple({});
    static_cast<void>(warm->plan({}));
    const coordination::Report report = warm->commit({}, {});
    EXPECT_EQ(report.status, expected.status) << k;
    EXPECT_EQ(report.cost_m2, expected.cost_m2) << k;
    EXPECT_EQ(report.generated, expected.generated) << k;
    EXPECT_EQ(report.expanded, expected.expanded) << k;
    EXPECT_EQ(warm->plan_in_force().pose_at({k + 9}), cold->plan_in_force().pose_at({k + 9})) << k;
  }
}

TEST(Controller, WarmingUpEndsWhereASearchIsLong) {
  ControllerOptions options{.vehicle = {1}, .horizon_steps = 12};
  options.search = {.engine = search::Engine::kBestFirst,
                    .cost_to_go = search::CostToGo::kStraightLine};
  // The way the car does not point: it has to turn.
  Controller one(options, subgraph(),
                 road::ReferencePath({Point(10.0, 0.0), Point(-10.0, 0.0)}, false),
                 road::Corridor{});
  static_cast<void>(one.stand_by(at(100, {seen(1, 0.0, 0.0)})));
  EXPECT_GT(step(one, at(101, {following(one, 101)})).expanded, 2000U);
  static_cast<void>(one.observe(at(102, {following(one, 102)})));
  EXPECT_EQ(one.warm_up(), 1024U);
}

TEST(Controller, WithoutAnIncumbentTheSearchKnowsNoPlan) {
  const ControllerOptions options{.vehicle = {1}, .strategies = {.incumbent = &no_incumbent}};
  Controller one(options, subgraph(),
                 road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), road::Corridor{});
  static_cast<void>(one.stand_by(at(100, {seen(1, 0.0, 0.0)})));
  static_cast<void>(step(one, at(101, {following(one, 101)})));
  ASSERT_EQ(one.problems().size(), 1U);
  EXPECT_TRUE(one.problems().front().problem.incumbent.empty());
}

TEST(Controller, ReportsHowGoodThePlanIs) {
  const auto one = controller(1);
  EXPECT_EQ(one->stand_by(at(100, {seen(1, 0.0, 0.0)})).quality, coordination::PlanQuality::kNone);
  const coordination::Report report = step(*one, at(101, {following(*one, 101)}));
  EXPECT_EQ(report.quality, coordination::PlanQuality::kOptimal);
  EXPECT_EQ(report.gap_m2, 0.0);
}

TEST(Controller, TheReachableAreaHoldsThePlansOfTheStep) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  for (std::uint64_t k = 101; k < 111; ++k) {
    const coordination::Traffic traffic = one->observe(at(k, {following(*one, k)}));
    one->couple({});
    const coordination::Prediction prediction = one->plan({});
    for (const coordination::OccupiedAreas* areas : {&traffic.running, &prediction.areas}) {
      for (const ConvexPolygon& area : areas->areas_m) {
        for (const Point& corner : area.vertices_m) {
          ASSERT_TRUE(contains(traffic.reachable_area_m, corner, 1e-9)) << k;
        }
      }
    }
    static_cast<void>(one->commit({}, {}));
  }
}

// Two cars, one behind the other: 2 stands in the way of 1.
class TwoCars : public testing::Test {
 protected:
  TwoCars() : first_(controller(1)), second_(controller(2)) {
    static_cast<void>(first_->stand_by(at(100, states_)));
    static_cast<void>(second_->stand_by(at(100, states_)));
  }
  std::vector<coordination::MeasuredVehicle> states_{seen(1, 0.0, 0.0), seen(2, 0.9, 0.0)};
  std::unique_ptr<Controller> first_;
  std::unique_ptr<Controller> second_;
};

TEST_F(TwoCars, TheSmallerIdHasNoPredecessorAndTheOtherHasOne) {
  const coordination::Traffic t1 = first_->observe(at(101, states_));
  const coordination::Traffic t2 = second_->observe(at(101, states_));
  first_->couple(std::vector{t2});
  second_->couple(std::vector{t1});
  EXPECT_THAT(first_->predecessors(), IsEmpty());
  EXPECT_THAT(first_->coupled(), ElementsAre(VehicleId{2}));
  EXPECT_THAT(second_->predecessors(), ElementsAre(VehicleId{1}));
}

// The path of car 2 leads away from where the silent car 1 can be; standing where it is would be in
// its reach.
TEST_F(TwoCars, ASilentPredecessorIsMissingNotAbsent) {
  const coordination::Traffic t1 = first_->observe(at(101, states_));
  static_cast<void>(second_->observe(at(101, states_)));
  second_->couple(std::vector{t1});
  const coordination::Prediction prediction =
      second_->plan({});  // its predecessor's plan not received
  ASSERT_FALSE(second_->problems().empty());
  for (const std::vector<ConvexPolygon>& areas : second_->problems().back().problem.obstacles_m) {
    EXPECT_THAT(areas, testing::Contains(t1.reachable_area_m));
  }
  EXPECT_FALSE(prediction.is_new &&
               !coordination::are_free(prediction.areas, t1.reachable_area_m, {102}, 8));
}

TEST_F(TwoCars, AVehicleThatSaysNothingAtAllIsListedAndKeptAwayFrom) {
  static_cast<void>(second_->observe(at(101, states_)));
  second_->couple({});
  static_cast<void>(second_->plan({}));
  ASSERT_FALSE(second_->problems().empty());
  // Car 1 may be 0.8 m/s fast on any way; where it may be grows with time.
  for (std::size_t j = 1; j <= 8; ++j) {
    const double way_m = 0.8 * 0.2 * static_cast<double>(j + 1);
    const Point anywhere =
        states_[0].pose.position_m() + way_m * Point(std::cos(2.0), std::sin(2.0));
    EXPECT_TRUE(
        std::ranges::any_of(second_->problems().back().problem.obstacles_m[j - 1],
                            [&](const ConvexPolygon& area) { return contains(area, anywhere); }))
        << j;
  }
  EXPECT_THAT(second_->commit({}, {}).missing, ElementsAre(VehicleId{1}));
}

TEST_F(TwoCars, WithoutAStateOfASilentVehicleNothingNewIsPlanned) {
  Observation observation = at(101, {seen(2, 0.9, 0.0)});
  observation.active = {VehicleId{1}, VehicleId{2}};
  const coordination::Report report = step(*second_, observation);
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoCars, UnderTheStrictRuleASuccessorsPredictionIsNeeded) {
  const coordination::Traffic t2 = second_->observe(at(101, states_));
  static_cast<void>(first_->observe(at(101, states_)));
  first_->couple(std::vector{t2});
  ASSERT_TRUE(first_->plan({}).is_new);
  const coordination::Report report = first_->commit({}, {});  // the prediction of 2 is lost
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoCars, AConflictingPredictionKeepsTheRunningPlan) {
  const coordination::Traffic t2 = second_->observe(at(101, states_));
  static_cast<void>(first_->observe(at(101, states_)));
  first_->couple(std::vector{t2});
  const coordination::Prediction own = first_->plan({});
  ASSERT_TRUE(own.is_new);
  coordination::Prediction other{.vehicle = {2}, .step = {101}, .is_new = true, .areas = own.areas};
  const coordination::Report report = first_->commit(std::vector{other}, {});
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kConflict);
  EXPECT_EQ(first_->plan_in_force().end(), StepIndex{100});
}

TEST_F(TwoCars, MessagesOfAnotherStepAreNotTakenForThisOne) {
  coordination::Traffic old = second_->observe(at(101, states_));
  static_cast<void>(first_->observe(at(102, states_)));
  first_->couple(std::vector{old});
  EXPECT_THAT(first_->coupled(), IsEmpty());
  static_cast<void>(first_->plan({}));
  EXPECT_THAT(first_->commit({}, {}).missing, ElementsAre(VehicleId{2}));
}

TEST_F(TwoCars, WhoIsNotHeardByItsNeighbourAgreesToNothingNew) {
  coordination::Traffic t2 = second_->observe(at(101, states_));
  t2.silent = {VehicleId{1}};
  const coordination::Report report = step(*first_, at(101, states_), {t2});
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoCars, ASilentVehicleThatStandsForGoodIsDrivenAround) {
  // Beside the path of car 1, so that there is room to pass; silent from the beginning.
  states_[1] = seen(2, 0.9, 0.35);
  coordination::Report report;
  for (std::uint64_t k = 101; k < 140; ++k) {
    states_[0] = following(*first_, k);
    report = step(*first_, at(k, states_));
  }
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_GT(report.planned_pose.x_m, 1.5) << "it has passed the standing vehicle";
}

TEST(Controller, UnderTheAgreedRuleOneFallbackInTheComponentIsEverybodys) {
  const std::vector<coordination::MeasuredVehicle> states{seen(1, 0.0, 0.0), seen(2, 0.9, 0.0)};
  for (const bool other_falls_back : {false, true}) {
    const auto one = controller(1, 0.0, kAgreed);
    const auto other = controller(2, 0.0, kAgreed);
    static_cast<void>(one->stand_by(at(100, states)));
    static_cast<void>(other->stand_by(at(100, states)));
    const coordination::Traffic t2 = other->observe(at(101, states));
    static_cast<void>(one->observe(at(101, states)));
    one->couple(std::vector{t2});
    ASSERT_TRUE(one->plan({}).is_new);
    EXPECT_FALSE(one->vote().wants_fallback);
    const coordination::Outcome outcome{
        .vehicle = {2}, .step = {101}, .wants_fallback = other_falls_back};
    const coordination::Report report = one->commit({}, std::vector{outcome});
    EXPECT_EQ(report.status, other_falls_back ? coordination::StepStatus::kFallback
                                              : coordination::StepStatus::kPlanned);
  }
}

TEST(Controller, UnderTheAgreedRuleAMissingOutcomeIsAFallback) {
  const std::vector<coordination::MeasuredVehicle> states{seen(1, 0.0, 0.0), seen(2, 0.9, 0.0)};
  const auto one = controller(1, 0.0, kAgreed);
  const auto other = controller(2, 0.0, kAgreed);
  static_cast<void>(one->stand_by(at(100, states)));
  static_cast<void>(other->stand_by(at(100, states)));
  const coordination::Report report =
      step(*one, at(101, states), {other->observe(at(101, states))});
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kNeighbour);
}

class Deviation : public testing::Test {
 protected:
  /// A car in the middle of its drive.
  Deviation() {
    static_cast<void>(one_->stand_by(at(100, {seen(1, 0.0, 0.0)})));
    for (std::uint64_t k = 101; k < 106; ++k) {
      static_cast<void>(step(*one_, at(k, {following(*one_, k)})));
    }
  }
  std::unique_ptr<Controller> one_{controller(1)};
};

TEST_F(Deviation, OfLessThanHalfTheMarginIsReportedOnly) {
  coordination::MeasuredVehicle off = following(*one_, 106);
  off.pose.y_m += 0.004;
  const double planned_y_m = one_->plan_in_force().pose_at({107}).y_m;
  const coordination::Traffic traffic = one_->observe(at(106, {off}));
  EXPECT_NEAR(traffic.next_pose.y_m, planned_y_m, 1e-12);
  one_->couple({});
  static_cast<void>(one_->plan({}));
  const coordination::Report report = one_->commit({}, {});
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_NEAR(report.deviation_m, 0.004, 1e-9);
}

TEST_F(Deviation, OfMoreThanHalfTheMarginLetsTheNextPlanStartWhereTheVehicleIs) {
  coordination::MeasuredVehicle off = following(*one_, 106);
  off.pose.y_m += 0.008;
  const coordination::Report report = step(*one_, at(106, {off}));
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_NEAR(report.planned_pose.y_m, 0.0, 1e-9)
      << "what was announced of the step under way stays";
  EXPECT_NEAR(one_->plan_in_force().pose_at({107}).y_m, 0.008, 1e-9);
  coordination::MeasuredVehicle then = following(*one_, 107);
  EXPECT_NEAR(step(*one_, at(107, {then})).deviation_m, 0.0, 1e-9);
}

TEST_F(Deviation, OfTheHeadingCountsLikeThatOfThePosition) {
  // 10 mm of margin at half the length, 110 mm, are 0.09 rad.
  for (const double turn_rad : {-0.12, -0.08, 0.08, 0.12}) {
    coordination::MeasuredVehicle off = following(*one_, 106);
    off.pose.heading_rad += turn_rad;
    const auto one = std::make_unique<Controller>(*one_);
    const coordination::Report report = step(*one, at(106, {off}));
    const bool is_far = std::abs(turn_rad) > 0.1;
    EXPECT_EQ(report.reason, is_far ? coordination::FallbackReason::kDeviation
                                    : coordination::FallbackReason::kNone)
        << turn_rad;
    EXPECT_EQ(report.deviation_m > automaton::paper_automaton()->vehicle.safety_margin_m, is_far);
  }
}

TEST_F(Deviation, BeyondTheBoundItsTrafficTellsWhereTheVehicleReallyCanBe) {
  coordination::MeasuredVehicle off = following(*one_, 106);
  off.pose.y_m += 0.1;
  const coordination::OccupiedAreas planned = one_->plan_in_force().areas_from({106});
  const coordination::Traffic traffic = one_->observe(at(106, {off}));
  one_->couple({});
  const coordination::Prediction prediction = one_->plan({});
  const vehicle::VehicleParameters& vehicle = automaton::paper_automaton()->vehicle;
  const ConvexPolygon seen_area =
      footprint_area(vehicle.footprint, off.pose, vehicle.safety_margin_m);
  const auto holds = [](const ConvexPolygon& area, const ConvexPolygon& other) {
    return std::ranges::all_of(
        other.vertices_m, [&area](const Point& vertex) { return contains(area, vertex, 1e-9); });
  };
  ASSERT_GE(planned.areas_m.size(), 2U);
  for (std::uint64_t k = 106; k < 120; ++k) {
    ConvexPolygon beside = planned.during({k});
    for (Point& vertex : beside.vertices_m) vertex.y() += 0.1;
    for (const coordination::OccupiedAreas* announced : {&traffic.running, &prediction.areas}) {
      if (k < announced->first.value) continue;
      EXPECT_TRUE(holds(announced->during({k}), planned.during({k}))) << k;
      EXPECT_TRUE(holds(announced->during({k}), beside)) << k;
      EXPECT_TRUE(holds(announced->during({k}), seen_area)) << k;
      EXPECT_TRUE(holds(traffic.reachable_area_m, announced->during({k}))) << k;
    }
  }
}

TEST_F(Deviation, BeyondTheBoundThePlanIsDrivenToItsEndAndAnchoredAnew) {
  const coordination::Plan before = one_->plan_in_force();
  for (std::uint64_t k = 106; k <= before.end().value; ++k) {
    coordination::MeasuredVehicle off = following(*one_, k);
    off.pose.y_m += 0.1;
    off.speed_mps = k == before.end().value ? 0.0 : 0.5;
    const coordination::Report report = step(*one_, at(k, {off}));
    if (k < before.end().value) {
      ASSERT_EQ(report.status, coordination::StepStatus::kFallback) << k;
      ASSERT_EQ(report.reason, coordination::FallbackReason::kDeviation) << k;
    } else {
      EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
      EXPECT_NEAR(report.planned_pose.y_m, off.pose.y_m, 1e-9);
    }
  }
}

TEST_F(Deviation, TheMeasurementIsComparedWithThePlanOfItsOwnTime) {
  // Seen 60 ms before t(k), where the plan was then.
  const vehicle::State then =
      one_->plan_in_force().state_at({105}, 0.14, automaton::paper_automaton()->vehicle);
  coordination::MeasuredVehicle old = seen(1, then.pose.x_m, then.pose.y_m, then.speed_mps);
  old.age_s = 0.06;
  EXPECT_NEAR(step(*one_, at(106, {old})).deviation_m, 0.0, 1e-9);
}

bool holds_all(const coordination::OccupiedAreas& announced,
               const coordination::OccupiedAreas& areas, std::uint64_t from) {
  for (std::uint64_t k = from; k < from + 12; ++k) {
    if (!contains(announced.during({k}), areas.during({k}), 1e-9)) return false;
  }
  return true;
}

TEST_F(Deviation, OfACarThatIsNotSeenEveryPlanIsAnnouncedThatItMayStillDrive) {
  const coordination::OccupiedAreas before = one_->plan_in_force().areas_from({106});
  static_cast<void>(step(*one_, at(106, {following(*one_, 106)})));
  const coordination::OccupiedAreas last = one_->plan_in_force().areas_from({107});
  Observation unseen = at(107, {});
  unseen.active = {{1}};
  const coordination::Traffic traffic = one_->observe(unseen);
  EXPECT_TRUE(one_->is_vehicle_lost());
  EXPECT_TRUE(holds_all(traffic.running, before, 107)) << "its last command may have been lost";
  EXPECT_TRUE(holds_all(traffic.running, last, 107));
  // It may have stopped where it was seen, or anywhere on its way since.
  EXPECT_TRUE(contains(traffic.running.during({112}), before.during({106}), 1e-9));
  EXPECT_TRUE(contains(traffic.running.final_area_m, before.during({108}), 1e-9));
}

TEST_F(Deviation, SeenAgainOnAnOlderPlanThatOneIsInForceAgain) {
  const coordination::Plan older = one_->plan_in_force();
  static_cast<void>(step(*one_, at(106, {following(*one_, 106)})));
  const coordination::Plan newer = one_->plan_in_force();
  ASSERT_NE(older.pose_at(older.end()), newer.pose_at(newer.end()));
  for (std::uint64_t k = 107; k < 120; ++k) {
    Observation unseen = at(k, {});
    unseen.active = {{1}};
    EXPECT_EQ(step(*one_, unseen).reason, coordination::FallbackReason::kDeviation);
    EXPECT_TRUE(one_->is_vehicle_lost());
  }
  const Pose stood = older.pose_at(older.end());
  const coordination::Report report = step(*one_, at(120, {seen(1, stood.x_m, stood.y_m)}));
  EXPECT_FALSE(one_->is_vehicle_lost());
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_EQ(report.planned_pose, stood);
}

TEST_F(Deviation, SeenOnNoPlanItIsLostUntilItStands) {
  const coordination::Plan plan = one_->plan_in_force();
  for (std::uint64_t k = 106; k < plan.end().value + 3; ++k) {
    Observation unseen = at(k, {});
    unseen.active = {{1}};
    static_cast<void>(step(*one_, unseen));
  }
  const Pose end = plan.pose_at(plan.end());
  const std::uint64_t k = plan.end().value + 3;
  EXPECT_EQ(step(*one_, at(k, {seen(1, end.x_m, end.y_m + 0.1, 0.3)})).reason,
            coordination::FallbackReason::kDeviation);
  EXPECT_TRUE(one_->is_vehicle_lost());
  const coordination::Report report = step(*one_, at(k + 1, {seen(1, end.x_m, end.y_m + 0.1)}));
  EXPECT_FALSE(one_->is_vehicle_lost());
  EXPECT_NEAR(report.planned_pose.y_m, end.y_m + 0.1, 1e-9);
}

TEST_F(Deviation, FartherThanTheStopBoundItIsElsewhereUntilItStandsAndPlansOnFromThere) {
  const StepIndex end = one_->plan_in_force().end();
  for (std::uint64_t k = 106; k <= end.value + 3; ++k) {
    for (const double off_m : {0.9, 1.1}) {
      coordination::MeasuredVehicle car = following(*one_, k);
      car.pose.y_m += off_m * vehicle::kStopBound_m;
      car.speed_mps = 0.5;
      const auto other = std::make_unique<Controller>(*one_);
      EXPECT_EQ(step(*other, at(k, {car})).reason, coordination::FallbackReason::kDeviation);
      EXPECT_EQ(other->is_vehicle_elsewhere(), off_m > 1.0) << k;
      if (off_m > 1.0) *one_ = *other;
    }
  }
  const coordination::MeasuredVehicle moved = seen(1, 4.0, 0.05);
  const coordination::Report report = step(*one_, at(end.value + 4, {moved}));
  EXPECT_FALSE(one_->is_vehicle_elsewhere());
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_NEAR(report.planned_pose.x_m, 4.0, 1e-9);
  EXPECT_GT(one_->plan_in_force().pose_at(one_->plan_in_force().end()).x_m, 4.2);
  EXPECT_GT(one_->path_s_m(), 3.9);
}

TEST(Controller, DrivingOutPlansNothingNewUntilItEnds) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  static_cast<void>(step(*one, at(101, {seen(1, 0.0, 0.0)})));
  const StepIndex end = one->plan_in_force().end();
  one->set_minimal_risk_stop(true);
  for (std::uint64_t k = 102; k < 112; ++k) {
    const coordination::Report report = step(*one, at(k, {following(*one, k)}));
    EXPECT_EQ(report.status, coordination::StepStatus::kMinimalRiskStop);
    EXPECT_EQ(one->plan_in_force().end(), end);
  }
  one->set_minimal_risk_stop(false);
  EXPECT_EQ(step(*one, at(112, {following(*one, 112)})).status, coordination::StepStatus::kPlanned);
  EXPECT_GT(one->plan_in_force().end(), StepIndex{112});
}

TEST(Controller, ACloneGoesItsOwnWay) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  const auto other = std::make_unique<Controller>(*one);
  static_cast<void>(step(*other, at(101, {seen(1, 0.0, 0.0)})));
  EXPECT_EQ(one->plan_in_force().end(), StepIndex{100});
  EXPECT_GT(other->plan_in_force().end(), StepIndex{100});
}

}  // namespace
}  // namespace hlc::controller
