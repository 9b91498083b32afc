// The vehicle's life cycle in memory: the test is the clock, the network and all other processes.
#include "vehicle_sim/vehicle/vehicle_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/validate.hpp"

namespace hlc::simulated_vehicle::vehicle_machine_test {
namespace {

using machine::LogLine;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint8_t kId = 3;
constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kTick = kVehiclePeriod;
constexpr Nanoseconds kWall = 7'000 * kNanosecondsPerSecond;
constexpr Nanoseconds kReal = 1'700'000'000 * kNanosecondsPerSecond;

template <class Kind>
std::vector<Kind> of(const std::vector<VehicleMachine::Action>& actions) {
  std::vector<Kind> found;
  for (const VehicleMachine::Action& action : actions) {
    if (const auto* kind = std::get_if<Kind>(&action)) found.push_back(*kind);
  }
  return found;
}

VehiclePresence all_present() {
  const std::set<std::string> middlewares{middleware_name(kId), middleware_name(kId + 1)};
  return {.lab = {.alive = {kLabControlName, middleware_name(kId), controller_name(kId)}},
          .state_readers = {2, middlewares},
          .command_writers = {1, {middleware_name(kId)}},
          .ready_readers = 1,
          .trigger_writers = 1};
}

VehiclePresence without(const std::string& name) {
  VehiclePresence presence = all_present();
  presence.lab.alive.erase(name);
  presence.lab.lost.insert(name);
  return presence;
}

TrajectoryCommand answer_to(Nanoseconds list) {
  return {.vehicle_id = kId, .create_stamp = list, .valid_after_stamp = list};
}

VehicleMachineOptions options(const machine::PacingRules& rules) {
  return {.vehicle = {.vehicle_id = kId, .start = {.x_m = 1.0, .y_m = 2.0}},
          .rules = rules,
          .startup_timeout = 30 * kNanosecondsPerSecond};
}

class LogicalVehicle : public testing::Test {
 protected:
  std::vector<VehicleMachine::Action> advance() {
    return vehicle_.advance({.run = run_, .wall = wall_, .has_begun = has_begun_});
  }
  /// The tick that the vehicle wants is released.
  std::vector<VehicleMachine::Action> release() {
    run_ = vehicle_.wake_up().run.value();
    has_begun_ = true;
    return advance();
  }
  void publish_parameters(const std::vector<std::int32_t>& ids = {kId, kId + 1}) {
    vehicle_.on(Parameter{kPeriodParameter, kPeriod / kNanosecondsPerMillisecond});
    vehicle_.on(Parameter{kActiveIdsParameter, ids});
  }
  /// Until it wants its first tick.
  void prepare() {
    vehicle_.on(all_present());
    publish_parameters();
    EXPECT_THAT(advance(), IsEmpty());
    ASSERT_EQ(vehicle_.wake_up().run, 0U);
  }
  /// To the tick of 20 ms, which waits for the answer to the first list.
  void wait_for_answer() {
    prepare();
    static_cast<void>(release());
    EXPECT_THAT(release(), IsEmpty());
    ASSERT_EQ(vehicle_.wake_up().run, std::nullopt) << "the tick is not done";
  }

