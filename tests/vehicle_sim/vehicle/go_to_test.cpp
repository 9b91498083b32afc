// The operator of the lab moves a car while its controller waits for the start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>

#include "tests/hlc_bridge/hlc/driven_machine.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::simulated_vehicle {
namespace {

using controller::east_bound::seen;
using high_level_controller::HlcRules;
using high_level_controller::driven_machine::DrivenMachine;
using high_level_controller::driven_machine::kMillisecond;
using high_level_controller::driven_machine::kPeriod;
using high_level_controller::driven_machine::kSecond;
using high_level_controller::driven_machine::list_of;

constexpr Nanoseconds kTick = 20 * kMillisecond;

/// Car 1 and its controller. Commands arrive with the next tick.
class WaitingCar {
 public:
  explicit WaitingCar(const HlcRules& rules) : controller_(rules) {
    controller_.on(high_level_controller::driven_machine::peers());
  }

  /// @param command  asked every 100 ms
  void drive(Nanoseconds duration, const std::function<TrajectoryCommand(Nanoseconds)>& command) {
    for (const Nanoseconds end = now() + duration; now() < end; controller_.pass(kTick)) {
      for (TrajectoryCommand& sent : controller_.take<TrajectoryCommand>()) {
        car_.receive(std::move(sent));
        ++num_commands_;
      }
      if (command && now() % (100 * kMillisecond) == 0) car_.receive(command(now()));
      states_.push_front(car_.tick(now()).state);
      if (states_.size() > 4) states_.pop_back();
      if (now() % kPeriod == 0 && states_.size() == 4) publish_list();
    }
  }
  void trigger() { controller_.on(SystemTrigger{.next_start = now()}); }

  [[nodiscard]] double x_m() const { return car_.motion().pose.x_m; }
  [[nodiscard]] double speed_mps() const { return car_.motion().speed_mps; }
  [[nodiscard]] std::size_t num_commands() const { return num_commands_; }
  [[nodiscard]] Nanoseconds now() const { return controller_.now().run; }

 private:
  void publish_list() {
    const VehicleState& state = states_.back();
    controller_.on(list_of(now() / kPeriod,
                           {{.vehicle = {1}, .pose = state.pose, .speed_mps = state.speed_mps}}));
  }

  DrivenMachine controller_;
  SimulatedVehicle car_{{.vehicle_id = 1, .start = seen(1, 0.0, 0.0).pose}};
  std::deque<VehicleState> states_;  ///< the newest first
  std::size_t num_commands_{};
};

/// To x = 0.6 m within 3 s, as the lab control centre commands it: valid 300 ms after it is made.
std::function<TrajectoryCommand(Nanoseconds)> go_to(Nanoseconds begin) {
  return [begin](Nanoseconds now) {
    TrajectoryCommand command{
        .vehicle_id = 1, .create_stamp = now, .valid_after_stamp = now + 300 * kMillisecond};
    for (Nanoseconds t = begin; t < begin + 8 * kSecond; t += 100 * kMillisecond) {
      const double u = std::min(1e-9 * static_cast<double>(t - begin) / 3.0, 1.0);
      command.points.push_back({.t = t,
                                .x_m = 0.6 * u * u * (3.0 - 2.0 * u),
                                .vx_mps = 0.6 * 6.0 * u * (1.0 - u) / 3.0});
    }
    return command;
  };
}

TEST(GoTo, MovesACarWhoseControllerWaitsForTheStart) {
  for (const HlcRules& rules : {high_level_controller::driven_machine::real_time(),
                                high_level_controller::driven_machine::real_time_in_the_lab()}) {
    WaitingCar one(rules);
    one.drive(4 * kSecond, {});
    one.drive(4 * kSecond, go_to(one.now()));
    EXPECT_NEAR(one.x_m(), 0.6, 0.02);
    EXPECT_EQ(one.num_commands(), 0U);

    one.drive(3 * kSecond, {});
    one.trigger();
    one.drive(2 * kSecond, {});
    EXPECT_GT(one.x_m(), 0.8) << "the experiment begins where the car stands";
    EXPECT_GT(one.speed_mps(), 0.1);
  }
}

}  // namespace
}  // namespace hlc::simulated_vehicle
