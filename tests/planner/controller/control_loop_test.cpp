#include "planner/controller/control_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller {
namespace {

using namespace east_bound;
using testing::ElementsAre;
using testing::IsEmpty;

/// Two cars, 1 and 2, side by side or one behind the other, standing since step 100.
class TwoLoops : public testing::Test {
 protected:
  void stand(double second_y_m, const ControllerStrategies& strategies = {}) {
    one_ = controller(1, 0.0, strategies);
    two_ = controller(2, second_y_m, strategies);
    first_.emplace(*one_);
    second_.emplace(*two_);
    states_ = {seen(1, 0.0, 0.0), seen(2, 0.0, second_y_m)};
    static_cast<void>(first_->stand_by(at(100, states_)));
    static_cast<void>(second_->stand_by(at(100, states_)));
  }

  [[nodiscard]] Observation observation(std::uint64_t k = 101) const { return at(k, states_); }

  std::unique_ptr<Controller> one_;
  std::unique_ptr<Controller> two_;
  std::optional<ControlLoop> first_;
  std::optional<ControlLoop> second_;
  std::vector<coordination::MeasuredVehicle> states_;
};

TEST_F(TwoLoops, APhaseAwaitsWhatItNeedsAndTheStepEndsWithTheReport) {
  stand(0.3);
  const StepOutput from_first = first_->begin(observation());
  const StepOutput from_second = second_->begin(observation());
  ASSERT_TRUE(from_first.traffic && from_second.traffic);
  EXPECT_EQ(second_->awaited().kind, MessageKind::kTraffic);
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  first_->receive(*from_second.traffic);
  second_->receive(*from_first.traffic);
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  static_cast<void>(first_->proceed());
  static_cast<void>(second_->proceed());

  EXPECT_THAT(first_->awaited().from, IsEmpty()) << "no vehicle plans before it";
  EXPECT_EQ(second_->awaited().kind, MessageKind::kPrediction);
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  const StepOutput planned = first_->proceed();
  ASSERT_TRUE(planned.prediction);
  EXPECT_FALSE(planned.outcome) << "strict needs no votes";
  EXPECT_THAT(first_->awaited().from, ElementsAre(VehicleId{2}));
  second_->receive(*planned.prediction);
  first_->receive(*second_->proceed().prediction);

  EXPECT_THAT(first_->awaited().from, IsEmpty());
  const StepOutput end = first_->proceed();
  ASSERT_TRUE(end.report);
  EXPECT_EQ(end.report->status, coordination::StepStatus::kPlanned);
  EXPECT_FALSE(first_->is_in_step());
  EXPECT_EQ(second_->proceed().report->status, coordination::StepStatus::kPlanned);
}

TEST_F(TwoLoops, AgreedAwaitsTheVotesOfTheComponent) {
  stand(0.3, kAgreed);
  const coordination::Traffic traffic = *first_->begin(observation()).traffic;
  second_->receive(traffic);
  first_->receive(*second_->begin(observation()).traffic);
  static_cast<void>(first_->proceed());
  const StepOutput planned = first_->proceed();
  ASSERT_TRUE(planned.prediction && planned.outcome);
  EXPECT_EQ(first_->awaited().kind, MessageKind::kOutcome);
  EXPECT_THAT(first_->awaited().from, ElementsAre(VehicleId{2}));
  first_->receive(coordination::Outcome{.vehicle = {2}, .step = {101}, .wants_fallback = true});
  EXPECT_THAT(first_->awaited().from, IsEmpty());
  EXPECT_EQ(first_->proceed().report->reason, coordination::FallbackReason::kNeighbour);
}

TEST_F(TwoLoops, WhatComesAPhaseOrAStepEarlyWaitsForItsTime) {
  stand(0.3);
  const coordination::Traffic traffic = *first_->begin(observation()).traffic;
  static_cast<void>(first_->proceed());
  const coordination::Prediction prediction = *first_->proceed().prediction;
  second_->receive(prediction);  // in step 100 yet
  second_->receive(traffic);
  static_cast<void>(second_->begin(observation()));
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  static_cast<void>(second_->proceed());
  EXPECT_THAT(second_->awaited().from, IsEmpty());
}

TEST_F(TwoLoops, WhatIsOverOrFarAheadOrInTheOwnNameIsDropped) {
  stand(0.3);
  coordination::Traffic traffic = *first_->begin(observation()).traffic;
  static_cast<void>(second_->begin(observation()));
  for (const std::uint64_t step : {100U, 112U}) {
    traffic.step = {step};
    second_->receive(traffic);
  }
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  static_cast<void>(second_->fall_back(coordination::FallbackReason::kLate));
  static_cast<void>(second_->begin(observation(112)));
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  traffic.vehicle = {2};
  second_->receive(traffic);
  static_cast<void>(second_->proceed());
  EXPECT_THAT(two_->coupled(), IsEmpty());
}

TEST_F(TwoLoops, AStepThatIsOnlyAnnouncedMovesOnWhatIsKept) {
  stand(0.3);
  coordination::Traffic traffic = *first_->begin(observation()).traffic;
  second_->advance_to({150});
  traffic.step = {151};
  second_->receive(traffic);
  static_cast<void>(second_->begin(observation(151)));
  EXPECT_THAT(second_->awaited().from, IsEmpty());
}

TEST_F(TwoLoops, APhaseWorksWithoutWhatDidNotCome) {
  stand(0.3);
  static_cast<void>(second_->begin(observation()));
  static_cast<void>(second_->proceed());
  static_cast<void>(second_->proceed());
  const StepOutput end = second_->proceed();
  ASSERT_TRUE(end.report);
  EXPECT_THAT(end.report->missing, ElementsAre(VehicleId{1}));
}

TEST_F(TwoLoops, FallingBackEndsTheStepInAnyPhaseAndKeepsThePlanInForce) {
  for (int phases = 0; phases < 3; ++phases) {
    stand(0.3);
    static_cast<void>(second_->begin(observation()));
    for (int i = 0; i < phases; ++i) static_cast<void>(second_->proceed());
    const StepOutput end = second_->fall_back(coordination::FallbackReason::kLate);
    ASSERT_TRUE(end.report);
    EXPECT_EQ(end.report->status, coordination::StepStatus::kFallback);
    EXPECT_EQ(end.report->reason, coordination::FallbackReason::kLate);
    EXPECT_FALSE(second_->is_in_step());
    EXPECT_EQ(two_->plan_in_force().end(), StepIndex{100});
  }
}

TEST_F(TwoLoops, TheStopwatchMeasuresPlanningAlone) {
  stand(0.3);
  std::uint64_t now = 0;
  ControlLoop loop(*one_, [&now] { return now += 7; });
  static_cast<void>(loop.begin(observation()));
  EXPECT_EQ(loop.planning_ns(), 0U);
  static_cast<void>(loop.proceed());
  static_cast<void>(loop.proceed());
  EXPECT_EQ(loop.planning_ns(), 7U);
  static_cast<void>(loop.proceed());
  EXPECT_EQ(now, 14U);
}

}  // namespace
}  // namespace hlc::controller
