// The certificates of two cars side by side.
#include "planner/coordination/certificate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/controller/control_loop.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller::certificate_test {
namespace {

using namespace east_bound;
using coordination::Certificate;
using coordination::KnownMotion;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::pair<int, KnownMotion>> known(const Certificate& certificate) {
  std::vector<std::pair<int, KnownMotion>> result;
  for (const auto& separation : certificate.separations) {
    result.emplace_back(separation.from.value, separation.known);
  }
  return result;
}

class CertificateTest : public testing::Test {
 protected:
  void SetUp() override {
    one_ = controller(1, 0.0, {});
    two_ = controller(2, kSecond_y_m, {});
    first_.emplace(*one_);
    second_.emplace(*two_);
    states_ = {seen(1, 0.0, 0.0), seen(2, 0.0, kSecond_y_m)};
    EXPECT_EQ(first_->stand_by(at(100, states_)).certificate, nullptr);
    static_cast<void>(second_->stand_by(at(100, states_)));
  }

  enum class Arrives { kAll, kNoPlanOfTheSecond, kNothingOfTheSecond };

  /// A step of both; the first one's certificate.
  Certificate step(std::uint64_t k, Arrives arrives, bool is_late = false) {
    const StepOutput from_first = first_->begin(at(k, states_));
    const StepOutput from_second = second_->begin(at(k, states_));
    if (arrives != Arrives::kNothingOfTheSecond) first_->receive(*from_second.traffic);
    second_->receive(*from_first.traffic);
    static_cast<void>(first_->proceed());
    static_cast<void>(second_->proceed());
    second_->receive(*first_->proceed().prediction);
    const StepOutput planned = second_->proceed();
    if (arrives == Arrives::kAll) first_->receive(*planned.prediction);
    const StepOutput end =
        is_late ? first_->fall_back(coordination::FallbackReason::kLate) : first_->proceed();
    static_cast<void>(second_->proceed());
    states_ = {following(*one_, k + 1), following(*two_, k + 1)};
    return *end.report->certificate;
  }

  static constexpr double kSecond_y_m = 0.3;
  std::unique_ptr<Controller> one_;
  std::unique_ptr<Controller> two_;
  std::optional<ControlLoop> first_;
  std::optional<ControlLoop> second_;
  std::vector<coordination::MeasuredVehicle> states_;
};

TEST_F(CertificateTest, HoldsTheAreasOfTheNewPlanAndLinesToBothPlansOfTheOther) {
  const Certificate certificate = step(101, Arrives::kAll);
  EXPECT_TRUE(certificate.is_agreed);
  EXPECT_EQ(certificate.areas.first, StepIndex{101});
  EXPECT_EQ(certificate.areas.areas_m.size(), one_->plan_in_force().end().value - 101);
  EXPECT_THAT(known(certificate),
              ElementsAre(Pair(2, KnownMotion::kRunning), Pair(2, KnownMotion::kNew)));
  for (const auto& separation : certificate.separations) {
    EXPECT_EQ(separation.lines.size(), one_->options().horizon_steps);
    for (const SeparatingLine& line : separation.lines) {
      const Point n{std::cos(line.direction_rad), std::sin(line.direction_rad)};
      if (separation.known != KnownMotion::kRunning) continue;
      EXPECT_GT(n.dot(Point{0.0, kSecond_y_m}), line.offset_m) << "where the other stands";
    }
  }
}

TEST_F(CertificateTest, OfAPlanThatIsKeptHasTheAreasThatItHadAndTheLinesThatThereAre) {
  const Certificate before = step(101, Arrives::kAll);
  const Certificate kept = step(102, Arrives::kAll, true);
  EXPECT_TRUE(kept.is_agreed);
  EXPECT_EQ(kept.areas.first, StepIndex{102});
  for (std::uint64_t k = 102; k < 115; ++k) {
    EXPECT_EQ(kept.areas.during({k}), before.areas.during({k})) << k;
  }
  EXPECT_EQ(known(kept).front(), std::pair(2, KnownMotion::kRunning));
}

TEST_F(CertificateTest, HasNoLineWhereTheReachOfTheOtherLeavesNone) {
  const Certificate certificate = step(101, Arrives::kNoPlanOfTheSecond);
  EXPECT_THAT(known(certificate), ElementsAre(Pair(2, KnownMotion::kRunning)));
  EXPECT_FALSE(certificate.is_agreed) << "nobody has agreed to where it stands";
}

TEST_F(CertificateTest, HasLinesToAMissingVehicleWhereItCanReachNothing) {
  states_ = {seen(1, 0.0, 0.0), seen(2, 0.0, 9.0)};
  const Certificate certificate = step(101, Arrives::kNothingOfTheSecond);
  EXPECT_THAT(known(certificate), ElementsAre(Pair(2, KnownMotion::kMissing)));
}

TEST_F(CertificateTest, IsNotAgreedWhileTheVehicleIsOffItsPlan) {
  EXPECT_TRUE(step(101, Arrives::kAll).is_agreed);
  states_[0].pose.y_m -= 0.1;
  EXPECT_FALSE(step(102, Arrives::kAll).is_agreed);
}

}  // namespace
}  // namespace hlc::controller::certificate_test
