#include "planner/controller/waits_for.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controller/self_loop.hpp"
#include "tests/planner/controller/blocked_road.hpp"

namespace hlc::controller::waits_for_test {
namespace {

using namespace east_bound;
using coordination::FallbackReason;
using coordination::StepStatus;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kHorizon = 8;

coordination::Plan standing() {
  const automaton::UniversalAutomaton& automaton = subgraph()->automaton();
  return {{kNow}, {}, self_loop(automaton, subgraph()->standstill())};
}

/// What car 1 plans when nobody is near: 1.3 m to the east.
const coordination::Plan& eastwards() {
  static const coordination::Plan kPlan = [] {
    const auto one = controller(1);
    static_cast<void>(one->stand_by(at(kNow - 1, {seen(1, 0.0, 0.0)})));
    static_cast<void>(one->observe(at(kNow, {seen(1, 0.0, 0.0)})));
    one->couple({});
    static_cast<void>(one->plan({}));
    static_cast<void>(one->commit({}, {}));
    return one->plan_in_force();
  }();
  return kPlan;
}

OtherVehicle across(std::uint8_t vehicle, double x_m) {
  return {.vehicle = {vehicle},
          .areas_m = std::vector<std::vector<ConvexPolygon>>(kHorizon, {wall(x_m)})};
}

OtherVehicle preventing(std::uint8_t vehicle) {
  return {.vehicle = {vehicle}, .is_out_of_contact = true};
}

/// Car 1 stands; alone it would drive east.
class WaitsFor : public testing::Test {
 protected:
  std::vector<VehicleId> vehicles() {
    return waits_for({.report = report_,
                      .in_force = in_force_,
                      .horizon_steps = kHorizon,
                      .is_disturbed = is_disturbed_,
                      .alone = [this]() -> std::optional<MotionAlone> {
                        ++searches_;
                        if (!alone_) return std::nullopt;
                        return MotionAlone{.plan = *alone_,
                                           .areas = alone_->areas_from({kNow + 1})};
                      },
                      .others = [this] { return others_; }});
  }

