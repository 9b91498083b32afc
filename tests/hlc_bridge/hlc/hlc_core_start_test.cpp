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

/// The decisions of vehicle 1's controller, list by list.
class Start : public testing::Test {
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

  /// The list of the next step, noted.
  controller::Observation next_list(const Seen& seen) {
    list_.t_now += kListPeriod;
    list_.states = {
        {.vehicle_id = 1,
         .create_stamp = list_.t_now - 60'000'000,
         .valid_after_stamp = list_.t_now,
         .pose = compose(scenario::measured_start(red_alone(), red_alone().vehicles.front()),
                         seen.beside),
         .speed_mps = seen.speed_mps}};
    if (!seen.is_seen) list_.states.clear();
    controller::Observation observation = core_.observe(list_).value();
    core_.note(list_, observation);
    return observation;
  }

  /// ... true if the experiment begins with it or has begun.
  bool begins(const Seen& seen, std::optional<Nanoseconds> trigger) {
    const controller::Observation observation = next_list(seen);
    const bool begins = core_.begins(list_, observation, StartRule::kAtTrigger, trigger);
    if (!begins && core_.may_stand_by(observation, StartRule::kAtTrigger)) {
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

class RealTime : public Start {};

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

class LogicalTime : public Start {
 protected:
  void begin_with_list(std::uint64_t step) {
    list_.t_now = step * kListPeriod + kListOffset - kListPeriod;
  }
  bool may_stand_by(const Seen& seen) {
    return core_.may_stand_by(next_list(seen), StartRule::kTogether);
  }
};

TEST_F(LogicalTime, AVehicleThatIsSeenFromTheBeginOfTimeStandsByAtOnce) {
  begin_with_list(1);
  EXPECT_FALSE(may_stand_by({.is_seen = false}));
  EXPECT_TRUE(may_stand_by({})) << "nobody can have planned yet";
}

TEST_F(LogicalTime, OfARestartedControllerAVehicleIsLeftAloneUntilItHasStoodForAHorizon) {
  begin_with_list(16);
  EXPECT_FALSE(may_stand_by({.speed_mps = 0.1}));
  for (int i = 0; i < 7; ++i) EXPECT_FALSE(may_stand_by({})) << "its plan may be to wait and drive";
  EXPECT_TRUE(may_stand_by({}));
}

TEST_F(LogicalTime, ListsOfThePastInWhichTheVehicleIsNotSeenSayNothing) {
  begin_with_list(1);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(may_stand_by({.is_seen = false}));
  for (int i = 0; i < 7; ++i) EXPECT_FALSE(may_stand_by({}));
  EXPECT_TRUE(may_stand_by({}));
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_core_start_test