  VehicleMachine vehicle_{options(machine::logical_rules())};
  Nanoseconds run_{};
  Nanoseconds wall_{kWall};
  bool has_begun_{};
};

TEST_F(LogicalVehicle, LearnsTheParametersAndWaitsForEverybodyBeforeItsFirstTick) {
  EXPECT_EQ(of<ParameterRequest>(advance()).size(), 2U);
  EXPECT_EQ(vehicle_.awaited(), 1U);
  publish_parameters();
  VehiclePresence presence = all_present();
  presence.state_readers.names.erase(middleware_name(kId + 1));
  vehicle_.on(presence);
  EXPECT_THAT(advance(), IsEmpty());
  EXPECT_EQ(vehicle_.wake_up().run, std::nullopt);
  wall_ = vehicle_.wake_up().wall.value();
  EXPECT_THAT(of<LogLine>(advance()), ElementsAre(machine::info("waiting for middleware_4")));
  vehicle_.on(all_present());
  EXPECT_THAT(advance(), IsEmpty()) << "time has not begun";
  EXPECT_EQ(vehicle_.wake_up().run, 0U);
  EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  EXPECT_EQ(vehicle_.wake_up().run, kTick);
  EXPECT_EQ(vehicle_.awaited(), machine::kOnlyUrgent);
}

TEST_F(LogicalVehicle, WhoDoesNotAppearInTimeIsMissed) {
  publish_parameters();
  static_cast<void>(advance());
  wall_ += 30 * kNanosecondsPerSecond;
  EXPECT_THAT(
      of<LogLine>(advance()),
      ElementsAre(machine::error("missing after 30 s: lab_control, middleware_3, middleware_4")));
  EXPECT_EQ(vehicle_.exit_code(), kExitMissing);
}

TEST_F(LogicalVehicle, AVehicleThatIsNotActiveIsBadInput) {
  publish_parameters({1, 2});
  EXPECT_THAT(
      of<LogLine>(advance()),
      ElementsAre(machine::error("--vehicle_id=3 is not among the active_vehicle_ids: 1, 2")));
  EXPECT_EQ(vehicle_.exit_code(), kExitBadInput);
}

TEST_F(LogicalVehicle, ATickWaitsForTheAnswerToTheLastList) {
  wait_for_answer();
  EXPECT_EQ(vehicle_.awaited(), 1U);
  vehicle_.on(answer_to(kListOffset - 1));
  EXPECT_THAT(advance(), IsEmpty()) << "an answer to an earlier list";
  vehicle_.on(answer_to(kListOffset));
  const auto states = of<VehicleState>(advance());
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].create_stamp, kTick);
  EXPECT_EQ(vehicle_.wake_up().run, 2 * kTick);
}

/// It has neither controller nor middleware; nor has the other vehicle, which is one, too.
TEST_F(LogicalVehicle, AGuestWaitsForNobodysAnswer) {
  VehicleMachineOptions guest = options(machine::logical_rules());
  guest.guest_ids = {kId};
  vehicle_ = VehicleMachine(guest);
  VehiclePresence presence = all_present();
  presence.state_readers.names.erase(middleware_name(kId));
  presence.command_writers.names.clear();
  vehicle_.on(presence);
  publish_parameters();
  EXPECT_THAT(advance(), IsEmpty());
  ASSERT_EQ(vehicle_.wake_up().run, 0U);
  EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  EXPECT_EQ(of<VehicleState>(release()).size(), 1U) << "no answer has come";
}

TEST_F(LogicalVehicle, ACommandStampedFarAheadIsNoAnswer) {
  wait_for_answer();
  vehicle_.on(answer_to(~Nanoseconds{}));
  EXPECT_THAT(of<VehicleState>(advance()), IsEmpty());
  vehicle_.on(answer_to(kListOffset));
  EXPECT_EQ(of<VehicleState>(advance()).size(), 1U);
}

TEST_F(LogicalVehicle, WhoIsLostIsNotWaitedFor) {
  for (const std::string& lost : {middleware_name(kId), controller_name(kId)}) {
    SCOPED_TRACE(lost);
    vehicle_ = VehicleMachine(options(machine::logical_rules()));
    has_begun_ = false;
    run_ = 0;
    wait_for_answer();
    vehicle_.on(without(lost));
    EXPECT_EQ(of<VehicleState>(advance()).size(), 1U);
    EXPECT_EQ(vehicle_.exit_code(), std::nullopt);
  }
}

TEST_F(LogicalVehicle, WhoIsSilentForLongIsNotWaitedForUntilHeardAgain) {
  wait_for_answer();
  EXPECT_EQ(vehicle_.wake_up().wall, kWall + kMessageTimeout);
  wall_ = *vehicle_.wake_up().wall;
  auto actions = advance();
  EXPECT_THAT(of<LogLine>(actions),
              ElementsAre(machine::warning(
                  "no answer to the list of 1 ns within 10 s; no longer waiting")));
  EXPECT_EQ(of<VehicleState>(actions).size(), 1U);
  EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  vehicle_.on(answer_to(kListOffset));
  while (*vehicle_.wake_up().run <= kPeriod) EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  EXPECT_THAT(release(), IsEmpty()) << "waits for the answer to the second list";
}

TEST_F(LogicalVehicle, AmongTheLabsProgramsNobodyIsWaitedForBeforeTheFirstCommand) {
  VehicleMachineOptions lab = options(machine::logical_rules());
  lab.is_among_lab_programs = true;
  vehicle_ = VehicleMachine(lab);
  publish_parameters();
  VehiclePresence presence = all_present();
  presence.state_readers = {1, {"middleware of the lab"}};
  presence.command_writers = {1, {"middleware of the lab"}};
  vehicle_.on(presence);
  EXPECT_THAT(advance(), IsEmpty());
  static_cast<void>(release());
  EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  vehicle_.on(answer_to(kListOffset));
  while (*vehicle_.wake_up().run <= kPeriod) EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  EXPECT_THAT(release(), IsEmpty()) << "waits for the answer to the second list";
}

