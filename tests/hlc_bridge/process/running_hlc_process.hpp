#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/process/hlc_process.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/folders.hpp"

/// A controller's process, and those around it as bare participants.
namespace hlc::process {

inline constexpr Nanoseconds kPeriod = 200'000'000;

inline const scenario::Scenario& red_alone() {
  static const scenario::Scenario scenario =
      scenario::read_scenario({.file = std::filesystem::path{test::source_folder()} /
                                       "launch_scripts/scenarios/paper_red_alone.yaml"});
  return scenario;
}

/// The controller of vehicle 1 in real time, as the lab starts it: with a node id without a number.
class HlcProcessTest : public testing::Test {
 protected:
  static HlcProcessOptions on_loopback_alone() {
    HlcProcessOptions options;
    options.transport = dds::Transport::kLoopback;
    return options;
  }

  explicit HlcProcessTest(HlcProcessOptions options = on_loopback_alone()) {
    options.node_id = "high_level_controller";
    options.rules =
        high_level_controller::rules_in_real_time(options.transport == dds::Transport::kLoopback,
                                                  {}, time::nanoseconds(options.startup_timeout));
    options.domains = {.lab = domains_.first(), .local = local(), .controller = controllers()};
    process_ = std::make_unique<HlcProcess>(options, scenario::make_controller(red_alone(), {1}));
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }
  ~HlcProcessTest() override { process_->stop(); }

  [[nodiscard]] int local() const { return domains_.first() + 1; }
  [[nodiscard]] int controllers() const { return domains_.first() + 50; }

  test::DomainReservation domains_{2};
  std::unique_ptr<HlcProcess> process_;
  std::future<int> code_;
};

class FakeMiddleware {
 public:
  explicit FakeMiddleware(int domain, dds::Transport transport = dds::Transport::kLoopback)
      : participant{{.name = "ParticipantSingleton",
                     .domain_id = domain,
                     .role = dds::DomainRole::kLocal,
                     .transport = transport}},
        lists{participant, dds::topics::vehicle_state_list()},
        triggers{participant, dds::topics::system_trigger()},
        commands{participant, dds::topics::command()},
        ready{participant, dds::topics::ready_status()} {}

  dds::Participant participant;
  dds::Writer<VehicleStateList> lists;
  dds::Writer<SystemTrigger> triggers;
  dds::Mailbox<TrajectoryCommand> commands;
  dds::Mailbox<ReadyStatus> ready;
};

inline VehicleStateList list_of_nobody() {
  return {.t_now = next_on_grid(time::real_time_now(), kPeriod, kListOffset),
          .period_ms = 200,
          .states = {},
          .observations = {},
          .active_vehicle_ids = {1}};
}

/// A list of now that shows vehicle 1 there.
inline VehicleStateList list_of(const Pose& pose, double speed_mps) {
  VehicleStateList list = list_of_nobody();
  list.t_now = time::real_time_now() / kPeriod * kPeriod + kListOffset;
  list.states = {{.vehicle_id = 1,
                  .create_stamp = list.t_now - 60'000'000,
                  .valid_after_stamp = list.t_now,
                  .pose = pose,
                  .speed_mps = speed_mps}};
  return list;
}

/// Vehicle 1 has no peers: it is ready when it has stood for a horizon.
inline bool gets_ready(FakeMiddleware& middleware) {
  const Pose start = scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  return middleware.lists.wait_for_matched(1, dds::soon()) &&
         time::Signal{}.repeat_until(
             dds::soon(), std::chrono::milliseconds{50},
             [&] { return !middleware.ready.now().empty(); },
             [&] { middleware.lists.write(list_of(start, 0.0)); });
}

/// The lab control centre's part that looks on.
class Operator {
 public:
  explicit Operator(int domain)
      : participant{dds::on_loopback("operator", domain, dds::DomainRole::kLab)},
        level{participant, dds::topics::log_level()},
        log{participant, dds::topics::log()},
        drawings{participant, dds::topics::visualization()},
        stop_requests{participant, dds::topics::stop_request()} {}

  /// Until all of it is matched in both directions.
  [[nodiscard]] bool sees(const HlcProcess&) {
    return level.wait_for_matched(1, dds::soon()) &&
           log.reader().wait_for_matched(1, dds::soon()) &&
           drawings.reader().wait_for_matched(1, dds::soon()) &&
           stop_requests.reader().wait_for_matched(1, dds::soon());
  }

  dds::Participant participant;
  dds::Writer<LogLevel> level;
  dds::Mailbox<Log> log;
  dds::Mailbox<Visualization> drawings;
  dds::Mailbox<StopRequest> stop_requests;
};

/// Endpoints of the others on the controllers' domain.
class Others {
 public:
  explicit Others(int domain)
      : participant{dds::on_loopback(controller_name(2), domain, dds::DomainRole::kController)},
        traffic{participant, dds::topics::traffic()},
        reports{participant, dds::topics::report()} {}

  dds::Participant participant;
  dds::Writer<coordination::Traffic> traffic;
  dds::Mailbox<ReportRecord> reports;
};

}  // namespace hlc::process