  coordination::Report report_{.vehicle = {1}, .step = {kNow}, .status = StepStatus::kPlanned};
  coordination::Plan in_force_{standing()};
  std::optional<coordination::Plan> alone_{eastwards()};
  std::vector<OtherVehicle> others_{across(2, 0.6)};
  bool is_disturbed_{};
  int searches_{};
};

TEST_F(WaitsFor, TheOneInItsWay) { EXPECT_THAT(vehicles(), ElementsAre(VehicleId{2})); }

TEST_F(WaitsFor, AllInItsWayTheFirstToBeMetFirst) {
  others_ = {across(2, 0.9), across(3, 0.3), across(4, -2.0), across(5, 0.9)};
  EXPECT_THAT(vehicles(), ElementsAre(VehicleId{3}, VehicleId{2}, VehicleId{5}));
}

TEST_F(WaitsFor, OneThatPreventsAnyMotionBeforeOneInTheWay) {
  others_ = {across(2, 0.6), preventing(3)};
  EXPECT_THAT(vehicles(), ElementsAre(VehicleId{3}, VehicleId{2}));
}

TEST_F(WaitsFor, OneThatIsInTheWayOnlyLater) {
  others_.front().areas_m.assign(kHorizon, {});
  others_.front().areas_m.back() = {wall(eastwards().pose_at(eastwards().end()).x_m)};
  EXPECT_THAT(vehicles(), ElementsAre(VehicleId{2}));
  others_.front().areas_m.back().clear();
  EXPECT_THAT(vehicles(), IsEmpty());
}

TEST_F(WaitsFor, NobodyWhereItDrives) {
  in_force_ = eastwards();
  EXPECT_THAT(vehicles(), IsEmpty());
  EXPECT_EQ(searches_, 0) << "a vehicle that drives costs no search";
}

// It brakes yet.
TEST_F(WaitsFor, NobodyBeforeItStands) {
  in_force_ = eastwards();
  report_.step = {in_force_.end().value - 1};
  ASSERT_NE(in_force_.pose_at(report_.step), in_force_.pose_at(in_force_.end()));
  EXPECT_THAT(vehicles(), IsEmpty());
}

TEST_F(WaitsFor, NobodyWhereItWouldStandAnyway) {
  alone_ = standing();
  others_ = {across(2, 0.0), preventing(3)};
  EXPECT_THAT(vehicles(), IsEmpty());
  EXPECT_EQ(searches_, 1);
}

TEST_F(WaitsFor, NobodyIfItIsDisturbed) {
  is_disturbed_ = true;
  EXPECT_THAT(vehicles(), IsEmpty());
  EXPECT_EQ(searches_, 0);
}

TEST_F(WaitsFor, NobodyWhereNoPlanIsFeasibleAlone) {
  alone_.reset();
  EXPECT_THAT(vehicles(), IsEmpty());
}

TEST_F(WaitsFor, NobodyIfTheReasonIsItsOwn) {
  using enum FallbackReason;
  report_.status = StepStatus::kFallback;
  for (const FallbackReason reason : {kInfeasible, kMissing, kConflict, kNeighbour}) {
    report_.reason = reason;
    EXPECT_THAT(vehicles(), ElementsAre(VehicleId{2})) << to_string(reason);
  }
  for (const FallbackReason reason : {kBudget, kDeviation, kLate, kUndrivable, kOffRoute}) {
    report_.reason = reason;
    EXPECT_THAT(vehicles(), IsEmpty()) << to_string(reason);
  }
  report_.reason = kNone;
  for (const StepStatus status : {StepStatus::kStandby, StepStatus::kMinimalRiskStop}) {
    report_.status = status;
    EXPECT_THAT(vehicles(), IsEmpty()) << to_string(status);
  }
}

TEST_F(BlockedRoad, ItWaitsSinceTheFirstStepUntilItsRoadIsFree) {
  start();
  for (int i = 0; i < 4; ++i) {
    const coordination::Report report = step();
    EXPECT_EQ(report.status, StepStatus::kPlanned) << i;
    EXPECT_EQ(report.waiting.vehicles, std::vector<VehicleId>{{2}}) << i;
    EXPECT_EQ(report.waiting.since, StepIndex{kNow}) << i;
  }
  const coordination::Report free = step_alone();
  EXPECT_EQ(free.waiting, coordination::Waiting{});
}

TEST_F(BlockedRoad, AWaitAfterABreakIsANewOne) {
  start();
  EXPECT_EQ(step().waiting.since, StepIndex{kNow});
  one_->set_minimal_risk_stop(true);
  EXPECT_EQ(step().waiting, coordination::Waiting{});
  one_->set_minimal_risk_stop(false);
  EXPECT_EQ(step().waiting.since, StepIndex{kNow + 2});
}

TEST_F(BlockedRoad, ALateStepDoesNotInterruptTheWait) {
  start();
  EXPECT_THAT(step_too_late().waiting.vehicles, IsEmpty()) << "it was not known to wait before";
  EXPECT_EQ(step().waiting.since, StepIndex{kNow + 1});
  const coordination::Report late = step_too_late();
  EXPECT_EQ(late.waiting, (coordination::Waiting{.vehicles = {{2}}, .since = {kNow + 1}}));
  EXPECT_EQ(step().waiting.since, StepIndex{kNow + 1});
}

// Nothing is known of its new plan: it may be anywhere within its reach.
TEST_F(BlockedRoad, ItWaitsForOneWhosePredictionDidNotArrive) {
  start(10.0, {});
  parked_x_m_ = -0.5;  // behind
  begin_step();
  const coordination::Report report = finish(one_->commit({}, {}));
  ASSERT_EQ(report.reason, FallbackReason::kMissing);
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2}));
}