TEST_F(LogicalVehicle, BrakesForOneSecondAfterTheStopSymbolAndEnds) {
  wait_for_answer();
  vehicle_.on(SystemTrigger{kStopSymbol});
  auto actions = advance();
  EXPECT_THAT(of<LogLine>(actions), ElementsAre(machine::info("stop")));
  EXPECT_EQ(of<VehicleState>(actions).size(), 1U);
  for (int i = 1; i < SimulatedVehicle::kBrakingTicks; ++i) {
    ASSERT_EQ(vehicle_.exit_code(), std::nullopt) << i;
    EXPECT_EQ(of<VehicleState>(release()).size(), 1U);
  }
  EXPECT_EQ(vehicle_.exit_code(), kExitGood);
}

TEST_F(LogicalVehicle, AStopSymbolBeforeTheFirstTickEndsIt) {
  static_cast<void>(advance());
  vehicle_.on(SystemTrigger{kStopSymbol});
  EXPECT_THAT(advance(), IsEmpty());
  EXPECT_EQ(vehicle_.exit_code(), kExitGood);
}

TEST_F(LogicalVehicle, WithoutTheLabControlItEndsOnceItsTickIsDone) {
  wait_for_answer();
  vehicle_.on(without(kLabControlName));
  EXPECT_THAT(advance(), IsEmpty());
  vehicle_.on(answer_to(kListOffset));
  auto actions = advance();
  EXPECT_EQ(of<VehicleState>(actions).size(), 1U);
  EXPECT_THAT(of<LogLine>(actions), ElementsAre(machine::error("lab_control lost")));
  EXPECT_EQ(vehicle_.exit_code(), kExitDied);
}

TEST_F(LogicalVehicle, OneThatBrakesLeavesWithTheLabControlAsItWasTold) {
  wait_for_answer();
  vehicle_.on(SystemTrigger{kStopSymbol});
  static_cast<void>(advance());
  vehicle_.on(without(kLabControlName));
  EXPECT_THAT(of<LogLine>(advance()), IsEmpty());
  EXPECT_EQ(vehicle_.exit_code(), kExitGood);
}

TEST_F(LogicalVehicle, AStopSignalEndsItWhereverItWaits) {
  wait_for_answer();
  vehicle_.on(machine::StopSignal{});
  EXPECT_THAT(advance(), IsEmpty());
  EXPECT_EQ(vehicle_.exit_code(), kExitGood);
  EXPECT_EQ(vehicle_.wake_up().run, std::nullopt);
}

class RealVehicle : public testing::Test {
 protected:
  std::vector<VehicleMachine::Action> advance_at(Nanoseconds since_begin) {
    return vehicle_.advance({.run = kReal + since_begin, .wall = kWall + since_begin});
  }

  VehicleMachine vehicle_{options(machine::real_rules(kVehicleStays))};
};

TEST_F(RealVehicle, TicksByTheClockWhoeverIsThere) {
  for (Nanoseconds t = 0; t < 20 * kTick; t += kTick) {
    const auto states = of<VehicleState>(advance_at(t));
    ASSERT_EQ(states.size(), 1U);
    EXPECT_EQ(states[0].create_stamp, kReal + t);
    EXPECT_EQ(vehicle_.wake_up().run, kReal + t + kTick);
    EXPECT_THAT(advance_at(t + kTick - 1), IsEmpty());
  }
}

