#include "planner/coordination/guest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tests/support/num_seeds.hpp"

namespace hlc::coordination {
namespace {

constexpr double kTime_s = 1.8;
constexpr double kTick_s = 0.01;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Guest random_guest(std::mt19937_64& random) {
  return {.vehicle = {7},
          .footprint = {between(random, 0.1, 0.4), between(random, 0.05, 0.2)},
          .safety_margin_m = 0.01,
          .limits = {.speed_mps = between(random, 0.2, 2.0),
                     .acceleration_mps2 = between(random, 0.3, 4.0),
                     .deceleration_mps2 = between(random, 0.3, 8.0),
                     .curvature_per_m = between(random, 0.2, 6.0)}};
}

MeasuredVehicle random_state(const Guest& guest, std::mt19937_64& random) {
  return {.vehicle = guest.vehicle,
          .pose = {between(random, 0, 4), between(random, 0, 4), between(random, -9, 9)},
          .speed_mps = between(random, 0.0, guest.limits.speed_mps),
          .age_s = between(random, 0.0, 0.2)};
}

/// A motion of a guest: its true state at the stamp, as far from the measured one as the errors
/// allow, then constant or changing acceleration and curvature within its limits.
class Motion {
 public:
  Motion(const Guest& guest, const MeasuredVehicle& measured, std::mt19937_64& random)
      : limits_(guest.limits), random_(random), extreme_(between(random, 0.0, 1.0) < 0.7) {
    const GuestErrors errors;
    const double direction_rad = between(random, -9, 9);
    const double off_m = errors.position_m * between(random, 0.0, 1.0);
    pose_ = {measured.pose.x_m + off_m * std::cos(direction_rad),
             measured.pose.y_m + off_m * std::sin(direction_rad),
             measured.pose.heading_rad + errors.course_rad * between(random, -1.0, 1.0)};
    speed_mps_ = std::clamp(measured.speed_mps + errors.speed_mps * between(random, -1.0, 1.0), 0.0,
                            std::max(limits_.speed_mps, measured.speed_mps));
    choose();
  }

  [[nodiscard]] const Pose& pose() const { return pose_; }

  void advance() {
    if (!extreme_ && between(random_, 0.0, 1.0) < 0.1) choose();
    const double most_mps = std::max(speed_mps_, limits_.speed_mps);
    const double next_mps = std::clamp(speed_mps_ + acceleration_mps2_ * kTick_s, 0.0, most_mps);
    // The exact arc with the mean speed.
    const double way_m = 0.5 * (speed_mps_ + next_mps) * kTick_s;
    const double turn_rad = curvature_per_m_ * way_m;
    const double chord_m =
        std::abs(turn_rad) < 1e-9 ? way_m : way_m * std::sin(0.5 * turn_rad) / (0.5 * turn_rad);
    const double course_rad = pose_.heading_rad + 0.5 * turn_rad;
    pose_ = {pose_.x_m + chord_m * std::cos(course_rad), pose_.y_m + chord_m * std::sin(course_rad),
             pose_.heading_rad + turn_rad};
    speed_mps_ = next_mps;
  }

 private:
  [[nodiscard]] double share() {
    const double any = between(random_, -1.0, 1.0);
    return between(random_, 0.0, 1.0) < 0.6 ? std::copysign(1.0, any) : any;
  }
  void choose() {
    const double strength = share();
    acceleration_mps2_ = strength > 0.0 ? strength * limits_.acceleration_mps2
                                        : strength * limits_.deceleration_mps2;
    curvature_per_m_ = share() * limits_.curvature_per_m;
  }

  const GuestLimits& limits_;
  std::mt19937_64& random_;
  bool extreme_;
  Pose pose_;
  double speed_mps_{};
  double acceleration_mps2_{};
  double curvature_per_m_{};
};

TEST(ReachableArea, HoldsTheFootprintOfEveryMotionWithinTheLimits) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Guest guest = random_guest(random);
    const MeasuredVehicle measured = random_state(guest, random);
    const double from_s = between(random, 0.0, kTime_s);
    const double to_s = from_s + between(random, 0.0, 0.3);
    const ConvexPolygon area = reachable_area(guest, measured, from_s, to_s);
    for (int i = 0; i < 40; ++i) {
      Motion motion(guest, measured, random);
      const int ticks = static_cast<int>((to_s + measured.age_s) / kTick_s);
      for (int tick = 1; tick <= ticks; ++tick) {
        motion.advance();
        const double time_s = tick * kTick_s - measured.age_s;
        if (time_s < from_s) continue;
        const ConvexPolygon footprint =
            footprint_area(guest.footprint, motion.pose(), guest.safety_margin_m);
        ASSERT_TRUE(contains(area, footprint, 1e-3)) << "motion " << i << " at " << time_s << " s";
      }
    }
  }
}

