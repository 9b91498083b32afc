// What the process adds to the machine: endpoints on three domains, presence, threads, the log.
#include "hlc_bridge/process/hlc_process.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/folders.hpp"

namespace hlc::process {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr std::chrono::milliseconds kBetweenLists{50};

const scenario::Scenario& red_alone() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"});
  return kScenario;
}

const Pose& start_pose() {
  static const Pose kPose =
      scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  return kPose;
}

/// A list of now, of vehicle 1 standing at its start.
VehicleStateList list_of_now() {
  VehicleStateList list{.t_now = time::real_time_now() / kPeriod * kPeriod + kListOffset,
                        .period_ms = 200,
                        .active_vehicle_ids = {1}};
  list.states = {{.vehicle_id = 1,
                  .create_stamp = list.t_now - 60'000'000,
                  .valid_after_stamp = list.t_now,
                  .pose = start_pose()}};
  return list;
}

/// The endpoints of a middleware on the local domain, and nothing behind them.
struct MiddlewareEndpoints {
  explicit MiddlewareEndpoints(int domain)
      : participant{dds::on_loopback(middleware_name(1), domain, dds::DomainRole::kLocal)},
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

/// Those of the lab's control centre, with the name that alone counts on loopback.
struct CentreEndpoints {
  explicit CentreEndpoints(int domain)
      : participant{dds::on_loopback(kLabControlName, domain, dds::DomainRole::kLab)},
        triggers{participant, dds::topics::system_trigger()},
        level{participant, dds::topics::log_level()},
        log{participant, dds::topics::log()} {
    read_stop_requests();
    // Announced after the other reader: a controller that draws knows both.
    drawings.emplace(participant, dds::topics::visualization());
  }

  /// By these readers controllers know that it is there.
  void read_stop_requests() { stop_requests.emplace(participant, dds::topics::stop_request()); }
  void leave() { stop_requests.reset(); }

  dds::Participant participant;
  dds::Writer<SystemTrigger> triggers;
  dds::Writer<LogLevel> level;
  dds::Mailbox<Log> log;
  std::optional<dds::Mailbox<StopRequest>> stop_requests;
  std::optional<dds::Mailbox<Visualization>> drawings;
};

/// The controller of vehicle 1 in real time, as the lab starts it: with a node id without a number.
class HlcProcessTest : public testing::Test {
 protected:
  explicit HlcProcessTest(std::function<void(const controller::Controller&)> after_step = nullptr) {
    HlcProcessOptions options;
    options.node_id = "high_level_controller";
    options.transport = dds::Transport::kLoopback;
    options.rules = high_level_controller::rules_in_real_time(
        false, {}, time::nanoseconds(options.startup_timeout));
    options.domains = {.lab = domains_.first(), .local = local(), .controller = controllers()};
    options.after_step = std::move(after_step);
    process_ = std::make_unique<HlcProcess>(options, scenario::make_controller(red_alone(), {1}));
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }
  ~HlcProcessTest() override { process_->stop(); }

  [[nodiscard]] int local() const { return domains_.first() + 1; }
  [[nodiscard]] int controllers() const { return domains_.first() + 50; }

  [[nodiscard]] bool has_ended() const {
    return code_.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  }
  /// -1 if it does not end.
  [[nodiscard]] int exit_code() {
    return code_.wait_until(dds::soon()) == std::future_status::ready ? code_.get() : -1;
  }

  /// Until `holds`, the controller sees its vehicle standing at its start.
  template <class Condition>
  [[nodiscard]] static bool comes_to(MiddlewareEndpoints& middleware, Condition holds) {
    return time::Signal{}.repeat_until(dds::soon(), kBetweenLists, holds,
                                       [&] { middleware.lists.write(list_of_now()); });
  }
  /// Vehicle 1 has no peers: it is ready when it has stood for a horizon.
  [[nodiscard]] static bool gets_ready(MiddlewareEndpoints& middleware) {
    return middleware.lists.wait_for_matched(1, dds::soon()) &&
           comes_to(middleware, [&] { return !middleware.ready.now().empty(); });
  }
  [[nodiscard]] static bool starts(MiddlewareEndpoints& middleware) {
    return gets_ready(middleware) && middleware.triggers.wait_for_matched(1, dds::soon()) &&
           middleware.triggers.write({.next_start = 1});
  }