TEST_F(RealVehicle, MakesUpForMissedTicksWithoutPublishingTheirStates) {
  static_cast<void>(advance_at(0));
  const auto actions = advance_at(5 * kTick + 1);
  EXPECT_EQ(of<result::DrivenSample>(actions).size(), 5U);
  const auto states = of<VehicleState>(actions);
  ASSERT_EQ(states.size(), 1U);
  EXPECT_EQ(states[0].create_stamp, kReal + 5 * kTick);
  EXPECT_EQ(of<result::DrivenSample>(advance_at(5'000 * kTick)).size(), 501U) << "it stands anyway";
}

TEST_F(RealVehicle, DrivesItsPlanToTheEndBeforeItLeavesWithoutTheLabControl) {
  Nanoseconds t = 0;
  static_cast<void>(advance_at(t));
  vehicle_.on(without(kLabControlName));
  std::vector<VehicleMachine::Action> actions;
  while (!vehicle_.exit_code()) {
    t += kTick;
    ASSERT_LE(t, kVehicleStays + 2 * kTick);
    actions = advance_at(t);
  }
  EXPECT_GE(t, kVehicleStays);
  EXPECT_EQ(vehicle_.exit_code(), kExitDied);
  EXPECT_THAT(of<LogLine>(actions), ElementsAre(machine::error("lab_control lost")));
}

TEST_F(RealVehicle, ALabControlThatIsBackInTimeIsFollowedOn) {
  static_cast<void>(advance_at(0));
  vehicle_.on(without(kLabControlName));
  static_cast<void>(advance_at(kTick));
  vehicle_.on(all_present());
  static_cast<void>(advance_at(2 * kTick));
  static_cast<void>(advance_at(2 * kVehicleStays));
  EXPECT_EQ(vehicle_.exit_code(), std::nullopt);
}

TEST_F(RealVehicle, OneThatKeepsRunningListensAgainAfterTheStop) {
  VehicleMachineOptions keeps = options(machine::real_rules(machine::kForever));
  keeps.keep_running = true;
  vehicle_ = VehicleMachine(keeps);
  vehicle_.on(without(kLabControlName));
  Nanoseconds t = 0;
  for (int stop = 0; stop < 2; ++stop) {
    vehicle_.on(SystemTrigger{kStopSymbol});
    EXPECT_THAT(of<LogLine>(advance_at(t += kTick)), ElementsAre(machine::info("stop")));
    for (const Nanoseconds end = t + 100 * kTick; t < end;) {
      static_cast<void>(advance_at(t += kTick));
    }
    EXPECT_EQ(vehicle_.exit_code(), std::nullopt);
  }
}

/// Stands at the start pose; followed for `kCommandLifetime` from `create` on.
TrajectoryCommand standing(Nanoseconds create) {
  TrajectoryCommand command = answer_to(create);
  for (Nanoseconds t = 0; t <= 2 * kNanosecondsPerSecond; t += 50'000'000) {
    command.points.push_back({.t = create - kTick + t, .x_m = 1.0, .y_m = 2.0});
  }
  return command;
}

TEST_F(RealVehicle, FollowsItsControllerAfterACommandStampedFarAhead) {
  static_cast<void>(advance_at(0));
  std::vector<LogLine> lines;
  for (const Nanoseconds ahead : {kMostLead + kTick + 1, ~Nanoseconds{} - kReal}) {
    TrajectoryCommand forged = standing(kReal + ahead);
    forged.valid_after_stamp = 0;
    vehicle_.on(forged);
  }
  vehicle_.on(standing(kReal));
  const auto actions = advance_at(kTick);
  ASSERT_EQ(of<result::DrivenSample>(actions).size(), 1U);
  EXPECT_EQ(of<result::DrivenSample>(actions)[0].command_create, kReal);
  EXPECT_EQ(vehicle_.implausible_commands(), 2U);
  EXPECT_THAT(of<LogLine>(actions),
              ElementsAre(Field(&LogLine::text, HasSubstr("command of middleware_3 dropped"))));
}

TEST_F(RealVehicle, FollowsACommandStampedAheadByLessThanTheBound) {
  static_cast<void>(advance_at(0));
  TrajectoryCommand early = standing(kReal);
  early.create_stamp = kReal + kTick + kMostLead;
  vehicle_.on(early);
  const auto samples = of<result::DrivenSample>(advance_at(kTick));
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].command_create, early.create_stamp);
  EXPECT_EQ(vehicle_.implausible_commands(), 0U);
}

TEST_F(RealVehicle, LogsOnceWhyItStops) {
  TrajectoryCommand command = answer_to(kReal);
  for (Nanoseconds t = 0; t <= 2 * kNanosecondsPerSecond; t += 50'000'000) {
    command.points.push_back({.t = kReal + t, .x_m = 1.0, .y_m = 2.0});
  }
  vehicle_.on(command);
  std::vector<LogLine> lines;
  for (Nanoseconds t = 0; t < 3 * kNanosecondsPerSecond; t += kTick) {
    for (const LogLine& line : of<LogLine>(advance_at(t))) lines.push_back(line);
  }
  EXPECT_THAT(lines, ElementsAre(Field(&LogLine::text, HasSubstr("no usable command"))));
}

}  // namespace
}  // namespace hlc::simulated_vehicle::vehicle_machine_test
