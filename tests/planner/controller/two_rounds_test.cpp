#include "planner/controller/two_rounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controller/control_loop.hpp"
#include "planner/coordination/digest.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller {
namespace {

using namespace east_bound;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kSecond_y_m = 0.3;

std::unique_ptr<Controller> car(std::uint8_t vehicle, const ControllerStrategies& strategies,
                                ControllerFactory others) {
  const double y_m = vehicle == 1 ? 0.0 : kSecond_y_m;
  return std::make_unique<Controller>(
      ControllerOptions{
          .vehicle = {vehicle}, .strategies = strategies, .others = std::move(others)},
      subgraph(), road::ReferencePath({Point(0.0, y_m), Point(10.0, y_m)}, false),
      road::Corridor{});
}

/// Cars 1 and 2 side by side, standing since step 100. Each can plan for the other.
class TwoRoundsTest : public testing::Test {
 protected:
  void stand(const ControllerStrategies& strategies = {}) {
    const ControllerFactory others = [strategies](VehicleId id) {
      return car(id.value, strategies, {});
    };
    stand(car(1, strategies, others), car(2, strategies, others));
  }

  void stand(std::unique_ptr<Controller> one, std::unique_ptr<Controller> two) {
    one_ = std::move(one);
    two_ = std::move(two);
    first_.emplace(*one_);
    second_.emplace(*two_);
    static_cast<void>(first_->stand_by(at(100, states_)));
    static_cast<void>(second_->stand_by(at(100, states_)));
  }

  /// Both take the traffic of each other and plan.
  void plan(std::uint64_t k = 101) {
    const Observation now = at(k, states_);
    traffic_ = {*first_->begin(now).traffic, *second_->begin(now).traffic};
    first_->receive(traffic_[1]);
    second_->receive(traffic_[0]);
    static_cast<void>(first_->proceed());
    static_cast<void>(second_->proceed());
    from_first_ = first_->proceed();
    from_second_ = second_->proceed();
  }

  enum class Ends { kInTime, kTooLate };

  /// Steps in which all arrives; in the last one car 1 ends so.
  void drive(std::uint64_t steps, Ends last) {
    for (std::uint64_t i = 0; i < steps; ++i, ++next_) {
      plan(next_);
      if (from_second_.outcome) first_->receive(*from_second_.outcome);
      if (from_first_.outcome) second_->receive(*from_first_.outcome);
      if (from_second_.prediction) first_->receive(*from_second_.prediction);
      if (last == Ends::kTooLate && i + 1 == steps) {
        static_cast<void>(first_->fall_back(coordination::FallbackReason::kLate));
      } else {
        static_cast<void>(end(*first_));
      }
      static_cast<void>(end(*second_));
      states_ = {following(*one_, next_ + 1), following(*two_, next_ + 1)};
    }
  }

  [[nodiscard]] coordination::Report end(ControlLoop& loop) { return *loop.proceed().report; }