// Car 2 plans after car 1, and into its way.
TEST_F(BlockedRoad, ItWaitsForOneWhoseNewPlanItMeets) {
  start(10.0, {});
  parked_x_m_ = -0.5;  // behind
  begin_step();
  coordination::Prediction crossing = stays(k_);
  crossing.is_new = true;
  crossing.areas.final_area_m = wall(0.6);
  const coordination::Report report = finish(one_->commit(std::vector{crossing}, {}));
  ASSERT_EQ(report.reason, FallbackReason::kConflict);
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2}));
}

TEST_F(BlockedRoad, ItWaitsForOneThatIsMissing) {
  start();
  const coordination::Report report = step(false);
  EXPECT_THAT(report.missing, ElementsAre(VehicleId{2}));
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2}));
}

TEST_F(BlockedRoad, ItWaitsForOneThatDoesNotReceiveIt) {
  start();
  static_cast<void>(one_->observe(at(k_, {following(*one_, k_), seen(2, -0.5, 0.0)})));
  const auto two = controller(2);
  static_cast<void>(two->stand_by(at(k_ - 1, {seen(2, -0.5, 0.0)})));
  coordination::Traffic traffic = two->observe(at(k_, {seen(2, -0.5, 0.0)}));
  traffic.silent = {{1}};
  one_->couple(std::vector{traffic});
  static_cast<void>(one_->plan({}));
  parked_x_m_ = -0.5;
  const coordination::Report report = finish(one_->commit(std::vector{stays(k_)}, {}));
  ASSERT_EQ(report.reason, FallbackReason::kMissing);
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2})) << "though it is behind";
}

// Nobody sees either car: the step's reason is the other one, whose place is unknown.
TEST_F(BlockedRoad, WhileItIsNotSeenItDoesNotWait) {
  start();
  static_cast<void>(step());
  for (int i = 0; i < 4; ++i) {
    Observation observation = at(k_, {});
    observation.active = {{1}, {2}};
    static_cast<void>(one_->observe(observation));
    one_->couple({});
    static_cast<void>(one_->plan({}));
    const coordination::Report report = finish(one_->commit({}, {}));
    ASSERT_EQ(report.reason, FallbackReason::kMissing);
    EXPECT_EQ(report.waiting, coordination::Waiting{});
  }
}

TEST_F(BlockedRoad, AtItsGoalItDoesNotWait) {
  start(0.8, {});
  for (int i = 0; i < 20; ++i) EXPECT_THAT(step_alone().waiting.vehicles, IsEmpty());
  const Pose goal = one_->plan_in_force().pose_at({k_});
  ASSERT_EQ(one_->plan_in_force().pose_at({k_ + kHorizon}), goal);
  EXPECT_NEAR(goal.x_m, 0.8, 0.1);
  parked_x_m_ = goal.x_m + 0.3;
  const coordination::Report report = step();
  EXPECT_THAT(report.coupled, ElementsAre(VehicleId{2}));
  ASSERT_EQ(report.status, StepStatus::kPlanned);
  EXPECT_THAT(report.waiting.vehicles, IsEmpty());
}

TEST_F(BlockedRoad, BeforeAWallItDoesNotWait) {
  start(0.15);
  EXPECT_THAT(step().waiting.vehicles, IsEmpty());
  EXPECT_THAT(step_alone().waiting.vehicles, IsEmpty());
}

// Without car 2 it would stand there just the same.
TEST_F(BlockedRoad, BeforeAnObstacleItDoesNotWait) {
  start();
  one_->add_obstacle(wall(0.15));
  const coordination::Report report = step();
  EXPECT_EQ(report.status, StepStatus::kPlanned);
  EXPECT_THAT(report.waiting.vehicles, IsEmpty());
  EXPECT_THAT(step_alone().waiting.vehicles, IsEmpty());
}

