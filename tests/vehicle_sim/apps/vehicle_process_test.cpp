// What the process adds to the machine: its endpoints, ticks by trigger or clock.
#include "vehicle_sim/apps/vehicle_process.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::apps {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr Nanoseconds kPeriod = 200 * kMillisecond;
constexpr std::uint8_t kId = 3;
const Pose kStart{.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.0};

dds::ParticipantOptions participant(const std::string& name, int domain) {
  return {.name = name,
          .domain_id = domain,
          .role = dds::DomainRole::kLab,
          .transport = dds::Transport::kLoopback,
          .lease = machine::kLogicalTime.lease,
          .discovery_server = std::nullopt};
}

/// From 1 s on along x with 2 m/s^2 up to 0.5 m/s.
TrajectoryPoint planned(Nanoseconds t) {
  constexpr Nanoseconds kBegin = 1'000 * kMillisecond;
  const double s = t < kBegin ? 0.0 : 1e-9 * static_cast<double>(t - kBegin);
  const bool accelerates = s < 0.25;
  return {.t = t,
          .x_m = kStart.x_m + (accelerates ? s * s : 0.5 * s - 0.0625),
          .y_m = kStart.y_m,
          .vx_mps = accelerates ? 2.0 * s : 0.5};
}

TrajectoryCommand command_at(Nanoseconds list) {
  TrajectoryCommand command{
      .vehicle_id = kId, .create_stamp = list, .valid_after_stamp = list, .points = {}};
  const Nanoseconds begin = list / kPeriod * kPeriod;
  for (Nanoseconds t = begin; t <= begin + 2'000 * kMillisecond; t += 50 * kMillisecond) {
    command.points.push_back(planned(t));
  }
  return command;
}

/// The endpoints of lab control and middleware of one vehicle.
class LabEndpoints {
 public:
  explicit LabEndpoints(int domain)
      : lab_control_(participant(kLabControlName, domain), [this] { signal_.notify(); }),
        middleware_(participant(middleware_name(kId), domain), [this] { signal_.notify(); }),
        trigger_writer_(lab_control_, dds::topics::system_trigger()),
        parameter_writer_(lab_control_, dds::topics::parameter()),
        command_writer_(middleware_, dds::topics::vehicle_command(kId)),
        request_reader_(lab_control_, dds::topics::parameter_request(),
                        [this](const ParameterRequest& request) {
                          signal_.post([&] { requests_.push_back(request.name); });
                        }),
        ready_reader_(
            lab_control_, dds::topics::ready_status(),
            [this](const ReadyStatus& status) { signal_.post([&] { ready_ = status; }); }),
        state_reader_(middleware_, dds::topics::vehicle_state(kId),
                      [this](const VehicleState& state) {
                        signal_.post([&] { states_.push_back(state); });
                      }) {}

  /// Answers what the vehicle asks until it asks for its first tick; false if that does not come.
  [[nodiscard]] bool answer_until_ready() {
    const auto is_asked = [this] { return ready_ || !requests_.empty(); };
    while (signal_.wait_until(Clock::now() + seconds(60), is_asked)) {
      if (signal_.locked([this] { return ready_.has_value(); })) return is_received();
      for (const std::string& name :
           signal_.locked([this] { return std::exchange(requests_, {}); })) {
        if (name == "middleware_period_ms") {
          parameter_writer_.write({.name = name, .value = std::uint64_t{kPeriod / kMillisecond}});
        } else if (name == "active_vehicle_ids") {
          parameter_writer_.write({.name = name, .value = std::vector<std::int32_t>{kId}});
        }
      }
    }
    return false;
  }

  /// Releases the tick that the vehicle has asked for and waits until it asks for the next one.
  [[nodiscard]] bool release_tick(Nanoseconds t, bool is_last = false) {
    trigger_writer_.write({.next_start = t});
    return is_last || signal_.wait_until(Clock::now() + seconds(60),
                                         [&] { return ready_ && ready_->next_start > t; });
  }

  /// The vehicle has matched this lab when it is ready, but not yet the other way round.
  [[nodiscard]] bool is_received() const {
    const auto deadline = Clock::now() + seconds(60);
    return trigger_writer_.wait_for_matched(1, deadline) &&
           command_writer_.wait_for_matched(1, deadline);
  }
  void stop() { trigger_writer_.write({.next_start = kStopSymbol}); }
  void command(const TrajectoryCommand& command) { command_writer_.write(command); }