  std::vector<coordination::MeasuredVehicle> states_{seen(1, 0.0, 0.0), seen(2, 0.0, kSecond_y_m)};
  std::unique_ptr<Controller> one_;
  std::unique_ptr<Controller> two_;
  std::optional<ControlLoop> first_;
  std::optional<ControlLoop> second_;
  std::array<coordination::Traffic, 2> traffic_;
  StepOutput from_first_;
  StepOutput from_second_;
  std::uint64_t next_{101};  ///< step of `drive`
};

TEST_F(TwoRoundsTest, PlanWithoutWaitingForEachOther) {
  stand();
  plan();
  ASSERT_TRUE(from_first_.outcome && from_second_.outcome);
  EXPECT_TRUE(from_first_.outcome->digests);
  EXPECT_FALSE(from_first_.prediction) << "the other one has computed it";
  EXPECT_EQ(second_->awaited().kind, MessageKind::kOutcome);
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  second_->receive(*from_first_.outcome);
  first_->receive(*from_second_.outcome);
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  EXPECT_EQ(end(*first_).status, coordination::StepStatus::kPlanned);
  EXPECT_EQ(end(*second_).status, coordination::StepStatus::kPlanned);
}

// Each of them, the one that plans first, too.
TEST_F(TwoRoundsTest, KeepTheirPlansWithoutTheOthersConfirmation) {
  stand();
  plan();
  EXPECT_EQ(end(*first_).reason, coordination::FallbackReason::kMissing);
  EXPECT_EQ(end(*second_).reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoRoundsTest, TakeAnotherDigestForNoConfirmation) {
  stand();
  plan();
  ++from_first_.outcome->digests->plan;
  ++from_second_.outcome->digests->plan;
  second_->receive(*from_first_.outcome);
  first_->receive(*from_second_.outcome);
  EXPECT_EQ(end(*first_).reason, coordination::FallbackReason::kMissing);
  EXPECT_EQ(end(*second_).reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoRoundsTest, TakeAnOutcomeOfAnotherStepForNoConfirmation) {
  stand();
  plan();
  ++from_first_.outcome->step.value;
  second_->receive(*from_first_.outcome);
  EXPECT_EQ(end(*second_).reason, coordination::FallbackReason::kMissing);
}

TEST_F(TwoRoundsTest, TakeAPredictionInsteadOfAnOutcome) {
  stand();
  plan();
  second_->receive(one_->prediction());
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  EXPECT_EQ(end(*second_).status, coordination::StepStatus::kPlanned);
}

// Car 2 has planned around another plan of car 1 than that one drives.
TEST_F(TwoRoundsTest, CheckTheirPlanAgainstAPredictionThatTheyHaveNotComputed) {
  stand();
  plan();
  coordination::Prediction other = one_->prediction();
  ASSERT_TRUE(other.is_new);
  other.areas.areas_m.back() = two_->prediction().areas.areas_m.back();
  second_->receive(other);
  EXPECT_EQ(end(*second_).reason, coordination::FallbackReason::kConflict);
}

TEST_F(TwoRoundsTest, PlanOneAfterTheOtherIfOneDoesNotShare) {
  stand();
  const Observation now = at(101, states_);
  coordination::Traffic traffic = *first_->begin(now).traffic;
  traffic.planning.reset();
  static_cast<void>(second_->begin(now));
  second_->receive(traffic);
  static_cast<void>(second_->proceed());
  EXPECT_THAT(second_->two_rounds()->not_shared(), ElementsAre(VehicleId{1}));
  EXPECT_EQ(second_->awaited().kind, MessageKind::kPrediction);
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1}));
  const StepOutput planned = second_->proceed();
  EXPECT_TRUE(planned.prediction);
  EXPECT_FALSE(planned.outcome);
}

// It has received other traffic, and expects predictions.
TEST_F(TwoRoundsTest, DoNotWaitForAPredictionThatDoesNotCome) {
  stand();
  const Observation now = at(101, states_);
  coordination::Traffic traffic = *first_->begin(now).traffic;
  traffic.planning.reset();
  static_cast<void>(second_->begin(now));
  second_->receive(traffic);
  second_->receive(
      coordination::Outcome{.vehicle = {1}, .step = {101}, .digests = coordination::PlanDigests{}});
  static_cast<void>(second_->proceed());
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  static_cast<void>(second_->proceed());
  EXPECT_THAT(second_->awaited().from, IsEmpty());
}

// Nobody else can know from what it has planned.
TEST_F(TwoRoundsTest, PublishTheirPredictionTooIfTheyMissAVehicle) {
  stand();
  states_.push_back(seen(3, 5.0, 5.0));
  plan();
  EXPECT_TRUE(from_first_.outcome && from_first_.outcome->digests);
  ASSERT_TRUE(from_first_.prediction);
  EXPECT_EQ(digest_of(*from_first_.prediction), from_first_.outcome->digests->plan);
}

/// Of cars 1 that plan by another rule, and of usual cars 2.
std::unique_ptr<Controller> other_car_1(VehicleId id) {
  return car(
      id.value,
      id.value == 1 ? ControllerStrategies{.incumbent = &no_incumbent} : ControllerStrategies{},
      {});
}
std::unique_ptr<Controller> usual_car(VehicleId id) { return car(id.value, {}, {}); }

// As after a change of its subgraph: it can plan for car 2, and car 2 cannot for it.
TEST_F(TwoRoundsTest, PlanOneAfterTheOtherIfTheOthersKnowOneOtherwise) {
  stand(car(1, {}, &other_car_1), car(2, {}, &other_car_1));
  plan();
  EXPECT_FALSE(traffic_[0].planning);
  EXPECT_TRUE(from_first_.prediction && !from_first_.outcome);
  EXPECT_TRUE(from_second_.prediction && !from_second_.outcome);
}

