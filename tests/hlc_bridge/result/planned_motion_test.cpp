#include "hlc_bridge/result/planned_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/support/test_automaton.hpp"

namespace hlc::result::planned_motion_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kInterval = 10'000'000;

/// A car that starts and drives a bend: trims 1, 7, 8, 8 and 9, and a maneuver between two each.
class PlannedMotionTest : public testing::Test {
 protected:
  void SetUp() override {
    Pose pose{1.0, 2.0, 0.3};
    constexpr std::size_t kTrims[] = {0, 6, 7, 7, 8};
    for (std::size_t k = 0; k < std::size(kTrims); ++k) {
      StepRecord row{.step = k, .record = {}, .driven = {}};
      coordination::Report& report = row.record.report;
      report.vehicle = VehicleId{4};
      report.planned_pose = pose;
      report.planned_trim = TrimId{kTrims[k]};
      report.maneuver = k == 2 ? automaton::kSelfLoopLabel : "test";
      rows_.push_back(row);
      if (k + 1 == std::size(kTrims)) break;
      maneuvers_.push_back(automaton_.find({kTrims[k]}, {kTrims[k + 1]}, "test"));
      pose = compose(pose, maneuvers_.back()->displacement);
    }
  }

  [[nodiscard]] std::vector<vehicle::State> motion() const {
    std::vector<const StepRecord*> rows;
    for (const StepRecord& row : rows_) rows.push_back(&row);
    return planned_motion(rows, kPeriod, kInterval, automaton_);
  }

  automaton::UniversalAutomaton automaton_{*test::make_test_automaton()};
  std::vector<StepRecord> rows_;
  std::vector<const automaton::Maneuver*> maneuvers_;
};

TEST_F(PlannedMotionTest, IsTheManeuversOneAfterTheOther) {
  const std::vector<vehicle::State> states = motion();
  ASSERT_EQ(states.size(), 4 * 20U + 1);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::size_t k = std::min<std::size_t>(i / 20, 3);
    const double time_s = 0.01 * static_cast<double>(i - 20 * k);
    vehicle::State expected = automaton::state_at(*maneuvers_[k], time_s, automaton_.vehicle);
    expected.pose = compose(rows_[k].record.report.planned_pose, expected.pose);
    EXPECT_NEAR(states[i].pose.x_m, expected.pose.x_m, 1e-12) << i;
    EXPECT_NEAR(states[i].pose.y_m, expected.pose.y_m, 1e-12) << i;
    EXPECT_NEAR(states[i].pose.heading_rad, expected.pose.heading_rad, 1e-12) << i;
    EXPECT_NEAR(states[i].speed_mps, expected.speed_mps, 1e-12) << i;
    EXPECT_NEAR(states[i].steering_rad, expected.steering_rad, 1e-12) << i;
  }
}

TEST_F(PlannedMotionTest, OfAReportsPlanIsItsManeuversAsFarAsTheAutomatonHoldsThem) {
  coordination::Report report;
  report.planned_trim = {0};
  report.plan = {{{6}, "test"}, {{7}, "test"}, {{7}, automaton::kSelfLoopLabel}};
  EXPECT_THAT(planned_maneuvers(report, automaton_),
              testing::ElementsAre(maneuvers_[0], maneuvers_[1], maneuvers_[2]));
  report.plan[1].label = "of other weights";
  EXPECT_THAT(planned_maneuvers(report, automaton_), testing::ElementsAre(maneuvers_[0]));
  report.plan = {{{6}, automaton::kSelfLoopLabel}};
  EXPECT_THAT(planned_maneuvers(report, automaton_), testing::SizeIs(1))
      << "a standing car whose plan is set down elsewhere may continue in another equilibrium";
}

// In step 2 the controller sets its plan down 7 mm aside: reported from step 3 on.
TEST_F(PlannedMotionTest, OfAPlanSetDownAnewJumpsJustAfterTheStep) {
  const std::vector<vehicle::State> before = motion();
  for (std::size_t k = 3; k < rows_.size(); ++k) rows_[k].record.report.planned_pose.y_m += 0.007;
  const std::vector<vehicle::State> after = motion();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i].pose.y_m - before[i].pose.y_m, i <= 40 ? 0.0 : 0.007, 1e-12) << i;
  }
}