TEST_F(BlockedRoad, ExaminingItChangesNoPlan) {
  start();
  Controller not_examined = *one_;
  for (int i = 0; i < 10; ++i) {
    const bool is_free = i >= 5;
    const std::uint64_t k = k_;
    const coordination::Report examined = is_free ? step_alone() : step();
    static_cast<void>(not_examined.observe(
        is_free ? at(k, {following(not_examined, k)})
                : at(k, {following(not_examined, k), seen(2, parked_x_m_, 0.0)})));
    not_examined.couple(is_free ? std::vector<coordination::Traffic>{} : std::vector{parked(k)});
    static_cast<void>(not_examined.plan({}));
    const coordination::Report report = not_examined.commit(std::vector{stays(k)}, {});
    EXPECT_EQ(report.cost_m2, examined.cost_m2) << i;
    EXPECT_EQ(report.generated, examined.generated) << i;
    EXPECT_EQ(not_examined.plan_in_force().pose_at({k + 9}), one_->plan_in_force().pose_at({k + 9}))
        << i;
  }
}

// Each has the other's plan in its way; what one has voted is known to the other.
TEST(AgreedWaiting, ItWaitsForWhoVotedAgainst) {
  const auto one = controller(1, 0.0, kAgreed);
  static_cast<void>(one->stand_by(at(kNow - 1, {seen(1, 0.0, 0.0)})));
  const Observation observation = at(kNow, {seen(1, 0.0, 0.0), seen(2, 0.0, 0.3)});
  static_cast<void>(one->observe(observation));
  const auto two = controller(2, 0.3, kAgreed);
  static_cast<void>(two->stand_by(at(kNow - 1, {seen(2, 0.0, 0.3)})));
  one->couple(std::vector{two->observe(observation)});
  static_cast<void>(one->plan({}));
  const std::vector<coordination::Outcome> votes{
      {.vehicle = {2}, .step = {kNow}, .wants_fallback = true}};
  coordination::Report report = one->commit({}, votes);
  one->note_causes(report);
  ASSERT_EQ(report.reason, FallbackReason::kNeighbour);
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{2}));
}

// Car 3 is coupled with car 2 alone, but belongs to the same component.
TEST(AgreedWaiting, ItWaitsForAVoterThatIsNotCoupled) {
  const std::vector<coordination::MeasuredVehicle> states{seen(1, 0.0, 0.0), seen(2, 1.2, 0.4),
                                                          seen(3, 2.4, 0.8)};
  std::vector<std::unique_ptr<Controller>> cars;
  std::vector<coordination::Traffic> traffic;
  for (std::uint8_t id = 1; id <= 3; ++id) {
    cars.push_back(controller(id, 0.4 * (id - 1), kAgreed));
    static_cast<void>(cars.back()->stand_by(at(kNow - 1, states)));
    traffic.push_back(cars.back()->observe(at(kNow, states)));
  }
  Controller& one = *cars.front();
  one.couple(std::vector(traffic.begin() + 1, traffic.end()));
  ASSERT_THAT(one.coupled(), ElementsAre(VehicleId{2}));
  ASSERT_THAT(one.component(), ElementsAre(VehicleId{1}, VehicleId{2}, VehicleId{3}));
  static_cast<void>(one.plan({}));
  const std::vector<coordination::Outcome> votes{
      {.vehicle = {2}, .step = {kNow}, .wants_fallback = false},
      {.vehicle = {3}, .step = {kNow}, .wants_fallback = true}};
  coordination::Report report = one.commit({}, votes);
  one.note_causes(report);
  ASSERT_EQ(report.reason, FallbackReason::kNeighbour);
  EXPECT_THAT(report.waiting.vehicles, ElementsAre(VehicleId{3}));
  EXPECT_THAT(report.blocked_by, ElementsAre(VehicleId{3}));
}

}  // namespace
}  // namespace hlc::controller::waits_for_test
