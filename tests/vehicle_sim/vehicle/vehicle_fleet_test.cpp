#include "vehicle_sim/vehicle/vehicle_fleet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::simulated_vehicle::vehicle_fleet_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kWall = 7'000 * kNanosecondsPerSecond;

VehicleMachineOptions options(std::uint8_t id, bool ticks_by_period = true) {
  return {.vehicle = {.vehicle_id = id, .start = {.x_m = 1.0 * id, .y_m = 2.0}},
          .rules = machine::logical_rules(),
          .ticks_by_period = ticks_by_period};
}

FleetPresence all_present() {
  const std::set<std::string> middlewares{middleware_name(1), middleware_name(2)};
  const VehiclePresence one{.lab = {.alive = {kLabControlName}},
                            .state_readers = {1, middlewares},
                            .command_writers = {1, middlewares},
                            .ready_readers = 1,
                            .trigger_writers = 1};
  return {{1, one}, {2, one}};
}

/// Drives with a plan that begins at `begin`.
TrajectoryCommand answer_to(std::uint8_t id, Nanoseconds list) {
  TrajectoryCommand command{.vehicle_id = id, .create_stamp = list, .valid_after_stamp = list};
  const Nanoseconds begin = list / kPeriod * kPeriod;
  for (Nanoseconds t = begin; t <= begin + 10 * kPeriod; t += 50'000'000) {
    const double s = 1e-9 * static_cast<double>(t);
    command.points.push_back(
        {.t = t, .x_m = 1.0 * id + 0.05 * s * s, .y_m = 2.0, .vx_mps = 0.1 * s});
  }
  return command;
}

/// What a fleet did, by vehicle.
struct Done {
  std::map<std::uint8_t, std::vector<VehicleState>> states;
  std::map<std::uint8_t, std::vector<Pose>> driven;
  std::vector<std::string> requests;

  void add(const std::vector<VehicleFleet::Action>& actions) {
    for (const VehicleFleet::Action& action : actions) {
      if (const auto* request = std::get_if<ParameterRequest>(&action)) {
        requests.push_back(request->name);
        continue;
      }
      const auto& [id, what] = std::get<OfVehicle<VehicleMachine::Action>>(action);
      if (const auto* state = std::get_if<VehicleState>(&what)) states[id].push_back(*state);
      if (const auto* sample = std::get_if<result::DrivenSample>(&what)) {
        driven[id].push_back(sample->pose);
      }
    }
  }
};

class Fleet : public testing::Test {
 protected:
  void advance() {
    done_.add(fleet_.advance({.run = run_, .wall = kWall, .has_begun = has_begun_}));
  }
  void prepare() {
    fleet_.on(all_present());
    fleet_.on(Parameter{kPeriodParameter, kPeriod / kNanosecondsPerMillisecond});
    fleet_.on(Parameter{kActiveIdsParameter, std::vector<std::int32_t>{1, 2}});
    advance();
  }
  /// The tick that the fleet wants.
  void release() {
    run_ = fleet_.wake_up().run.value();
    has_begun_ = true;
    advance();
  }
  void answer(std::uint8_t id, Nanoseconds list) {
    fleet_.on(OfVehicle<VehicleMachine::Event>{id, answer_to(id, list)});
  }
  /// Until a second after the stop symbol that follows the tick of `end`.
  void drive(Nanoseconds end) {
    prepare();
    for (Nanoseconds answered = 0; !fleet_.exit_code() && run_ < end + 2 * kPeriod * 10;) {
      if (has_begun_ && run_ % kPeriod == 0 && run_ < end && answered <= run_) {
        for (const std::uint8_t id : std::vector<std::uint8_t>{1, 2}) {
          answer(id, run_ + kListOffset);
        }
        answered = run_ + 1;
      }
      if (run_ == end) fleet_.on(SystemTrigger{kStopSymbol});
      release();
    }
  }

  VehicleFleet fleet_{{options(1), options(2)}};
  Nanoseconds run_{};
  bool has_begun_{};
  Done done_;
};

TEST_F(Fleet, RequestsParametersOnceForAll) {
  advance();
  EXPECT_THAT(done_.requests, ElementsAre(kPeriodParameter, kActiveIdsParameter));
}

TEST_F(Fleet, RequestsNoTickWhileOneOfItsVehiclesIsBusy) {
  prepare();
  release();
  ASSERT_EQ(fleet_.wake_up().run, kPeriod);
  release();
  EXPECT_EQ(fleet_.wake_up().run, std::nullopt);
  EXPECT_EQ(fleet_.awaited(), 2U);
  answer(2, kListOffset);
  advance();
  EXPECT_EQ(fleet_.wake_up().run, std::nullopt) << "vehicle 1 waits for its answer";
  EXPECT_EQ(fleet_.awaited(), 1U);
  answer(1, kListOffset);
  advance();
  EXPECT_EQ(fleet_.wake_up().run, 2 * kPeriod);
  EXPECT_EQ(fleet_.awaited(), machine::kOnlyUrgent);
}

TEST_F(Fleet, TicksByPeriodMakeTheSameMotionAndTheStatesOfTheLists) {
  drive(10 * kPeriod);
  EXPECT_EQ(fleet_.exit_code(), kExitGood);
  const Done by_period = std::exchange(done_, {});
  fleet_ = VehicleFleet{{options(1, false), options(2, false)}};
  run_ = 0;
  has_begun_ = false;
  drive(10 * kPeriod);
  EXPECT_EQ(fleet_.exit_code(), kExitGood);
  for (const std::uint8_t id : std::vector<std::uint8_t>{1, 2}) {
    EXPECT_EQ(by_period.driven.at(id), done_.driven.at(id));
    EXPECT_NE(by_period.driven.at(id).front(), by_period.driven.at(id).back());
    std::map<Nanoseconds, VehicleState> by_stamp;
    for (const VehicleState& state : by_period.states.at(id)) by_stamp[state.create_stamp] = state;
    EXPECT_LT(by_stamp.size(), done_.states.at(id).size() * 2 / 3);
    for (const VehicleState& state : done_.states.at(id)) {
      if ((state.create_stamp + kStateDelay) % kPeriod != 0) continue;
      ASSERT_TRUE(by_stamp.contains(state.create_stamp)) << state.create_stamp;
      EXPECT_EQ(by_stamp.at(state.create_stamp).pose, state.pose);
    }
  }
}

TEST_F(Fleet, EndsWithTheFirstVehicleThatFails) {
  fleet_.on(Parameter{kPeriodParameter, kPeriod / kNanosecondsPerMillisecond});
  fleet_.on(Parameter{kActiveIdsParameter, std::vector<std::int32_t>{1}});
  advance();
  EXPECT_EQ(fleet_.exit_code(), kExitBadInput);
}

TEST_F(Fleet, AStopSignalEndsAllAtOnce) {
  prepare();
  fleet_.on(machine::StopSignal{});
  advance();
  EXPECT_EQ(fleet_.exit_code(), kExitGood);
}

}  // namespace
}  // namespace hlc::simulated_vehicle::vehicle_fleet_test
