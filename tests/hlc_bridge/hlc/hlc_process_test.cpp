#include "hlc_bridge/hlc/hlc_process.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <memory>

#include "hlc_bridge/core/exit_codes.hpp"
#include "hlc_bridge/core/node_names.hpp"
#include "hlc_bridge/core/time_grid.hpp"
#include "hlc_bridge/time/real_timer.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;

const Scenario& red_alone() {
  static const Scenario scenario =
      read_scenario({.file = std::filesystem::path{HLC_SOURCE_DIR} /
                             "launch_scripts/scenarios/paper_red_alone.yaml"});
  return scenario;
}

/// The controller of vehicle 1 in real time, as the lab starts it: with a node id without a number.
class HlcProcessTest : public testing::Test {
 protected:
  HlcProcessTest() {
    HlcProcessOptions options;
    options.node_id = "high_level_controller";
    options.transport = Transport::kLoopback;
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
  explicit FakeMiddleware(int domain)
      : participant{on_loopback("ParticipantSingleton", domain, DomainRole::kLocal)},
        lists{participant, topics::vehicle_state_list()},
        commands{participant, topics::command()},
        ready{participant, topics::ready_status()} {}

  Participant participant;
  Writer<VehicleStateList> lists;
  Mailbox<TrajectoryCommand> commands;
  Mailbox<ReadyStatus> ready;
};

VehicleStateList list_of_nobody() {
  return {.t_now = next_on_grid(real_time_now(), kPeriod, kListOffset),
          .period_ms = 200,
          .states = {},
          .observations = {},
          .active_vehicle_ids = {1}};
}

TEST_F(HlcProcessTest, BearsItsVehiclesNameWhateverItsNodeId) {
  const Participant lab{on_loopback("observer", domains_.first(), DomainRole::kLab)};
  const Participant local_observer{on_loopback("observer", local(), DomainRole::kLocal)};
  const Participant peer{on_loopback("observer", controllers(), DomainRole::kController)};
  for (const Participant* observer : {&lab, &local_observer, &peer}) {
    EXPECT_TRUE(observer->wait_for({controller_name(1)}, soon()));
  }
}

TEST_F(HlcProcessTest, LeavesWhenItsMiddlewareIsLostAndNotWhenAnotherControllerIs) {
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(middleware->lists.wait_for_matched(1, soon()));
  {
    const Participant neighbour{on_loopback(controller_name(2), local(), DomainRole::kLocal)};
    ASSERT_TRUE(neighbour.wait_for({controller_name(1)}, soon()));
    ASSERT_TRUE(middleware->participant.wait_for({controller_name(2)}, soon()));
  }
  ASSERT_TRUE(Signal{}.repeat_until(
      soon(), std::chrono::milliseconds{10},
      [&] { return middleware->participant.is_lost(controller_name(2)); }, [] {}));
  middleware->lists.write(list_of_nobody());
  EXPECT_EQ(middleware->commands.wait_for(1).size(), 1U);
  // It is ready from now on: vehicle 1 has no peers.
  EXPECT_GE(middleware->ready.wait_for(1).size(), 1U);
  middleware.reset();
  ASSERT_EQ(code_.wait_until(soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitDied);
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

TEST_F(HlcProcessTest, ShowsTheOperatorItsStateAndWhatItLogs) {
  Operator lab_control{domains_.first()};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(lab_control.sees(*process_) && middleware.lists.wait_for_matched(1, soon()));
  // Each is repeated: what is said before the writer has matched its reader is lost.
  const Pose start = measured_start(red_alone(), vehicle_of(red_alone(), {1}));
  const bool is_drawn = Signal{}.repeat_until(
      soon(), std::chrono::milliseconds{50},
      [&] { return lab_control.drawings.wait_for(0).size() >= 2; },
      [&] {
        VehicleStateList list = list_of_nobody();
        list.states = {{.vehicle_id = 1,
                        .create_stamp = list.t_now - 60'000'000,
                        .valid_after_stamp = list.t_now,
                        .pose = start}};
        middleware.lists.write(list);
      });
  ASSERT_TRUE(is_drawn);
  const Visualization state = lab_control.drawings.wait_for(2)[1];
  EXPECT_EQ(state.text, "1: standby");
  EXPECT_NEAR(state.points_m.at(0).x(), start.x_m, 0.01);

  const bool is_told = Signal{}.repeat_until(
      soon(), std::chrono::milliseconds{10}, [&] { return !lab_control.log.wait_for(0).empty(); },
      [] {
        spdlog::info("not for an operator who asks for critical lines alone");
        spdlog::error("the operator's line");
      });
  ASSERT_TRUE(is_told);
  for (const Log& line : lab_control.log.wait_for(1)) {
    EXPECT_EQ(line.content, "the operator's line");
    EXPECT_EQ(line.id, "high_level_controller");
    EXPECT_EQ(line.level, 1);
  }

  // From some line on the process knows that the operator wants to read everything.
  lab_control.level.write({.level = 3});
  const bool reads_all = Signal{}.repeat_until(
      soon(), std::chrono::milliseconds{10},
      [&] {
        return std::ranges::any_of(lab_control.log.wait_for(1),
                                   [](const Log& line) { return line.level == 3; });
      },
      [] { spdlog::info("for an operator who asks for all lines"); });
  EXPECT_TRUE(reads_all);
}

TEST_F(HlcProcessTest, AsksTheLabControlToStopWhenItsPeriodIsNotTheLabs) {
  Operator lab_control{domains_.first()};
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(lab_control.sees(*process_) && middleware.lists.wait_for_matched(1, soon()));
  VehicleStateList list = list_of_nobody();
  list.period_ms = 400;
  middleware.lists.write(list);
  ASSERT_EQ(lab_control.stop_requests.wait_for(1).size(), 1U);
  ASSERT_EQ(code_.wait_until(soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitBadInput);
}

}  // namespace
}  // namespace hlc