  test::DomainReservation domains_{2};
  std::unique_ptr<HlcProcess> process_;
  std::future<int> code_;
};

TEST_F(HlcProcessTest, BearsItsVehiclesNameWhateverItsNodeId) {
  const dds::Participant lab{dds::on_loopback("observer", domains_.first(), dds::DomainRole::kLab)};
  const dds::Participant local_observer{
      dds::on_loopback("observer", local(), dds::DomainRole::kLocal)};
  const dds::Participant peer{
      dds::on_loopback("observer", controllers(), dds::DomainRole::kController)};
  for (const dds::Participant* observer : {&lab, &local_observer, &peer}) {
    EXPECT_TRUE(observer->wait_for({controller_name(1)}, dds::soon()));
  }
}

TEST_F(HlcProcessTest, ShowsTheOperatorItsStateAndWhatItLogs) {
  CentreEndpoints centre{domains_.first()};
  MiddlewareEndpoints middleware{local()};
  ASSERT_TRUE(centre.level.wait_for_matched(1, dds::soon()) &&
              centre.log.reader().wait_for_matched(1, dds::soon()) &&
              middleware.lists.wait_for_matched(1, dds::soon()));
  // Each is repeated: samples from before the match of writer and reader are lost.
  ASSERT_TRUE(comes_to(middleware, [&] { return centre.drawings->now().size() >= 2; }));
  const Visualization state = centre.drawings->now()[1];
  EXPECT_EQ(state.text, "1: standby");
  EXPECT_NEAR(state.points_m.at(0).x(), start_pose().x_m, 0.01);

  const auto logs_until = [](const auto& condition, const auto& log) {
    return time::Signal{}.repeat_until(dds::soon(), std::chrono::milliseconds{10}, condition, log);
  };
  EXPECT_TRUE(logs_until([&] { return !centre.log.now().empty(); },
                         [] {
                           spdlog::info("not for the operator's level critical");
                           spdlog::error("the operator's line");
                         }));
  for (const Log& line : centre.log.now()) {
    EXPECT_EQ(line.content, "the operator's line");
    EXPECT_EQ(line.id, "high_level_controller");
    EXPECT_EQ(line.level, 1);
  }

  // From some line on the process knows that the operator wants to read everything.
  centre.level.write({.level = 3});
  const auto reads_all = [&] {
    return std::ranges::any_of(centre.log.now(), [](const Log& line) { return line.level == 3; });
  };
  EXPECT_TRUE(logs_until(reads_all, [] { spdlog::info("for the operator's level of all lines"); }));
}

TEST_F(HlcProcessTest, TakesTheStopAndNothingElseFromTheLabDomain) {
  CentreEndpoints centre{domains_.first()};
  dds::Participant peer{dds::on_loopback("observer", controllers(), dds::DomainRole::kController)};
  dds::Mailbox<ReportRecord> reports{peer, dds::topics::report()};
  ASSERT_TRUE(reports.reader().wait_for_matched(1, dds::soon()));
  auto middleware = std::make_unique<MiddlewareEndpoints>(local());
  ASSERT_TRUE(gets_ready(*middleware));
  ASSERT_TRUE(centre.triggers.wait_for_matched(1, dds::soon()));
  centre.triggers.write({.next_start = 1});
  const std::size_t before = reports.now().size();
  ASSERT_TRUE(comes_to(*middleware, [&] { return reports.now().size() >= before + 5; }));
  for (const ReportRecord& record : reports.now()) {
    EXPECT_EQ(record.report.status, coordination::StepStatus::kStandby);
  }
  middleware = nullptr;
  centre.triggers.write({.next_start = kStopSymbol});
  EXPECT_EQ(exit_code(), kExitGood);
}

// After a request with the largest id every later one was stale.
TEST_F(HlcProcessTest, ARequestOfTheFutureIsDroppedAndLaterOnesCount) {
  MiddlewareEndpoints middleware{local()};
  dds::Participant user{dds::on_loopback("operator", controllers(), dds::DomainRole::kController)};
  dds::Writer<AutomatonRequest> requests{user, dds::topics::automaton_request()};
  dds::Mailbox<AutomatonAnswer> answers{user, dds::topics::automaton_answer()};
  ASSERT_TRUE(gets_ready(middleware));
  ASSERT_TRUE(requests.wait_for_matched(1, dds::soon()) &&
              answers.reader().wait_for_matched(1, dds::soon()));
  const std::uint64_t now = time::real_time_now();
  requests.write({.vehicle = {1}, .id = std::numeric_limits<std::uint64_t>::max()});
  requests.write({.vehicle = {1}, .id = now});
  ASSERT_TRUE(comes_to(middleware, [&] { return !answers.now().empty(); }));
  for (const AutomatonAnswer& answer : answers.now()) {
    EXPECT_EQ(answer.id, now);
    EXPECT_NE(answer.outcome, RequestOutcome::kStale);
  }
}

TEST_F(HlcProcessTest, WhatItSaysLastIsReceivedAfterItsEnd) {
  CentreEndpoints centre{domains_.first()};
  MiddlewareEndpoints middleware{local()};
  ASSERT_TRUE(centre.stop_requests->reader().wait_for_matched(1, dds::soon()) &&
              middleware.lists.wait_for_matched(1, dds::soon()));
  VehicleStateList list = list_of_now();
  list.period_ms = 400;
  middleware.lists.write(list);
  EXPECT_EQ(exit_code(), kExitBadInput);
  EXPECT_EQ(centre.stop_requests->wait_for(1).size(), 1U);
}

class UnwrittenHlcProcessTest : public HlcProcessTest {
 protected:
  UnwrittenHlcProcessTest()
      : HlcProcessTest([this](const controller::Controller&) {
          ++calls_;
          throw std::runtime_error("no space left");
        }) {}

