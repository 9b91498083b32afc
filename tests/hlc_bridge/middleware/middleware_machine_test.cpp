#include "hlc_bridge/middleware/middleware_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

namespace hlc::middleware {
namespace {

using test::command;
using test::kMs;
using test::kPeriod;
using test::published_state;
using testing::ElementsAre;

constexpr Nanoseconds kTick0 = kListOffset;
constexpr Nanoseconds kTick1 = kPeriod + kListOffset;
constexpr Nanoseconds kTick2 = 2 * kPeriod + kListOffset;
constexpr Nanoseconds kStartupTimeout = 30 * kNanosecondsPerSecond;

// --- start and end, whatever the rules ----------------------------------------------------------

class MiddlewareStartTest : public testing::Test {
 protected:
  test::MiddlewareInMemory run_{{.vehicle_ids = {1},
                                 .startup_timeout = kStartupTimeout,
                                 .rules = logical_middleware_rules(false)}};
};

TEST_F(MiddlewareStartTest, AsksForTheParametersUntilTheyAreTold) {
  run_.begin_in_logical_time();
  run_.advance();
  EXPECT_EQ(run_.all<ParameterRequest>().size(), 2U);
  ASSERT_TRUE(run_.machine().wake_up().wall);
  run_.wait(*run_.machine().wake_up().wall - run_.now().wall);
  EXPECT_EQ(run_.all<ParameterRequest>().size(), 4U);
  run_.publish_parameters(200, {1, 2});
  ASSERT_EQ(run_.all<SubscribeToVehicles>().size(), 1U);
  EXPECT_THAT(run_.all<SubscribeToVehicles>()[0].vehicle_ids, ElementsAre(1, 2));
  EXPECT_FALSE(run_.machine().wake_up().run) << "asks for no tick before all are connected";
  run_.on(run_.all_present({1, 2}));
  EXPECT_EQ(run_.machine().wake_up().run, kTick0);
}

TEST_F(MiddlewareStartTest, EndsIfTheLabControlTellsNothing) {
  run_.advance();
  run_.wait(kStartupTimeout - 1);
  EXPECT_FALSE(run_.machine().exit_code());
  run_.wait(1);
  EXPECT_EQ(run_.machine().exit_code(), kExitMissing);
  EXPECT_EQ(run_.count_lines("lab_control"), 2U) << "a notice, and the error";
}

TEST_F(MiddlewareStartTest, NamesWhoeverDoesNotAppearInTime) {
  run_.publish_parameters(200, {1, 2});
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.controllers_are_matched = false;
  peers.state_publishers.erase(2);
  peers.command_subscribers.erase(1);
  run_.on(peers);
  run_.wait(kStartupTimeout);
  EXPECT_EQ(run_.machine().exit_code(), kExitMissing);
  EXPECT_EQ(run_.count_lines("missing after 30 s: high_level_controller_1, "
                             "vehicle_raspberry_1, vehicle_raspberry_2"),
            1U);
}

TEST_F(MiddlewareStartTest, RefusesParametersWithoutItsVehicle) {
  run_.publish_parameters(200, {2, 3});
  EXPECT_EQ(run_.machine().exit_code(), kExitBadInput);
  EXPECT_EQ(run_.count_lines(kActiveIdsParameter), 1U);
}

TEST_F(MiddlewareStartTest, StopEndsItBeforeTheLabControlHasToldAnything) {
  run_.advance();
  run_.on(machine::StopSignal{});
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

// --- with patience: logical time ----------------------------------------------------------------

class PatientMiddlewareTest : public testing::Test {
 protected:
  explicit PatientMiddlewareTest(std::vector<std::uint8_t> vehicle_ids = {1},
                                 bool beside_lab_programs = false)
      : run_{{.vehicle_ids = std::move(vehicle_ids),
              .startup_timeout = kStartupTimeout,
              .rules = logical_middleware_rules(beside_lab_programs)}} {
    run_.begin_in_logical_time();
    run_.publish_parameters(200, {1, 2});
    run_.on(run_.all_present({1, 2}));
  }

  /// The tick that the machine asks for; nothing while it has not done the last one.
  [[nodiscard]] std::optional<Nanoseconds> wanted() const { return run_.machine().wake_up().run; }
  void drive_through(Nanoseconds tick) {
    run_.release(tick);
    run_.on(command(1, tick));
    ASSERT_EQ(wanted(), tick + kPeriod);
  }

  test::MiddlewareInMemory run_;
};

TEST_F(PatientMiddlewareTest, FirstListHasPlaceholdersAndTheNextTickIsAskedForAfterTheAnswer) {
  ASSERT_EQ(wanted(), kTick0);
  run_.advance();
  EXPECT_TRUE(run_.all<VehicleStateList>().empty()) << "the tick has not been released";
  run_.release(kTick0);
  ASSERT_EQ(run_.all<VehicleStateList>().size(), 1U);
  const VehicleStateList list = run_.all<VehicleStateList>()[0];
  EXPECT_EQ(list.t_now, kTick0);
  ASSERT_EQ(list.states.size(), 2U);
  EXPECT_EQ(list.states[0].vehicle_id, 0);
  EXPECT_FALSE(wanted());
  run_.on(command(1, kTick0));
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U);
  EXPECT_EQ(wanted(), kTick1);
}

TEST_F(PatientMiddlewareTest, ListWaitsForTheStatesThatBelongInIt) {
  drive_through(kTick0);
  EXPECT_EQ(run_.machine().awaited(), machine::kOnlyUrgent);
  run_.on(published_state(1, 140 * kMs));
  run_.release(kTick1);
  EXPECT_EQ(run_.machine().awaited(), 1U);
  run_.on(published_state(2, 120 * kMs));  // valid, but not the newest one
  run_.on(published_state(1, 160 * kMs));  // not yet valid
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 1U);
  run_.on(published_state(2, 140 * kMs));
  ASSERT_EQ(run_.all<VehicleStateList>().size(), 2U);
  EXPECT_EQ(run_.all<VehicleStateList>()[1].states[0].create_stamp, 140 * kMs);
  EXPECT_EQ(run_.all<VehicleStateList>()[1].states[1].create_stamp, 140 * kMs);
}

TEST_F(PatientMiddlewareTest, ASilentVehicleIsNotWaitedForUntilItsNextState) {
  drive_through(kTick0);
  run_.on(published_state(1, 140 * kMs));
  run_.release(kTick1);
  run_.wait(kMessageTimeout - 1);
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 1U);
  run_.wait(1);
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 2U);
  EXPECT_EQ(run_.count_lines("vehicle_raspberry_2: no message for 10 s; no longer waiting"), 1U);
  run_.on(command(1, kTick1));

  run_.on(published_state(1, 340 * kMs));
  run_.release(kTick2);
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 3U);
  run_.on(command(1, kTick2));

  run_.on(published_state(2, 400 * kMs));
  run_.on(published_state(1, 540 * kMs));
  run_.release(kTick2 + kPeriod);
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 3U) << "it is waited for again";
}

