#include "planner/controller/neighbours.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::controller::neighbours_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kHorizon = 2;
const std::vector<VehicleId> kActive{{1}, {2}, {3}};

/// Vehicle 1 looks; all stand.
class NeighboursTest : public testing::Test {
 protected:
  /// A step in which the vehicles of `received` are received and those of `present` are there.
  /// The received ones list `unheard` as silent.
  void step(const std::vector<std::uint8_t>& received, std::vector<VehicleId> present = {},
            const std::vector<VehicleId>& unheard = {}) {
    ++now_.value;
    neighbours_.begin_step(now_);
    silent_ = neighbours_.silent(kActive);
    std::vector<coordination::Traffic> traffic;
    for (const std::uint8_t vehicle : received) {
      traffic.push_back(traffic_of(vehicle, now_));
      traffic.back().silent = unheard;
    }
    traffic.push_back(traffic_of(9, now_));              // takes no part
    traffic.push_back(traffic_of(3, {now_.value - 1}));  // of another step
    Observation observation{.step = now_, .active = kActive, .states = {}, .present = present};
    for (const VehicleId vehicle : kActive) observation.states.push_back({.vehicle = vehicle});
    neighbours_.receive(traffic, observation);
  }

  static coordination::Traffic traffic_of(std::uint8_t vehicle, StepIndex step) {
    const ConvexPolygon area = footprint_area({1.0, 1.0}, {});
    return {.vehicle = {vehicle},
            .step = step,
            .running = {.first = step, .areas_m = {}, .final_area_m = area},
            .reachable_area_m = area};
  }

  Neighbours neighbours_{{1}, {}};
  StepIndex now_{100};
  std::vector<VehicleId> silent_;
};

TEST_F(NeighboursTest, ReceivedIsWhoSentTrafficOfTheStep) {
  step({3, 2});
  ASSERT_EQ(neighbours_.received().size(), 2U);
  EXPECT_EQ(neighbours_.received().front()->vehicle, VehicleId{2});
  step({2});
  ASSERT_EQ(neighbours_.received().size(), 1U);
  EXPECT_THAT(neighbours_.missing(), ElementsAre(VehicleId{3}));
  neighbours_.begin_step({now_.value + 1});
  EXPECT_THAT(neighbours_.received(), IsEmpty());
}

TEST_F(NeighboursTest, SilentIsWhoWasNotReceivedForSomeSteps) {
  step({2, 3});
  for (std::uint64_t i = 1; i < coordination::kSilentSteps; ++i) step({3});
  EXPECT_THAT(silent_, IsEmpty());
  step({3});
  EXPECT_THAT(silent_, ElementsAre(VehicleId{2}));
  step({2, 3});
  step({2, 3});
  EXPECT_THAT(silent_, IsEmpty());
}

TEST_F(NeighboursTest, WhoIsSilentButPresentNeverStandsForGood) {
  for (int i = 0; i < 20; ++i) step({}, {{2}});
  EXPECT_FALSE(neighbours_.stands_for_good({2}, kHorizon));
  EXPECT_TRUE(neighbours_.stands_for_good({3}, kHorizon));
}

TEST_F(NeighboursTest, WhoIsSilentButReceivedByAnotherNeverStandsForGood) {
  for (int i = 0; i < 20; ++i) step({3});
  EXPECT_FALSE(neighbours_.stands_for_good({2}, kHorizon));
  for (int i = 0; i < 20; ++i) step({3}, {}, {{2}});
  EXPECT_TRUE(neighbours_.stands_for_good({2}, kHorizon));
}

TEST_F(NeighboursTest, StepsInWhichNobodyWasLookedAtShowNobodyStanding) {
  for (int i = 0; i < 20; ++i) step({3});
  now_.value += 20;  // the own process did not run
  step({});
  EXPECT_FALSE(neighbours_.stands_for_good({2}, kHorizon));
  EXPECT_FALSE(neighbours_.stands_for_good({3}, kHorizon));
  for (int i = 0; i < 20; ++i) step({});
  EXPECT_TRUE(neighbours_.stands_for_good({2}, kHorizon));
  EXPECT_TRUE(neighbours_.stands_for_good({3}, kHorizon));
}

TEST_F(NeighboursTest, WhoReceivesNobodyIsCutOffUnlessAllStandForGood) {
  step({});
  EXPECT_FALSE(neighbours_.is_cut_off(kHorizon));  // nobody was ever there
  step({2, 3});
  EXPECT_FALSE(neighbours_.is_cut_off(kHorizon));
  step({3});
  EXPECT_FALSE(neighbours_.is_cut_off(kHorizon));
  step({});
  EXPECT_TRUE(neighbours_.is_cut_off(kHorizon));
  for (int i = 0; i < 20; ++i) step({}, {{2}});
  EXPECT_TRUE(neighbours_.is_cut_off(kHorizon));
  for (int i = 0; i < 20; ++i) step({});
  EXPECT_FALSE(neighbours_.is_cut_off(kHorizon));
}

TEST_F(NeighboursTest, WhoHasReceivedNobodyYetIsCutOffWhileAProcessIsPresent) {
  step({}, {{2}});
  EXPECT_TRUE(neighbours_.is_cut_off(kHorizon));
  step({3}, {{2}});
  EXPECT_FALSE(neighbours_.is_cut_off(kHorizon));
}

}  // namespace
}  // namespace hlc::controller::neighbours_test
