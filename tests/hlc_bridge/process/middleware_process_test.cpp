// What the process adds to the machine: endpoints on two domains, ticks by trigger or clock.
#include "hlc_bridge/process/middleware_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::process {
namespace {

using testing::ElementsAre;

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kPeriod = 200 * kMs;

dds::ParticipantOptions options_of(const std::string& name, int domain, dds::DomainRole role,
                                   dds::Transport transport) {
  dds::ParticipantOptions options = dds::on_loopback(name, domain, role);
  options.transport = transport;
  return options;
}

/// The endpoints of the lab control and of vehicles 1 and 2; only questions are answered.
class LabEndpoints {
 public:
  LabEndpoints(int domain, dds::Transport transport)
      : participant_{options_of(kLabControlName, domain, dds::DomainRole::kLab, transport)},
        parameter_writer_{participant_, dds::topics::parameter()},
        triggers{participant_, dds::topics::system_trigger()},
        state_1{participant_, dds::topics::vehicle_state(1)},
        state_2{participant_, dds::topics::vehicle_state(2)},
        ready{participant_, dds::topics::ready_status()},
        commands{participant_, dds::topics::vehicle_command(1)},
        commands_2{participant_, dds::topics::vehicle_command(2)},
        requests_{participant_, dds::topics::parameter_request(),
                  [this](const ParameterRequest& request) {
                    signal_.post([&] { asked_.push_back(request.name); });
                  }} {}

  /// Answers until both parameters have been asked for.
  void publish_parameters(std::uint64_t period_ms, const std::vector<std::int32_t>& active_ids) {
    ASSERT_TRUE(parameter_writer_.wait_for_matched(1, dds::soon()));  // else an answer is lost
    bool is_period_published = false;
    bool are_ids_published = false;
    while (!is_period_published || !are_ids_published) {
      ASSERT_TRUE(signal_.wait_until(dds::soon(), [this] { return !asked_.empty(); }));
      for (const std::string& name : signal_.locked([this] { return std::exchange(asked_, {}); })) {
        if (name == "middleware_period_ms") {
          is_period_published = parameter_writer_.write({.name = name, .value = period_ms});
        } else if (name == "active_vehicle_ids") {
          are_ids_published = parameter_writer_.write({.name = name, .value = active_ids});
        }
      }
    }
  }

 private:
  dds::Participant participant_;
  time::Signal signal_;
  std::vector<std::string> asked_;
  dds::Writer<Parameter> parameter_writer_;

 public:
  dds::Writer<SystemTrigger> triggers;
  dds::Writer<VehicleState> state_1;
  dds::Writer<VehicleState> state_2;
  dds::Mailbox<ReadyStatus> ready;
  dds::Mailbox<TrajectoryCommand> commands;
  dds::Mailbox<TrajectoryCommand> commands_2;

  [[nodiscard]] dds::Participant& participant() { return participant_; }

 private:
  dds::Reader<ParameterRequest> requests_;
};

/// Those of the controllers, also of one whose vehicle is another middleware's.
class ControllerEndpoints {
 public:
  ControllerEndpoints(int domain, dds::Transport transport)
      : participant_{options_of("high_level_controller_1,2,3", domain, dds::DomainRole::kLocal,
                                transport)},
        ready{participant_, dds::topics::ready_status()},
        commands{participant_, dds::topics::command()},
        triggers{participant_, dds::topics::system_trigger()},
        lists{participant_, dds::topics::vehicle_state_list()} {}

  [[nodiscard]] dds::Participant& participant() { return participant_; }

 private:
  dds::Participant participant_;