  std::atomic<int> calls_{};
};

TEST_F(UnwrittenHlcProcessTest, DrivesOnAndSaysByItsExitCodeThatSomethingWasNotWritten) {
  MiddlewareEndpoints middleware{local()};
  ASSERT_TRUE(starts(middleware));
  const std::size_t before = middleware.commands.now().size();
  ASSERT_TRUE(comes_to(
      middleware, [&] { return calls_ > 0 && middleware.commands.now().size() >= before + 3; }));
  middleware.triggers.write({.next_start = kStopSymbol});
  EXPECT_EQ(exit_code(), kExitNotWritten);
  EXPECT_EQ(calls_, 1);
}

/// Lines of the log, with their threads.
class LogListener : public spdlog::sinks::base_sink<std::mutex> {
 public:
  /// The thread that logged a line with this text; 0: none.
  [[nodiscard]] std::size_t thread_that_logged(const std::string& text) {
    const std::lock_guard lock{mutex_};
    for (const auto& [thread, line] : lines_) {
      if (line.find(text) != std::string::npos) return thread;
    }
    return 0;
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    lines_.emplace_back(message.thread_id,
                        std::string(message.payload.begin(), message.payload.end()));
  }
  void flush_() override {}

 private:
  std::vector<std::pair<std::size_t, std::string>> lines_;
};

/// Listens before the process begins and until it has ended.
class ListenedTo {
 protected:
  ListenedTo() { spdlog::set_default_logger(std::make_shared<spdlog::logger>("", log_)); }
  ~ListenedTo() { spdlog::set_default_logger(former_); }

  std::shared_ptr<spdlog::logger> former_{spdlog::default_logger()};
  std::shared_ptr<LogListener> log_{std::make_shared<LogListener>()};
};

class ListenedToHlcProcessTest : private ListenedTo, public HlcProcessTest {
 protected:
  [[nodiscard]] LogListener& log() { return *log_; }
};

TEST_F(ListenedToHlcProcessTest, ItsOwnThreadTellsWhatTheLibrarysThreadsNotice) {
  MiddlewareEndpoints middleware{local()};
  ASSERT_TRUE(gets_ready(middleware));
  VehicleStateList list = list_of_now();
  list.states[0].pose.x_m = std::numeric_limits<double>::quiet_NaN();
  const std::string line = "topic vehicleStateList: invalid content received";
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), kBetweenLists, [&] { return log().thread_that_logged(line) != 0; },
      [&] { middleware.lists.write(list); }));
  EXPECT_EQ(log().thread_that_logged(line),
            log().thread_that_logged("ready; waiting for the start trigger"));
}

TEST_F(ListenedToHlcProcessTest, NoticesThatTheLabAndItsMiddlewareAreGoneAndBack) {
  CentreEndpoints centre{domains_.first()};
  auto middleware = std::make_unique<MiddlewareEndpoints>(local());
  ASSERT_TRUE(starts(*middleware));
  // The trigger may be lost with its writer: a command shows that it has arrived.
  ASSERT_TRUE(comes_to(*middleware, [&] {
    return !centre.drawings->now().empty() && !middleware->commands.now().empty();
  }));

  const auto has_logged = [&](const char* text) { return log().thread_that_logged(text) != 0; };
  middleware = nullptr;
  centre.leave();
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), kBetweenLists,
      [&] { return has_logged("lab_control lost") && has_logged("no commands reach the vehicle"); },
      [] {}));
  middleware = std::make_unique<MiddlewareEndpoints>(local());
  centre.read_stop_requests();
  EXPECT_TRUE(comes_to(*middleware, [&] {
    return has_logged("lab_control is back") && has_logged("middleware_1 is back");
  }));
  EXPECT_TRUE(comes_to(*middleware, [&] { return !middleware->commands.now().empty(); }));
  EXPECT_FALSE(has_ended());
}

}  // namespace
}  // namespace hlc::process