TEST_F(PlannedMotionTest, OfAPlanSetDownAnewIsOfTheManeuverThatIsNamed) {
  for (std::size_t k = 1; k < rows_.size(); ++k) rows_[k].record.report.planned_pose.y_m += 0.007;
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_), maneuvers_.front());
}

TEST_F(PlannedMotionTest, IsNotKnownWhereARowIsMissing) {
  rows_.erase(rows_.begin() + 2);
  EXPECT_THAT([this] { static_cast<void>(motion()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("vehicle 4, step 3: the step before")));
}

// They may even lead to the same pose.
TEST_F(PlannedMotionTest, ManeuversBetweenTheSameTrimsAreToldApartByTheirLabels) {
  automaton::Maneuver other = *automaton_.find({0}, {6}, "test");
  other.label = "other";
  automaton_.maneuvers.insert(automaton_.maneuvers.begin(), other);
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_)->label, "test");
  rows_[0].record.report.maneuver = "other";
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_), &automaton_.maneuvers.front());
}

// The plan of a stationary car is re-anchored, in another equilibrium.
TEST_F(PlannedMotionTest, StandingIsTheOwnStepWhateverTheNextTrimIs) {
  rows_[0].record.report.maneuver = automaton::kSelfLoopLabel;
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_),
            automaton_.find({0}, {0}, automaton::kSelfLoopLabel));
}

// It was to turn its wheels to one side, and its new plan begins with them to the other.
TEST_F(PlannedMotionTest, BetweenEquilibriaWithoutSuchAManeuverTheCarStands) {
  rows_[0].record.report.maneuver = "turning";
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_), nullptr);
  automaton_.trims[6].speed_mps = 0.0;
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_),
            automaton_.find({0}, {0}, automaton::kSelfLoopLabel));
  rows_[0].record.report.maneuver = "";
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_), nullptr);
}

TEST_F(PlannedMotionTest, WithoutAPlanOrANextRowThereIsNone) {
  EXPECT_EQ(maneuver_during(rows_[0], nullptr, automaton_), nullptr);
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[2], automaton_), nullptr);
  ASSERT_NE(maneuver_during(rows_[2], &rows_[3], automaton_), nullptr);
  rows_[2].record.report.maneuver = "";
  EXPECT_EQ(maneuver_during(rows_[2], &rows_[3], automaton_), nullptr);
}

TEST_F(PlannedMotionTest, IsNotKnownOfAManeuverThatTheAutomatonDoesNotHold) {
  rows_[1].record.report.maneuver = "J1 0.3\nJ2 0.7";
  EXPECT_EQ(maneuver_during(rows_[1], &rows_[2], automaton_), nullptr);
  EXPECT_THAT([this] { static_cast<void>(motion()); },
              ThrowsMessage<std::runtime_error>(
                  "vehicle 4, step 1: no maneuver from trim 7 to 8 with label 'J1 0.3\\nJ2 0.7', "
                  "must be in the automaton"));
}

TEST_F(PlannedMotionTest, IsNotKnownOfTrimsThatTheAutomatonDoesNotHold) {
  rows_[1].record.report.planned_trim = TrimId{12};
  EXPECT_EQ(maneuver_during(rows_[0], &rows_[1], automaton_), nullptr);
  EXPECT_EQ(maneuver_during(rows_[1], &rows_[2], automaton_), nullptr);
}

TEST(DrivenMotion, IsLinearBetweenTicksAndEndsWithTheDrive) {
  Drive drive(3);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto t = static_cast<double>(i);
    drive[i].t = 1'000'000'000 + i * kVehiclePeriod;
    drive[i].pose = {t, 2.0 * t, 0.5 * t};
    drive[i].speed_mps = 0.1 * t * t;
  }
  const std::vector<vehicle::State> states = driven_motion(drive, 1'000'000'000, kInterval, 9);
  ASSERT_EQ(states.size(), 5U);
  EXPECT_DOUBLE_EQ(states[3].pose.x_m, 1.5);
  EXPECT_DOUBLE_EQ(states[3].pose.y_m, 3.0);
  EXPECT_DOUBLE_EQ(states[3].pose.heading_rad, 0.75);
  EXPECT_DOUBLE_EQ(states[3].speed_mps, 0.25);
  EXPECT_DOUBLE_EQ(states[4].speed_mps, 0.4);
}

}  // namespace
}  // namespace hlc::result::planned_motion_test