TEST_F(PatientMiddlewareTest, AVehicleThatIsGoneIsNotWaitedFor) {
  drive_through(kTick0);
  run_.on(published_state(1, 140 * kMs));
  run_.release(kTick1);
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 1U);
  run_.on(run_.all_present({1}));
  EXPECT_EQ(run_.all<VehicleStateList>().size(), 2U);
}

TEST_F(PatientMiddlewareTest, ASilentControllerIsNotWaitedForUntilItsNextCommand) {
  run_.release(kTick0);
  EXPECT_EQ(run_.machine().wake_up().wall, run_.now().wall + kMessageTimeout);
  run_.wait(kMessageTimeout);
  EXPECT_EQ(wanted(), kTick1);
  EXPECT_EQ(run_.count_lines("high_level_controller_1: no message for 10 s"), 1U);
  run_.on(published_state(1, 140 * kMs));
  run_.on(published_state(2, 140 * kMs));
  run_.release(kTick1);
  EXPECT_EQ(wanted(), kTick2);
  run_.on(command(1, kTick0));
  EXPECT_EQ(wanted(), kTick2) << "the tick is done";
  run_.on(published_state(1, 340 * kMs));
  run_.on(published_state(2, 340 * kMs));
  run_.release(kTick2);
  EXPECT_FALSE(wanted());
}

TEST_F(PatientMiddlewareTest, AControllerThatIsLostIsNotWaitedFor) {
  run_.release(kTick0);
  EXPECT_FALSE(wanted());
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.lost_controllers = {1};
  run_.on(peers);
  EXPECT_EQ(wanted(), kTick1);
}

TEST_F(PatientMiddlewareTest, NobodyIsWaitedForIfNobodySendsCommands) {
  run_.release(kTick0);
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.commands_are_sent = false;
  run_.on(peers);
  EXPECT_EQ(wanted(), kTick1);
}

TEST_F(PatientMiddlewareTest, ForwardsTheFirstTriggerAndTheStopSymbolAlone) {
  for (const Nanoseconds t : {Nanoseconds{0}, kTick0, 20 * kMs, kStopSymbol}) {
    run_.on(SystemTrigger{t});
  }
  ASSERT_EQ(run_.all<SystemTrigger>().size(), 2U);
  EXPECT_EQ(run_.all<SystemTrigger>()[0].next_start, 0U);
  EXPECT_EQ(run_.all<SystemTrigger>()[1].next_start, kStopSymbol);
}

TEST_F(PatientMiddlewareTest, TheStopSymbolIsForwardedBeforeItEnds) {
  drive_through(kTick0);
  run_.on(SystemTrigger{kStopSymbol});
  EXPECT_EQ(run_.all<SystemTrigger>().back().next_start, kStopSymbol);
  EXPECT_FALSE(run_.machine().exit_code()) << "the controllers are to leave first";
  run_.on(command(1, kTick0));
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U) << "kept back";
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.commands_are_sent = false;
  run_.on(peers);
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

