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
namespace hlc {

inline constexpr Nanoseconds kPeriod = 200'000'000;

inline const Scenario& red_alone() {
  static const Scenario scenario =
      read_scenario({.file = std::filesystem::path{test::source_folder()} /
                             "launch_scripts/scenarios/paper_red_alone.yaml"});
  return scenario;
}

/// The controller of vehicle 1 in real time, as the lab starts it: with a node id without a number.
class HlcProcessTest : public testing::Test {
 protected:
  static HlcProcessOptions on_loopback_alone() {
    HlcProcessOptions options;
    options.transport = Transport::kLoopback;
    return options;
  }

  explicit HlcProcessTest(HlcProcessOptions options = on_loopback_alone()) {
    options.node_id = "high_level_controller";
    options.rules = rules_in_real_time(options.transport == Transport::kLoopback, {},
                                       nanoseconds(options.startup_timeout));
    options.domains = {.lab = domains_.first(), .local = local(), .controller = controllers()};
    process_ = std::make_unique<HlcProcess>(options, make_controller(red_alone(), {1}));
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }
  ~HlcProcessTest() override { process_->stop(); }

  [[nodiscard]] int local() const { return domains_.first() + 1; }
  [[nodiscard]] int controllers() const { return domains_.first() + 50; }

  DomainReservation domains_{2};
  std::unique_ptr<HlcProcess> process_;
  std::future<int> code_;
};

class FakeMiddleware {
 public:
  explicit FakeMiddleware(int domain, Transport transport = Transport::kLoopback)
      : participant{{.name = "ParticipantSingleton",
                     .domain_id = domain,
                     .role = DomainRole::kLocal,
                     .transport = transport}},
        lists{participant, topics::vehicle_state_list()},
        triggers{participant, topics::system_trigger()},
        commands{participant, topics::command()},
        ready{participant, topics::ready_status()} {}

  Participant participant;
  Writer<VehicleStateList> lists;
  Writer<SystemTrigger> triggers;
  Mailbox<TrajectoryCommand> commands;
  Mailbox<ReadyStatus> ready;
};

inline VehicleStateList list_of_nobody() {
  return {.t_now = next_on_grid(real_time_now(), kPeriod, kListOffset),
          .period_ms = 200,
          .states = {},
          .observations = {},
          .active_vehicle_ids = {1}};
}

/// A list of now that shows vehicle 1 there.
inline VehicleStateList list_of(const Pose& pose, double speed_mps) {
  VehicleStateList list = list_of_nobody();
  list.t_now = real_time_now() / kPeriod * kPeriod + kListOffset;
  list.states = {{.vehicle_id = 1,
                  .create_stamp = list.t_now - 60'000'000,
                  .valid_after_stamp = list.t_now,
                  .pose = pose,
                  .speed_mps = speed_mps}};
  return list;
}

/// Vehicle 1 has no peers: it is ready when it has stood for a horizon.
inline bool gets_ready(FakeMiddleware& middleware) {
  const Pose start = measured_start(red_alone(), vehicle_of(red_alone(), {1}));
  return middleware.lists.wait_for_matched(1, soon()) &&
         Signal{}.repeat_until(
             soon(), std::chrono::milliseconds{50}, [&] { return !middleware.ready.now().empty(); },
             [&] { middleware.lists.write(list_of(start, 0.0)); });
}

/// The lab control centre's part that looks on.
class Operator {
 public:
  explicit Operator(int domain)
      : participant{on_loopback("operator", domain, DomainRole::kLab)},
        level{participant, topics::log_level()},
        log{participant, topics::log()},
        drawings{participant, topics::visualization()},
        stop_requests{participant, topics::stop_request()} {}

  /// Until all of it is matched in both directions.
  [[nodiscard]] bool sees(const HlcProcess&) {
    return level.wait_for_matched(1, soon()) && log.reader().wait_for_matched(1, soon()) &&
           drawings.reader().wait_for_matched(1, soon()) &&
           stop_requests.reader().wait_for_matched(1, soon());
  }

  Participant participant;
  Writer<LogLevel> level;
  Mailbox<Log> log;
  Mailbox<Visualization> drawings;
  Mailbox<StopRequest> stop_requests;
};

/// Endpoints of the others on the controllers' domain.
class Others {
 public:
  explicit Others(int domain)
      : participant{on_loopback(controller_name(2), domain, DomainRole::kController)},
        traffic{participant, topics::traffic()},
        reports{participant, topics::report()} {}

  Participant participant;
  Writer<Traffic> traffic;
  Mailbox<ReportRecord> reports;
};

}  // namespace hlc