  [[nodiscard]] std::vector<VehicleState> states(std::size_t count) {
    static_cast<void>(
        signal_.wait_until(Clock::now() + seconds(60), [&] { return states_.size() >= count; }));
    return signal_.locked([this] { return states_; });
  }
  [[nodiscard]] ReadyStatus ready() {
    return signal_.locked([this] { return ready_.value_or(ReadyStatus{}); });
  }

 private:
  time::Signal signal_;
  std::vector<std::string> requests_;
  std::optional<ReadyStatus> ready_;
  std::vector<VehicleState> states_;

  dds::Participant lab_control_;
  dds::Participant middleware_;
  dds::Writer<SystemTrigger> trigger_writer_;
  dds::Writer<Parameter> parameter_writer_;
  dds::Writer<TrajectoryCommand> command_writer_;
  dds::Reader<ParameterRequest> request_reader_;
  dds::Reader<ReadyStatus> ready_reader_;
  dds::Reader<VehicleState> state_reader_;
};

class VehicleProcessTest : public testing::Test {
 protected:
  [[nodiscard]] VehicleProcessOptions options() const {
    return {.vehicles = {{.vehicle_id = kId, .start = kStart}},
            .transport = dds::Transport::kLoopback,
            .lab_domain = domain_.first(),
            .time = machine::kLogicalTime,
            .rules = machine::logical_rules(),
            .startup_timeout = seconds(60)};
  }

  void TearDown() override {
    if (process_) {
      process_->stop();  // else a failed test would wait for its run forever
    }
  }

  void start(const VehicleProcessOptions& options) {
    process_ = std::make_unique<VehicleProcess>(options);
    exit_code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }

  /// -1 if it does not end.
  [[nodiscard]] int exit_code() {
    if (exit_code_.wait_for(seconds(60)) != std::future_status::ready) {
      process_->stop();
      return -1;
    }
    return exit_code_.get();
  }

  const test::DomainReservation domain_{1};
  std::unique_ptr<VehicleProcess> process_;
  std::future<int> exit_code_;
};

TEST_F(VehicleProcessTest, DrivesInLogicalTimeUntilTheStopAndBrakesForOneSecond) {
  LabEndpoints lab(domain_.first());
  start(options());
  ASSERT_TRUE(lab.answer_until_ready());
  EXPECT_EQ(lab.ready().source_id, "vehicle_raspberry_3");
  EXPECT_EQ(lab.ready().next_start, 0U);

  constexpr Nanoseconds kStop = 3'000 * kMillisecond;
  Nanoseconds t = 0;
  for (; t <= kStop; t += kVehiclePeriod) {
    ASSERT_TRUE(lab.release_tick(t)) << t;
    if (t % kPeriod == 0) {
      lab.command(command_at(t + kListOffset));
    }
    // For a reader that has not matched it yet the writer keeps 64.
    const std::size_t ticks = static_cast<std::size_t>(t / kVehiclePeriod) + 1;
    ASSERT_EQ(lab.states(ticks).size(), ticks);
  }
  lab.stop();
  for (int i = 1; i <= simulated_vehicle::SimulatedVehicle::kBrakingTicks;
       ++i, t += kVehiclePeriod) {
    ASSERT_TRUE(lab.release_tick(t, i == simulated_vehicle::SimulatedVehicle::kBrakingTicks)) << t;
  }
  EXPECT_EQ(exit_code(), kExitGood);

  const std::vector<VehicleState> states = lab.states(201);
  ASSERT_EQ(states.size(), 201U);
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(states[i].create_stamp, i * kVehiclePeriod);
    EXPECT_EQ(states[i].valid_after_stamp, i * kVehiclePeriod + kStateDelay);
    if (states[i].create_stamp <= kStop) {
      EXPECT_NEAR(states[i].pose.x_m, planned(states[i].create_stamp).x_m, 0.005) << i;
    }
  }
  EXPECT_NEAR(states.back().speed_mps, 0.0, 0.05);
}

TEST_F(VehicleProcessTest, InRealTimeItPublishesWithoutAnybodyElse) {
  LabEndpoints lab(domain_.first());
  VehicleProcessOptions real = options();
  real.time = machine::kRealTime;
  real.rules = machine::real_rules(kVehicleStays);
  start(real);
  const std::vector<VehicleState> states = lab.states(10);
  ASSERT_GE(states.size(), 10U);
  for (const VehicleState& state : states) {
    EXPECT_EQ(state.create_stamp % kVehiclePeriod, 0U);
    EXPECT_EQ(state.pose, kStart);
  }
  ASSERT_TRUE(lab.is_received());
  lab.stop();
  EXPECT_EQ(exit_code(), kExitGood);
}

}  // namespace
}  // namespace hlc::apps
