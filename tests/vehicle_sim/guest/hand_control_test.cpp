#include "vehicle_sim/guest/hand_control.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/support/num_seeds.hpp"

namespace hlc::guest::hand_control_test {
namespace {

constexpr coordination::GuestLimits kLimits{
    .speed_mps = 1.0, .acceleration_mps2 = 1.5, .deceleration_mps2 = 3.0, .curvature_per_m = 4.0};

HandControl control() { return {VehicleId{9}, kLimits}; }

TEST(HandControl, KeysChangeWhatIsWantedAndLetItStay) {
  HandControl hand = control();
  hand.type("www");
  EXPECT_NEAR(hand.speed_mps(), 0.3, 1e-12);
  hand.type("s");
  EXPECT_NEAR(hand.speed_mps(), 0.2, 1e-12);
  hand.type("aa");
  EXPECT_EQ(hand.curvature_per_m(), 2.0);
  hand.type("ddd");
  EXPECT_EQ(hand.curvature_per_m(), -1.0);
  hand.type("x");
  EXPECT_EQ(hand.curvature_per_m(), 0.0);
  hand.type(" ");
  EXPECT_EQ(hand.speed_mps(), 0.0);
  EXPECT_FALSE(hand.is_over());
  hand.type("wq");
  EXPECT_TRUE(hand.is_over());
  EXPECT_EQ(hand.speed_mps(), 0.0);
}

TEST(HandControl, ArrowsAreKeysAlsoInPieces) {
  HandControl hand = control();
  hand.type("\x1b[A\x1bOA\x1b[D");
  EXPECT_NEAR(hand.speed_mps(), 0.2, 1e-12);
  EXPECT_EQ(hand.curvature_per_m(), 1.0);
  for (const char* piece : {"\x1b", "[", "B"}) hand.type(piece);
  EXPECT_NEAR(hand.speed_mps(), 0.1, 1e-12);
  hand.type("\x1b[C");
  EXPECT_EQ(hand.curvature_per_m(), 0.0);
  hand.type("\x1b[Hw");
  EXPECT_NEAR(hand.speed_mps(), 0.2, 1e-12) << "another key has no effect, the next one has";
}

TEST(HandControl, AnAxisGivesItsShare) {
  HandControl hand = control();
  hand.push(1, -32767);
  EXPECT_EQ(hand.speed_mps(), 1.0);
  hand.push(0, 32767 / 2);
  EXPECT_NEAR(hand.curvature_per_m(), -2.0, 1e-3);
  hand.push(0, 1000);
  EXPECT_EQ(hand.curvature_per_m(), 0.0) << "not pushed";
  hand.push(1, 32767);
  EXPECT_EQ(hand.speed_mps(), 0.0) << "it does not drive backwards";
  hand.push(5, -32767);
  EXPECT_EQ(hand.speed_mps(), 0.0);
}

TEST(HandControl, CommandsStayWithinTheLimitsWhateverIsTyped) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(50); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HandControl hand = control();
    double before_mps = 0.0;
    for (Nanoseconds tick = 0; tick < 500; ++tick) {
      const std::string keys("wwwsadx \x1b[A");
      hand.type({&keys[random() % keys.size()], 1});
      if (random() % 10 == 0) {
        hand.push(static_cast<unsigned>(random() % 2), static_cast<int>(random() % 65536) - 32768);
      }
      const DriverCommand command = hand.tick(tick * kVehiclePeriod);
      double speed_mps = 0.0;
      if (const auto* driven = std::get_if<SpeedCurvatureCommand>(&command)) {
        speed_mps = driven->speed_mps;
        ASSERT_LE(std::abs(driven->curvature_per_m), kLimits.curvature_per_m);
      }
      ASSERT_GE(speed_mps, 0.0);
      ASSERT_LE(speed_mps, kLimits.speed_mps);
      ASSERT_LE(speed_mps - before_mps, 0.02 * kLimits.acceleration_mps2 + 1e-12);
      before_mps = speed_mps;
    }
  }
}

}  // namespace
}  // namespace hlc::guest::hand_control_test
