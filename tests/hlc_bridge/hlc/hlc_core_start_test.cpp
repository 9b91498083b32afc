#include "hlc_bridge/hlc/hlc_core.hpp"

#include <gtest/gtest.h>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::hlc_core_start_test {
namespace {

constexpr Nanoseconds kListPeriod = 200'000'000;

const scenario::Scenario& red_alone() {
  static const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"});
  return scenario;
}

/// The decisions of vehicle 1's controller in real time, list by list.
class RealTime : public testing::Test {
 protected:
  struct Seen {
    Pose beside{};  ///< seen from where the scenario has the vehicle
    double speed_mps{};
    bool is_seen{true};
  };

  void stand_for_a_horizon() {
    for (int i = 0; i < 8; ++i) EXPECT_FALSE(begins({}, std::nullopt));
    EXPECT_TRUE(core_.controller().has_plan());
  }

  /// The list of the next step; true if the experiment begins with it or has begun.
  bool begins(const Seen& seen, std::optional<Nanoseconds> trigger) {
    list_.t_now += kListPeriod;
    list_.states = {
        {.vehicle_id = 1,
         .create_stamp = list_.t_now - 60'000'000,
         .valid_after_stamp = list_.t_now,
         .pose = compose(scenario::measured_start(red_alone(), red_alone().vehicles.front()),
                         seen.beside),
         .speed_mps = seen.speed_mps}};
    if (!seen.is_seen) list_.states.clear();
    const controller::Observation observation = core_.observe(list_).value();
    core_.note(list_, observation);
    const bool begins = core_.begins(list_, observation, StartRule::kAtTrigger, trigger);
    if (!begins && core_.may_stand_by(observation)) {
      static_cast<void>(core_.controller().stand_by(observation));
    }
    return begins;
  }

  HlcCore core_{scenario::make_controller(red_alone(), {1})};
  VehicleStateList list_{.t_now = 1000 * kListPeriod + kListOffset,
                         .period_ms = 200,
                         .states = {},
                         .observations = {},
                         .active_vehicle_ids = {1}};
};

TEST_F(RealTime, BeginsWithTheFirstListAfterTheTriggersTime) {
  stand_for_a_horizon();
  const Nanoseconds trigger = list_.t_now + 2 * kListPeriod;
  EXPECT_FALSE(begins({}, std::nullopt));
  EXPECT_TRUE(begins({}, trigger));
  EXPECT_TRUE(begins({.speed_mps = 0.5}, trigger)) << "it has begun";
}

TEST_F(RealTime, AVehicleThatMovesOrIsNotSeenIsLeftAloneUntilItHasStoodForAHorizon) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(begins({.speed_mps = 0.5}, 1));
  for (int i = 0; i < 7; ++i) EXPECT_FALSE(begins({}, 1)) << "its plan may be to wait and drive";
  EXPECT_FALSE(begins({.is_seen = false}, 1));
  for (int i = 0; i < 7; ++i) EXPECT_FALSE(begins({}, 1));
  EXPECT_FALSE(core_.controller().has_plan());
  EXPECT_TRUE(core_.answer(list_).command.points.empty());
  EXPECT_FALSE(begins({}, 1)) << "stands by once";
  EXPECT_TRUE(core_.controller().has_plan());
  EXPECT_FALSE(begins({.speed_mps = 0.5}, 1)) << "it is moved";
  EXPECT_FALSE(begins({.is_seen = false}, 1));
  EXPECT_TRUE(begins({}, 1));
}

TEST_F(RealTime, AVehicleWhosePoseJumpsIsNotTrusted) {
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(begins({.beside = {0.0, 2.0 * (i % 2), 0.0}}, 1));
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(begins({}, 1));
    EXPECT_FALSE(core_.controller().has_plan()) << i;
  }
  EXPECT_FALSE(begins({}, 1));
  EXPECT_TRUE(core_.controller().has_plan());
}

TEST_F(RealTime, AVehicleThatFitsNoRouteDoesNotBegin) {
  const Seen turned{.beside = {0.0, 0.0, 2.0}};
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(begins(turned, 1));
  EXPECT_TRUE(core_.controller().has_plan()) << "to stand";
  EXPECT_FALSE(begins({}, 1));
  EXPECT_TRUE(begins({}, 1)) << "it has been put right";
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_core_start_test
