#include "planner/coordination/joint_gap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace hlc::coordination::joint_gap_test {
namespace {

Report report_of(std::uint8_t vehicle, std::vector<VehicleId> coupled, double cost_m2,
                 std::optional<double> bound_m2) {
  return {.vehicle = {vehicle},
          .cost_m2 = cost_m2,
          .bound_m2 = bound_m2,
          .coupled = std::move(coupled)};
}

std::vector<JointGap> gaps_of(const std::vector<Report>& reports) {
  std::vector<const Report*> pointers;
  for (const Report& report : reports) pointers.push_back(&report);
  return joint_gaps(pointers);
}

TEST(JointGap, AddsCostsAndBoundsOfAComponent) {
  const auto gaps = gaps_of({report_of(5, {{1}}, 0.3, 0.2), report_of(1, {{5}, {2}}, 0.2, 0.2),
                             report_of(2, {{1}}, 0.5, 0.4), report_of(3, {}, 9.0, 1.0),
                             report_of(7, {{8}}, 0.1, 0.1), report_of(8, {{7}}, 0.1, 0.1)});
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_EQ(gaps[0].vehicles, (std::vector<VehicleId>{{1}, {2}, {5}}));
  ASSERT_TRUE(gaps[0].is_known);
  EXPECT_NEAR(gaps[0].cost_m2, 1.0, 1e-12);
  EXPECT_NEAR(gaps[0].bound_m2, 0.8, 1e-12);
  EXPECT_FALSE(gaps[0].is_closed());
  EXPECT_NEAR(gaps[0].excess(), 0.25, 1e-12);
  EXPECT_EQ(text_of(gaps[0]), "at most 25.0 % above the joint optimum of 3 vehicles");
  EXPECT_TRUE(gaps[1].is_closed());
  EXPECT_EQ(gaps[1].excess(), 0.0);
  EXPECT_EQ(text_of(gaps[1]), "the joint optimum of 2 vehicles");
}

/// Whoever has no plan, or is coupled without a report, leaves the gap of its component open.
TEST(JointGap, IsUnknownIfAVehicleHasNoPlan) {
  for (const auto& reports :
       {std::vector{report_of(1, {{2}}, 0.1, 0.1), report_of(2, {{1}}, 0.1, std::nullopt)},
        std::vector{report_of(1, {{2}}, 0.1, 0.1)}}) {
    const auto gaps = gaps_of(reports);
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_FALSE(gaps[0].is_known);
    EXPECT_EQ(text_of(gaps[0]), "at an unknown distance from the joint optimum of 2 vehicles");
  }
  EXPECT_TRUE(gaps_of({report_of(1, {}, 0.1, std::nullopt)}).empty());
  EXPECT_TRUE(gaps_of({}).empty());
}

/// Vehicle 1's bound keeps clear of everything that vehicle 2 can reach.
TEST(JointGap, IsUnknownIfAVehicleMissesAnotherOne) {
  std::vector<Report> reports{report_of(1, {{3}}, 0.1, 0.1), report_of(2, {{3}}, 0.1, 0.1),
                              report_of(3, {{1}, {2}}, 0.1, 0.1)};
  EXPECT_TRUE(gaps_of(reports).front().is_known);
  reports[0].missing = {{4}};
  EXPECT_TRUE(gaps_of(reports).front().is_known);
  reports[0].missing = {{2}};
  EXPECT_FALSE(gaps_of(reports).front().is_known);
}

TEST(JointGap, OneSidedCouplingConnectsToo) {
  const auto gaps = gaps_of({report_of(1, {}, 0.1, 0.1), report_of(2, {{1}}, 0.2, 0.1)});
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_NEAR(gaps[0].excess(), 0.5, 1e-12);
}

TEST(JointGap, FiguresOfManyStepsAreRanks) {
  std::vector<JointGap> gaps(
      200, {.vehicles = {{1}, {2}}, .is_known = true, .cost_m2 = 1.0, .bound_m2 = 1.0});
  gaps[0].cost_m2 = 4.0;
  gaps[1].cost_m2 = 3.0;
  gaps[2].cost_m2 = 1.5;
  gaps.push_back({.vehicles = {{1}, {2}}});
  const auto figures = joint_gap_figures(gaps);
  ASSERT_TRUE(figures.has_value());
  EXPECT_EQ(figures->known, 200U);
  EXPECT_EQ(figures->unknown, 1U);
  EXPECT_EQ(figures->closed, 197U);
  EXPECT_EQ(figures->median, 0.0);
  EXPECT_NEAR(figures->p99, 0.5, 1e-12) << "198 of 200 do not exceed it";
  EXPECT_NEAR(figures->total, 5.5 / 200.0, 1e-12);
  EXPECT_EQ(
      text_of(*figures),
      "the joint optimum in 98.5 % of 200 cases, at most 50.0 % above it in 99 %, 2.8 % in all "
      "together");
  EXPECT_FALSE(joint_gap_figures({}).has_value());
  EXPECT_FALSE(joint_gap_figures(std::vector{gaps.back()}).has_value());
}

TEST(JointGap, ABoundOfNothingIsUnboundedAbove) {
  const JointGap gap{.vehicles = {{1}, {2}}, .is_known = true, .cost_m2 = 0.1, .bound_m2 = 0.0};
  EXPECT_TRUE(std::isinf(gap.excess()));
  EXPECT_EQ(text_of(gap), "at most any amount above the joint optimum of 2 vehicles");
  EXPECT_EQ(text_of({.vehicles = {{1}, {2}}, .is_known = true, .cost_m2 = 30.0, .bound_m2 = 2.0}),
            "at most 1400.0 % above the joint optimum of 2 vehicles");
}

}  // namespace
}  // namespace hlc::coordination::joint_gap_test
