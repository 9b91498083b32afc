#include "planner/controller/drivable_area.hpp"

#include <gtest/gtest.h>

namespace hlc::controller::drivable_area_test {
namespace {

constexpr std::size_t kHorizon = 8;

/// A vehicle whose entry is looked for `num_looks` times.
class DrivableAreaTest : public testing::Test {
 protected:
  /// A step in which the plan has ended and stays.
  void stand(DrivableArea& area, bool in_lanes) { step(area, true, true, in_lanes); }
  /// A step in which the plan moves on.
  void drive(DrivableArea& area, bool in_lanes) { step(area, false, false, in_lanes); }

  LaneEntry found_{};  ///< what a look finds
  int num_looks_{};

 private:
  void step(DrivableArea& area, bool is_ended, bool stands, bool in_lanes) {
    area.update_drivable_area({.next = {++next_},
                               .is_ended = is_ended,
                               .stands = stands,
                               .lies_in_lanes = [in_lanes] { return in_lanes; },
                               .find_entry =
                                   [this] {
                                     ++num_looks_;
                                     return found_;
                                   }});
  }

  std::uint64_t next_{100};
};

TEST_F(DrivableAreaTest, OneThatDepartsBesideItsLanesHasAnAreaUntilItsPlanLiesInThem) {
  DrivableArea area(&once_per_horizon, kHorizon);
  found_.area = road::Corridor{};
  area.depart();
  stand(area, false);
  EXPECT_EQ(num_looks_, 1);
  EXPECT_TRUE(area.entry_area());
  drive(area, false);
  EXPECT_TRUE(area.entry_area());
  drive(area, true);
  EXPECT_FALSE(area.entry_area());
  EXPECT_EQ(num_looks_, 1);
}

TEST_F(DrivableAreaTest, OneWithoutAWaySaysWhyAndLooksAgainOnAnotherSubgraphOnly) {
  DrivableArea area(&once_per_horizon, kHorizon);
  found_ = {.is_possible = false, .is_certain = true, .area = std::nullopt};
  area.depart();
  stand(area, false);
  EXPECT_EQ(area.obstacle(), coordination::FallbackReason::kOffRoute);
  for (std::size_t i = 0; i < 3 * kHorizon; ++i) stand(area, false);
  EXPECT_EQ(num_looks_, 1);
  found_.is_certain = false;
  area.note_switch();
  stand(area, false);
  EXPECT_EQ(num_looks_, 2);
  EXPECT_EQ(area.obstacle(), coordination::FallbackReason::kBudget);
}

TEST_F(DrivableAreaTest, OneThatStandsInItsLanesLooksForAWayOutOnceInEveryHorizon) {
  DrivableArea area(&once_per_horizon, kHorizon);
  for (std::size_t i = 0; i <= 2 * kHorizon; ++i) stand(area, true);
  EXPECT_EQ(num_looks_, 2);
  EXPECT_FALSE(area.entry_area()) << "none was found: it may wait for another vehicle";
  found_.area = road::Corridor{};
  for (std::size_t i = 0; i < kHorizon; ++i) stand(area, true);
  EXPECT_EQ(num_looks_, 3);
  EXPECT_TRUE(area.entry_area());
}

TEST_F(DrivableAreaTest, WithoutATimeoutOneThatStandsInItsLanesStaysInThem) {
  DrivableArea area(&no_timeout, kHorizon);
  for (std::size_t i = 0; i < 3 * kHorizon; ++i) stand(area, true);
  EXPECT_EQ(num_looks_, 0);
}

}  // namespace
}  // namespace hlc::controller::drivable_area_test