TEST_F(PatientMiddlewareTest, ControllersThatStayAreNotWaitedForLong) {
  drive_through(kTick0);
  run_.on(SystemTrigger{kStopSymbol});
  ASSERT_EQ(run_.machine().wake_up().wall, run_.now().wall + MiddlewareMachine::kLeaveTime);
  run_.wait(MiddlewareMachine::kLeaveTime);
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

TEST_F(PatientMiddlewareTest, StopEndsItWhileItWaits) {
  run_.release(kTick0);
  run_.on(machine::StopSignal{});
  EXPECT_EQ(run_.machine().exit_code(), kExitGood) << "at once: controllers know of no stop";
}

TEST_F(PatientMiddlewareTest, ALostLabControlEndsItAtOnce) {
  drive_through(kTick0);
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.lab_control_is_lost = true;
  run_.on(peers);
  EXPECT_EQ(run_.machine().exit_code(), kExitDied);
  EXPECT_EQ(run_.count_lines("lab_control lost"), 1U);
}

TEST_F(PatientMiddlewareTest, AStopSymbolGoesBeforeTheLossOfTheLabControl) {
  drive_through(kTick0);
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.lab_control_is_lost = true;
  peers.commands_are_sent = false;
  run_.post(peers);
  run_.on(SystemTrigger{kStopSymbol});
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

class TwoPatientControllersTest : public PatientMiddlewareTest {
 protected:
  TwoPatientControllersTest() : PatientMiddlewareTest{{1, 2}} {}
};

TEST_F(TwoPatientControllersTest, ATickWaitsForAllItsControllers) {
  run_.release(kTick0);
  run_.on(command(2, kTick0));
  EXPECT_FALSE(wanted());
  run_.on(command(1, kTick0));
  EXPECT_EQ(wanted(), kTick1);
}

class PatientBesideTheLabTest : public PatientMiddlewareTest {
 protected:
  PatientBesideTheLabTest() : PatientMiddlewareTest{{1}, true} {}
};

TEST_F(PatientBesideTheLabTest, AControllerIsWaitedForFromItsFirstCommandOn) {
  run_.release(kTick0);
  EXPECT_EQ(wanted(), kTick1) << "the lab's controllers do not answer before the start";
  run_.on(command(1, kTick0));
  run_.on(published_state(1, 140 * kMs));
  run_.on(published_state(2, 140 * kMs));
  run_.release(kTick1);
  EXPECT_FALSE(wanted());
}

TEST_F(PatientBesideTheLabTest, OneOfOurControllersIsWaitedForFromItsAppearanceOn) {
  MiddlewarePeers peers = run_.all_present({1, 2});
  peers.own_controllers = {1};
  run_.on(peers);
  run_.release(kTick0);
  EXPECT_FALSE(wanted());
  run_.on(command(1, kTick0));
  EXPECT_EQ(wanted(), kTick1);
}

/// A lab control centre that has started time without this middleware refuses its first tick.
TEST(MiddlewareBesideTheLabTest, RequestsItsFirstTickAtOnceAndWaitsInItForTheControllers) {
  test::MiddlewareInMemory run{{.vehicle_ids = {1},
                                .startup_timeout = kStartupTimeout,
                                .rules = logical_middleware_rules(true)}};
  run.begin_in_logical_time();
  run.publish_parameters(200, {1, 2});
  EXPECT_EQ(run.machine().wake_up().run, kTick0);
  run.wait(10 * kStartupTimeout);
  EXPECT_FALSE(run.machine().exit_code());

  run.release(kTick0);
  EXPECT_TRUE(run.all<VehicleStateList>().empty());
  run.on(run.all_present({1, 2}));
  EXPECT_EQ(run.all<VehicleStateList>().size(), 1U);
}

TEST(MiddlewareBesideTheLabTest, LetsTimePassAfterTenSecondsWithoutAController) {
  test::MiddlewareInMemory run{{.vehicle_ids = {1}, .rules = logical_middleware_rules(true)}};
  run.begin_in_logical_time();
  run.publish_parameters(200, {1, 2});
  run.release(kTick0);
  ASSERT_TRUE(run.machine().wake_up().wall);
  run.wait(*run.machine().wake_up().wall - run.now().wall);
  EXPECT_EQ(run.all<VehicleStateList>().size(), 1U);
  EXPECT_EQ(run.count_lines("no controller is matched"), 1U);
  EXPECT_EQ(run.machine().wake_up().run, kTick1);
}

TEST_F(PatientBesideTheLabTest, ForwardsEveryTriggerAndListsObservations) {
  run_.on(SystemTrigger{0});
  run_.on(SystemTrigger{kTick0});
  EXPECT_EQ(run_.all<SystemTrigger>().size(), 2U);
  run_.on(PublishedObservation{.vehicle_id = 2, .observation = {.vehicle_id = 2}});
  run_.release(kTick0);
  ASSERT_EQ(run_.all<VehicleStateList>().size(), 1U);
  EXPECT_EQ(run_.all<VehicleStateList>()[0].observations.size(), 2U);
}

}  // namespace
}  // namespace hlc::middleware
