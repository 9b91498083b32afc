#include "vehicle_sim/campaign/driven_costs.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc::campaign::driven_costs_test {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kTick = 20'000'000;
constexpr std::uint64_t kFirstStep = 5;

/// Vehicles that start, drive straight on for a step, and of which the last step is not known. True
/// positions are on a line, at 0.3 m/s whatever was planned.
class DrivenCostsTest : public testing::Test {
 protected:
  void SetUp() override {
    double cost = 1.0;
    for (automaton::Maneuver& maneuver : automaton_->maneuvers) {
      maneuver.criteria = {{"J2", cost}, {"comfort", 1000.0 * cost}};
      cost += 1.0;
    }
    for (const std::uint8_t id : {std::uint8_t{3}, std::uint8_t{4}}) add_vehicle(id);
  }

  void add_vehicle(std::uint8_t id) {
    constexpr std::size_t kTrims[] = {0, 6, 6, 7};
    for (std::size_t k = 0; k < std::size(kTrims); ++k) {
      result::StepRecord row{.step = k, .record = {}, .driven = {}};
      coordination::Report& report = row.record.report;
      report.vehicle = VehicleId{id};
      report.step = StepIndex{kFirstStep + k};
      report.planned_trim = TrimId{kTrims[k]};
      report.maneuver = k == 1 ? automaton::kSelfLoopLabel : test::kTestLabel;
      rows_.push_back(row);
    }
    // Also before the start and after the end.
    for (Nanoseconds t = 0; t <= 2 * kFirstStep * kPeriod; t += kTick) {
      drives_[id].push_back({.t = t, .pose = {0.3e-9 * static_cast<double>(t), 1.0, 0.0}});
    }
  }

  [[nodiscard]] double cost(std::size_t from, std::size_t to) const {
    return automaton_->find({from}, {to}, test::kTestLabel)->criteria.front().value;
  }
  [[nodiscard]] DrivenCosts costs() const {
    return driven_costs(rows_, drives_, facts_, *automaton_);
  }

  std::shared_ptr<automaton::UniversalAutomaton> automaton_{
      test::make_test_automaton(test::paper_trims(), {{test::kTestLabel, 0.0}})};
  std::vector<result::StepRecord> rows_;
  result::Drives drives_;
  result::RunFacts facts_{.period = kPeriod, .steps = 4, .first_step = kFirstStep};
};

TEST_F(DrivenCostsTest, AreThoseOfTheManeuversPerMetreOfAllVehicles) {
  const double sum = 2.0 * (cost(0, 6) + cost(6, 6) + cost(6, 7));
  const double metres = 2.0 * 3.0 * 0.2 * 0.3;
  const DrivenCosts driven = costs();
  ASSERT_TRUE(driven.effort_per_m && driven.comfort_per_m);
  EXPECT_NEAR(*driven.effort_per_m, sum / metres, 1e-9 * sum / metres);
  EXPECT_NEAR(*driven.comfort_per_m, 1000.0 * sum / metres, 1e-6 * sum / metres);
}

TEST_F(DrivenCostsTest, AreNotKnownIfTheAutomatonDoesNotHoldAManeuver) {
  rows_[6].record.report.maneuver = "J1 0.3 J2 0.7";
  EXPECT_EQ(costs().effort_per_m, std::nullopt);
  EXPECT_EQ(costs().comfort_per_m, std::nullopt);
}

TEST_F(DrivenCostsTest, AreNotKnownIfAManeuverHasNoValueOfTheCriterion) {
  for (automaton::Maneuver& maneuver : automaton_->maneuvers) {
    if (maneuver.to == TrimId{7}) maneuver.criteria = {{"J2", 1.0}};
  }
  EXPECT_NE(costs().effort_per_m, std::nullopt);
  EXPECT_EQ(costs().comfort_per_m, std::nullopt);
}

TEST_F(DrivenCostsTest, AreNotKnownIfNobodyMoves) {
  for (auto& [id, drive] : drives_) {
    for (result::DrivenSample& sample : drive) sample.pose = {};
  }
  EXPECT_EQ(costs().effort_per_m, std::nullopt);
}

}  // namespace
}  // namespace hlc::campaign::driven_costs_test