// Car 1 takes two rounds, since it does not know that car 2 cannot plan for it.
TEST_F(TwoRoundsTest, PublishTheirPredictionAfterAStepInWhichOneCouldNotComputeIt) {
  stand(car(1, {}, &usual_car), car(2, {}, &other_car_1));
  drive(1, Ends::kInTime);
  EXPECT_TRUE(from_first_.outcome && !from_first_.prediction);
  EXPECT_TRUE(from_second_.prediction && !from_second_.outcome);
  const coordination::Traffic from_one = *first_->begin(at(next_, states_)).traffic;
  const coordination::Traffic from_two = *second_->begin(at(next_, states_)).traffic;
  first_->receive(from_two);
  second_->receive(from_one);
  static_cast<void>(first_->proceed());
  static_cast<void>(second_->proceed());
  const StepOutput planned = first_->proceed();
  ASSERT_TRUE(planned.outcome && planned.prediction);
  EXPECT_TRUE(planned.outcome->digests->is_prediction_published);
  second_->receive(*planned.outcome);
  EXPECT_THAT(second_->awaited().from, ElementsAre(VehicleId{1})) << "its prediction is to come";
  second_->receive(*planned.prediction);
  EXPECT_THAT(second_->awaited().from, IsEmpty());
  first_->receive(*second_->proceed().prediction);
  EXPECT_EQ(end(*first_).status, coordination::StepStatus::kPlanned);
  EXPECT_EQ(end(*second_).status, coordination::StepStatus::kPlanned);
}

TEST_F(TwoRoundsTest, ThatComputeOtherBitsForAHorizonShareNoMore) {
  stand();
  const std::size_t horizon_steps = one_->options().horizon_steps;
  for (std::size_t i = 0; i < horizon_steps; ++i) {
    EXPECT_FALSE(second_->two_rounds()->differs_from()) << i;
    plan(101 + i);
    ASSERT_TRUE(from_first_.outcome && from_first_.outcome->digests) << i;
    ++from_first_.outcome->digests->plan;
    second_->receive(*from_first_.outcome);
    first_->receive(*from_second_.outcome);
    static_cast<void>(first_->proceed());
    static_cast<void>(second_->proceed());
    states_ = {following(*one_, 102 + i), following(*two_, 102 + i)};
  }
  EXPECT_EQ(second_->two_rounds()->differs_from(), VehicleId{1});
  EXPECT_FALSE(first_->two_rounds()->differs_from());
  plan(101 + horizon_steps);
  EXPECT_FALSE(traffic_[1].planning);
  EXPECT_TRUE(from_first_.prediction) << "the traffic of the other one shows it";
}

TEST_F(TwoRoundsTest, WithOtherInputsAreNotFoundToComputeOtherBits) {
  stand();
  for (std::size_t i = 0; i < 2 * one_->options().horizon_steps; ++i) {
    plan(101 + i);
    ++from_first_.outcome->digests->plan;
    ++from_first_.outcome->digests->inputs;
    second_->receive(*from_first_.outcome);
    first_->receive(*from_second_.outcome);
    static_cast<void>(first_->proceed());
    static_cast<void>(second_->proceed());
    states_ = {following(*one_, 102 + i), following(*two_, 102 + i)};
  }
  EXPECT_FALSE(second_->two_rounds()->differs_from());
}

// Car 1 takes so long to plan for both that its steps end too late.
TEST_F(TwoRoundsTest, ThatAreLateTooOftenShareNoMore) {
  stand();
  for (std::size_t i = 0; i < TwoRounds::kMostLateSteps; ++i) {
    EXPECT_TRUE(first_->two_rounds()->shares()) << i;
    drive(TwoRounds::kWindow / 2 - 1, Ends::kTooLate);
  }
  EXPECT_TRUE(first_->two_rounds()->is_too_slow());
  EXPECT_TRUE(second_->two_rounds()->shares()) << "it was in time";
  plan(next_);
  EXPECT_FALSE(traffic_[0].planning);
  EXPECT_TRUE(from_first_.prediction);
}

TEST_F(TwoRoundsTest, ThatAreLateNowAndThenGoOnSharing) {
  stand();
  for (std::size_t i = 0; i < 2 * TwoRounds::kMostLateSteps; ++i) {
    drive(TwoRounds::kWindow / 2, Ends::kTooLate);
  }
  EXPECT_TRUE(first_->two_rounds()->shares());
}

TEST_F(TwoRoundsTest, UnderARuleThatNeedsVotesPlanOneAfterTheOther) {
  stand(kAgreed);
  EXPECT_EQ(first_->two_rounds(), nullptr);
  const StepOutput output = first_->begin(at(101, states_));
  EXPECT_FALSE(output.traffic->planning);
}

}  // namespace
}  // namespace hlc::controller