 public:
  dds::Writer<ReadyStatus> ready;
  dds::Writer<TrajectoryCommand> commands;
  dds::Mailbox<SystemTrigger> triggers;
  dds::Mailbox<VehicleStateList> lists;
};

TrajectoryCommand command(Nanoseconds t_now, std::uint8_t id = 1) {
  TrajectoryCommand command;
  command.vehicle_id = id;
  command.create_stamp = command.valid_after_stamp = t_now;
  for (Nanoseconds i = 0; i < 4; ++i) {
    // The point before t_now is left out in the first period, where it would be before time begins.
    command.points.push_back({t_now + i * 50 * kMs, 1.0, 2.0, 0.5, 0.0});
  }
  return command;
}

class MiddlewareTest : public testing::Test {
 protected:
  explicit MiddlewareTest(dds::Transport transport = dds::Transport::kLoopback)
      : transport_{transport} {}

  void start(bool logical_time) {
    MiddlewareOptions options;
    options.node_id = node_id_;
    options.vehicle_ids = vehicle_ids_;
    options.transport = transport_;
    options.lab_domain = domains_.first();
    options.local_domain = domains_.first() + 1;
    const bool beside_lab_programs = transport_ == dds::Transport::kLab;
    options.time = machine::run_time(logical_time);
    options.rules = logical_time ? middleware::logical_middleware_rules(beside_lab_programs)
                                 : middleware::real_middleware_rules(beside_lab_programs);
    options.keep_running = keep_running_;
    options.startup_timeout = std::chrono::seconds{60};
    process_ = std::make_unique<MiddlewareProcess>(options);
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }

  int end_by_stop_symbol() {
    lab_.triggers.write({kStopSymbol});
    return exit_code();
  }

  void TearDown() override {
    if (process_) process_->stop();  // else a failed test would wait for its run forever
  }

  /// -1 if it does not end.
  [[nodiscard]] int exit_code() {
    if (code_.wait_until(dds::soon()) == std::future_status::ready) return code_.get();
    process_->stop();
    return -1;
  }

  const dds::Transport transport_;
  test::DomainReservation domains_{2};
  std::string node_id_{middleware_name(1)};
  std::vector<std::uint8_t> vehicle_ids_{1};
  bool keep_running_{false};
  LabEndpoints lab_{domains_.first(), transport_};
  ControllerEndpoints controller_{domains_.first() + 1, transport_};
  std::unique_ptr<MiddlewareProcess> process_;
  std::future<int> code_;
};

TEST_F(MiddlewareTest, BearsItsVehiclesNameWhateverItsNodeId) {
  node_id_ = "middleware";
  const dds::Participant lab{dds::on_loopback("observer", domains_.first(), dds::DomainRole::kLab)};
  const dds::Participant local{
      dds::on_loopback("observer", domains_.first() + 1, dds::DomainRole::kLocal)};
  start(false);
  EXPECT_TRUE(lab.wait_for({middleware_name(1)}, dds::soon()));
  EXPECT_TRUE(local.wait_for({middleware_name(1)}, dds::soon()));
}

TEST_F(MiddlewareTest, InLogicalTimeATriggerReleasesTheListAndTheAnswerTheNextRequest) {
  start(true);
  lab_.publish_parameters(kPeriod / kMs, {1, 2});
  ASSERT_EQ(lab_.ready.wait_for(1).at(0).next_start, kListOffset);
  EXPECT_EQ(lab_.ready.wait_for(1).at(0).source_id, middleware_name(1));
  // The middleware has matched all; what is written before it is matched here, too, would be lost.
  ASSERT_TRUE(lab_.triggers.wait_for_matched(1, dds::soon()) &&
              controller_.commands.wait_for_matched(1, dds::soon()));
  lab_.triggers.write({kListOffset});
  ASSERT_GE(controller_.lists.wait_for(1).size(), 1U);
  const VehicleStateList list = controller_.lists.wait_for(1).at(0);
  EXPECT_EQ(list.t_now, kListOffset);
  EXPECT_EQ(list.period_ms, 200U);
  EXPECT_THAT(list.active_vehicle_ids, ElementsAre(1, 2));
  controller_.commands.write(command(kListOffset));
  EXPECT_EQ(lab_.commands.wait_for(1).at(0).create_stamp, kListOffset);
  // Requests are repeated every second.
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{10},
      [&] { return lab_.ready.now().back().next_start == kPeriod + kListOffset; }, [] {}));

  EXPECT_EQ(end_by_stop_symbol(), kExitGood);
  process_.reset();
  const std::vector<SystemTrigger> triggers = controller_.triggers.wait_for(2);
  ASSERT_EQ(triggers.size(), 2U) << "the stop reaches the controller after the process has left";
  EXPECT_EQ(triggers[0].next_start, kListOffset);
  EXPECT_EQ(triggers[1].next_start, kStopSymbol);
}