/// Without errors and size its sides lie where the farthest motions end.
TEST(ReachableArea, IsNoLargerThanTheFarthestMotionsNeed) {
  const Guest guest{.vehicle = {7}, .footprint = {}, .limits = {1.0, 2.0, 4.0, 3.0}};
  const MeasuredVehicle measured{
      .vehicle = {7}, .pose = {1.0, 2.0, 0.0}, .speed_mps = 0.4, .age_s = 0.0};
  const ConvexPolygon area =
      reachable_area(guest, measured, 0.0, 0.6, {.position_m = 0, .course_rad = 0, .speed_mps = 0});
  const Box box = bounding_box(area);
  // Accelerates for 0.3 s, then drives straight on for as long.
  EXPECT_NEAR(box.max_m.x(), 1.0 + 0.5 * 2.0 * 0.09 + 0.4 * 0.3 + 1.0 * 0.3, 1e-9);
  EXPECT_NEAR(box.min_m.x(), 1.0, 1e-9);  // brakes at once: it does not go back
  // Turns as tightly as it can, 0.51 m along a circle of 1/3 m: less than a right angle.
  EXPECT_NEAR(box.max_m.y() - 2.0, (1.0 - std::cos(3.0 * 0.51)) / 3.0, 1e-9);
  EXPECT_NEAR(2.0 - box.min_m.y(), box.max_m.y() - 2.0, 1e-9);
}

TEST(ReachableArea, OfALaterStateLiesInThatOfTheEarlierOne) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Guest guest = random_guest(random);
    const MeasuredVehicle earlier = random_state(guest, random);
    const GuestErrors none{.position_m = 0.0, .course_rad = 0.0, .speed_mps = 0.0};
    const double passed_s = 0.2;
    const double from_s = passed_s + between(random, 0.0, 1.0);
    const double to_s = from_s + 0.2;
    const ConvexPolygon before = reachable_area(guest, earlier, from_s, to_s, none);
    // Full speed straight on, or braking: exactly known states a step later.
    for (const bool brakes : {true, false}) {
      MeasuredVehicle later = earlier;
      later.age_s = 0.0;
      const double time_s = earlier.age_s + passed_s;
      const double change_mps2 =
          brakes ? -guest.limits.deceleration_mps2 : guest.limits.acceleration_mps2;
      const double until_s =
          std::min(time_s, brakes ? earlier.speed_mps / guest.limits.deceleration_mps2
                                  : (guest.limits.speed_mps - earlier.speed_mps) / change_mps2);
      later.speed_mps = std::max(0.0, earlier.speed_mps + change_mps2 * until_s);
      const double way_m = earlier.speed_mps * until_s + 0.5 * change_mps2 * until_s * until_s +
                           later.speed_mps * (time_s - until_s);
      later.pose = compose(earlier.pose, {way_m, 0.0, 0.0});
      const ConvexPolygon after =
          reachable_area(guest, later, from_s - passed_s, to_s - passed_s, none);
      EXPECT_TRUE(contains(before, after, 1e-9)) << (brakes ? "brakes" : "accelerates");
    }
  }
}

TEST(ReachableArea, AGuestFasterThanItsLimitIsExpectedToStaySo) {
  const Guest guest{.vehicle = {7}, .footprint = {0.2, 0.1}, .limits = {0.5, 1.0, 2.0, 3.0}};
  const MeasuredVehicle measured{.vehicle = {7}, .pose = {0.0, 0.0, 0.0}, .speed_mps = 1.0};
  EXPECT_TRUE(contains(reachable_area(guest, measured, 0.8, 1.0),
                       footprint_area(guest.footprint, {1.0, 0.0, 0.0}), 0.0));
}

}  // namespace
}  // namespace hlc::coordination