TEST_F(MiddlewareTest, InRealTimeListsComeByTheClockAndEveryVehicleGetsItsOwnCommands) {
  vehicle_ids_ = {1, 2};
  keep_running_ = true;
  start(false);
  lab_.publish_parameters(20, {1, 2});
  const std::vector<VehicleStateList> lists = controller_.lists.wait_for(3);
  ASSERT_GE(lists.size(), 3U);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    EXPECT_EQ(lists[i].t_now % (20 * kMs), kListOffset);
    EXPECT_TRUE(i == 0 || lists[i].t_now > lists[i - 1].t_now);
  }
  ASSERT_TRUE(controller_.ready.wait_for_matched(1, dds::soon()) &&
              controller_.commands.wait_for_matched(1, dds::soon()) &&
              lab_.triggers.wait_for_matched(1, dds::soon()));
  for (const std::uint8_t id : vehicle_ids_) {
    EXPECT_TRUE(lab_.ready.now().empty()) << "not with one of its controllers";
    EXPECT_TRUE(controller_.ready.write({.source_id = controller_ready_id(id)}));
  }
  EXPECT_EQ(lab_.ready.wait_for(1).at(0).source_id, "MW for muCars 1, 2 ready.");
  lab_.triggers.write({5});
  ASSERT_EQ(controller_.triggers.wait_for(1).size(), 1U);
  EXPECT_EQ(controller_.triggers.wait_for(1)[0].next_start, 5U);

  const Nanoseconds t_now = controller_.lists.now().back().t_now;
  for (const std::uint8_t id : std::vector<std::uint8_t>{1, 2, 3})
    controller_.commands.write(command(t_now, id));
  EXPECT_EQ(lab_.commands.wait_for(1).at(0).vehicle_id, 1);
  EXPECT_EQ(lab_.commands_2.wait_for(1).at(0).vehicle_id, 2);

  lab_.triggers.write({kStopSymbol});
  ASSERT_EQ(controller_.triggers.wait_for(2).back().next_start, kStopSymbol);
  const std::size_t before = controller_.lists.now().size();
  EXPECT_GE(controller_.lists.wait_for(before + 3).size(), before + 3) << "for the next experiment";
  process_->stop();
  EXPECT_EQ(exit_code(), kExitGood);
  EXPECT_EQ(lab_.commands.now().size(), 1U);
  EXPECT_EQ(lab_.commands_2.now().size(), 1U);
}

class MiddlewareBesideTheLabTest : public MiddlewareTest {
 protected:
  MiddlewareBesideTheLabTest() : MiddlewareTest{dds::Transport::kLab} {}
};

TEST_F(MiddlewareBesideTheLabTest, HoldsGoalsBackUntilItsControllersAreReady) {
  std::mt19937_64 random{1};
  std::vector<GoalState> goals;
  for (int i = 0; i < 3; ++i) goals.push_back(dds::sample<GoalState>(random));
  dds::Writer<GoalState> centre{lab_.participant(), dds::topics::goal_state()};
  dds::Mailbox<GoalState> received{controller_.participant(), dds::topics::goal_state()};
  centre.write(goals[0]);  // before the middleware is there
  start(false);
  lab_.publish_parameters(20, {1, 2});
  centre.write(goals[1]);
  ASSERT_GE(controller_.lists.wait_for(10).size(), 10U);
  EXPECT_TRUE(received.now().empty());

  controller_.ready.write({.source_id = controller_ready_id(1)});
  EXPECT_EQ(received.wait_for(2).size(), 2U);
  centre.write(goals[2]);
  ASSERT_EQ(received.wait_for(3).size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(dds::text(received.now()[i]), dds::text(goals[i]));
  EXPECT_EQ(end_by_stop_symbol(), kExitGood);
}

TEST_F(MiddlewareBesideTheLabTest, CarriesCommandsOfAllKindsAndTellsObservations) {
  dds::Writer<VehicleObservation> observations{lab_.participant(),
                                               dds::topics::vehicle_observation(2)};
  dds::Mailbox<PathTrackingCommand> paths{lab_.participant(),
                                          dds::topics::vehicle_command<PathTrackingCommand>(1)};
  dds::Mailbox<SpeedCurvatureCommand> speeds{
      lab_.participant(), dds::topics::vehicle_command<SpeedCurvatureCommand>(1)};
  dds::Mailbox<DirectCommand> directs{lab_.participant(),
                                      dds::topics::vehicle_command<DirectCommand>(1)};
  dds::Writer<PathTrackingCommand> path_writer{controller_.participant(),
                                               dds::topics::command<PathTrackingCommand>()};
  dds::Writer<SpeedCurvatureCommand> speed_writer{controller_.participant(),
                                                  dds::topics::command<SpeedCurvatureCommand>()};
  dds::Writer<DirectCommand> direct_writer{controller_.participant(),
                                           dds::topics::command<DirectCommand>()};
  start(false);
  lab_.publish_parameters(20, {1, 2});
  ASSERT_TRUE(observations.wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(paths.reader().wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(speeds.reader().wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(directs.reader().wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(path_writer.wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(speed_writer.wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(direct_writer.wait_for_matched(1, dds::soon()));

  // Best effort: repeated until it is received. The first one is for a vehicle that is not its
  // own.
  time::Signal pause;
  const auto published_until_received = [&](auto& writer, auto command, auto& mailbox) {
    command.vehicle_id = 2;
    writer.write(command);
    command.vehicle_id = 1;
    return pause.repeat_until(
        dds::soon(), std::chrono::milliseconds{20}, [&] { return !mailbox.now().empty(); },
        [&] { writer.write(command); });
  };
  EXPECT_TRUE(published_until_received(path_writer, PathTrackingCommand{.speed_mps = 0.5}, paths));
  EXPECT_TRUE(
      published_until_received(speed_writer, SpeedCurvatureCommand{.speed_mps = 0.6}, speeds));
  EXPECT_TRUE(
      published_until_received(direct_writer, DirectCommand{.motor_throttle = 0.1}, directs));
  EXPECT_TRUE(paths.now().at(0).path.empty());  // an empty path is one, too
  EXPECT_EQ(paths.now().at(0).vehicle_id, 1);
  EXPECT_EQ(speeds.now().at(0).speed_mps, 0.6);
  EXPECT_EQ(directs.now().at(0).motor_throttle, 0.1);

  const auto sees_vehicle_2 = [&] {
    const std::vector<VehicleStateList> lists = controller_.lists.now();
    if (lists.empty()) return false;
    const VehicleStateList& list = lists.back();
    return list.observations.size() == 2 && list.observations[1].vehicle_id == 2 &&
           list.observations[1].pose.x_m == 3.5;
  };
  EXPECT_TRUE(pause.repeat_until(dds::soon(), std::chrono::milliseconds{20}, sees_vehicle_2, [&] {
    observations.write({.vehicle_id = 2, .create_stamp = 7, .pose = {.x_m = 3.5}});
  }));
  EXPECT_EQ(controller_.lists.now().back().observations[0].vehicle_id, 0);
  EXPECT_EQ(end_by_stop_symbol(), kExitGood);
}

}  // namespace
}  // namespace hlc::process
