// What a controller does when the lab control, its middleware or what is sent is lost, and when it
// is stopped.
#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hlc_bridge/hlc/command.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "tests/hlc_bridge/process/running_hlc_process.hpp"

namespace hlc::process {
namespace {

constexpr std::chrono::milliseconds kBetweenLists{50};

const Pose& start_pose() {
  static const Pose pose =
      scenario::measured_start(red_alone(), scenario::vehicle_of(red_alone(), {1}));
  return pose;
}

/// Until `holds`, the controller sees its vehicle standing at its start.
template <class Condition>
bool comes_to(FakeMiddleware& middleware, Condition holds) {
  return time::Signal{}.repeat_until(dds::soon(), kBetweenLists, holds,
                                     [&] { middleware.lists.write(list_of(start_pose(), 0.0)); });
}

class HlcProcessLossTest : public HlcProcessTest {
 protected:
  using HlcProcessTest::HlcProcessTest;

  [[nodiscard]] bool has_ended() const {
    return code_.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  }
};

/// The lab's control centre, which bears the name of all the lab's programs.
class Centre {
 public:
  explicit Centre(int domain)
      : participant_{dds::on_loopback("ParticipantSingleton", domain, dds::DomainRole::kLab)} {
    listen();
    // Announced after the other reader: a controller that draws knows both.
    drawings_ =
        std::make_unique<dds::Mailbox<Visualization>>(participant_, dds::topics::visualization());
  }

  void listen() {
    stop_requests_ =
        std::make_unique<dds::Mailbox<StopRequest>>(participant_, dds::topics::stop_request());
  }
  void leave() { stop_requests_ = nullptr; }
  [[nodiscard]] bool is_known() const { return !drawings_->now().empty(); }

 private:
  dds::Participant participant_;
  std::unique_ptr<dds::Mailbox<StopRequest>> stop_requests_;
  std::unique_ptr<dds::Mailbox<Visualization>> drawings_;
};

TEST_F(HlcProcessLossTest, DrivesOutWithoutTheLabsControlCentreAndPlansOnWhenItIsBackInTime) {
  Centre centre{domains_.first()};
  FakeMiddleware middleware{local()};
  Others others{controllers()};
  const auto reports = [&] { return others.reports.now(); };
  const auto is_stopping = [&] {
    return !reports().empty() &&
           reports().back().report.status == coordination::StepStatus::kMinimalRiskStop;
  };
  ASSERT_TRUE(others.reports.reader().wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(gets_ready(middleware));
  ASSERT_TRUE(middleware.triggers.wait_for_matched(1, dds::soon()));
  middleware.triggers.write({.next_start = 1});
  ASSERT_TRUE(comes_to(middleware, [&] { return centre.is_known(); }));
  const std::size_t before = reports().size();  // it looks for the centre once a step
  ASSERT_TRUE(comes_to(middleware, [&] { return reports().size() >= before + 3; }));
  EXPECT_NE(reports().back().report.status, coordination::StepStatus::kStandby);
  ASSERT_FALSE(is_stopping());

  centre.leave();
  ASSERT_TRUE(comes_to(middleware, is_stopping));
  centre.listen();
  EXPECT_TRUE(comes_to(middleware, [&] { return !is_stopping(); }));
  EXPECT_FALSE(has_ended());

  centre.leave();
  ASSERT_TRUE(comes_to(middleware, [&] { return has_ended(); }));
  EXPECT_EQ(code_.get(), kExitDied);
}

TEST_F(HlcProcessLossTest, TakesTheStopAndNothingElseFromTheLabDomain) {
  dds::Participant centre{
      dds::on_loopback("ParticipantSingleton", domains_.first(), dds::DomainRole::kLab)};
  dds::Writer<SystemTrigger> triggers{centre, dds::topics::system_trigger()};
  Others others{controllers()};
  ASSERT_TRUE(others.reports.reader().wait_for_matched(1, dds::soon()));
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(gets_ready(*middleware));
  ASSERT_TRUE(triggers.wait_for_matched(1, dds::soon()));
  triggers.write({.next_start = 1});
  const std::size_t before = others.reports.now().size();
  ASSERT_TRUE(comes_to(*middleware, [&] { return others.reports.now().size() >= before + 5; }));
  for (const ReportRecord& record : others.reports.now()) {
    EXPECT_EQ(record.report.status, coordination::StepStatus::kStandby);
  }
  middleware = nullptr;
  triggers.write({.next_start = kStopSymbol});
  ASSERT_EQ(code_.wait_until(dds::soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitGood);
}

/// On the lab's transport, where the copy of a command waits; stopped meanwhile.
class InterruptedHlcProcessTest : public HlcProcessLossTest {
 protected:
  InterruptedHlcProcessTest() : HlcProcessLossTest(stops_after_a_step(*this)) {}

  static HlcProcessOptions stops_after_a_step(InterruptedHlcProcessTest& test) {
    HlcProcessOptions options;
    options.transport = dds::Transport::kLab;
    options.after_step = [&test](const controller::Controller& controller) {
      test.last_step_ = controller.last_step().value;
      test.process_->stop();
    };
    return options;
  }

  std::atomic<std::uint64_t> last_step_{};
};

TEST_F(InterruptedHlcProcessTest, LeavesItsVehicleTheCopyOfItsLastCommand) {
  FakeMiddleware middleware{local(), dds::Transport::kLab};
  ASSERT_TRUE(gets_ready(middleware));
  ASSERT_TRUE(middleware.triggers.wait_for_matched(1, dds::soon()));
  middleware.triggers.write({.next_start = 1});
  ASSERT_TRUE(comes_to(middleware, [&] { return has_ended(); }));
  EXPECT_EQ(code_.get(), kExitGood);
  const auto is_last_copy = [&](const TrajectoryCommand& command) {
    return step_at(command.create_stamp, kPeriod) == last_step_ &&
           command.valid_after_stamp == command.create_stamp + kCopyDelay;
  };
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), std::chrono::milliseconds{10},
      [&] { return std::ranges::any_of(middleware.commands.now(), is_last_copy); }, [] {}));
}

class UnwrittenHlcProcessTest : public HlcProcessLossTest {
 protected:
  UnwrittenHlcProcessTest() : HlcProcessLossTest(fails_after_every_step(*this)) {}

  static HlcProcessOptions fails_after_every_step(UnwrittenHlcProcessTest& test) {
    HlcProcessOptions options = on_loopback_alone();
    options.after_step = [&test](const controller::Controller&) {
      ++test.calls_;
      throw std::runtime_error("no space left");
    };
    return options;
  }

  std::atomic<int> calls_{};
};

TEST_F(UnwrittenHlcProcessTest, DrivesOnAndSaysByItsExitCodeThatSomethingWasNotWritten) {
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(gets_ready(middleware));
  ASSERT_TRUE(middleware.triggers.wait_for_matched(1, dds::soon()));
  middleware.triggers.write({.next_start = 1});
  const std::size_t before = middleware.commands.now().size();
  ASSERT_TRUE(comes_to(
      middleware, [&] { return calls_ > 0 && middleware.commands.now().size() >= before + 3; }));
  middleware.triggers.write({.next_start = kStopSymbol});
  ASSERT_EQ(code_.wait_until(dds::soon()), std::future_status::ready);
  EXPECT_EQ(code_.get(), kExitNotWritten);
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

class ListenedToHlcProcessTest : private ListenedTo, public HlcProcessLossTest {
 protected:
  [[nodiscard]] LogListener& log() { return *log_; }
};

TEST_F(ListenedToHlcProcessTest, ItsOwnThreadTellsWhatTheLibrarysThreadsNotice) {
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(gets_ready(middleware));
  VehicleStateList list = list_of(start_pose(), 0.0);
  list.states[0].pose.x_m = std::numeric_limits<double>::quiet_NaN();
  const std::string line = "topic vehicleStateList: invalid content received";
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), kBetweenLists, [&] { return log().thread_that_logged(line) != 0; },
      [&] { middleware.lists.write(list); }));
  EXPECT_EQ(log().thread_that_logged(line),
            log().thread_that_logged("ready; waiting for the start trigger"));
}

TEST_F(ListenedToHlcProcessTest, SaysWhoseListsDoNotComeAnyMore) {
  FakeMiddleware middleware{local()};
  ASSERT_TRUE(gets_ready(middleware));
  EXPECT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), kBetweenLists,
      [&] { return log().thread_that_logged("waiting: no state list from middleware_1") != 0; },
      [] {}));
}

// It left at once, as if the lab had ended, though it was itself that had not run for a while.
TEST_F(ListenedToHlcProcessTest, OutlivesAMomentInWhichAllOthersAreGone) {
  Centre centre{domains_.first()};
  Others others{controllers()};
  auto middleware = std::make_unique<FakeMiddleware>(local());
  ASSERT_TRUE(others.reports.reader().wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(gets_ready(*middleware));
  ASSERT_TRUE(middleware->triggers.wait_for_matched(1, dds::soon()));
  middleware->triggers.write({.next_start = 1});
  ASSERT_TRUE(comes_to(*middleware, [&] { return centre.is_known(); }));

  const auto has_logged = [&](const char* text) { return log().thread_that_logged(text) != 0; };
  middleware = nullptr;
  centre.leave();
  ASSERT_TRUE(time::Signal{}.repeat_until(
      dds::soon(), kBetweenLists,
      [&] { return has_logged("lab_control lost") && has_logged("no commands reach the vehicle"); },
      [] {}));
  middleware = std::make_unique<FakeMiddleware>(local());
  centre.listen();
  EXPECT_TRUE(comes_to(*middleware, [&] {
    return has_logged("lab_control is back") && has_logged("middleware_1 is back");
  }));
  const std::size_t before = others.reports.now().size();
  EXPECT_TRUE(comes_to(*middleware, [&] { return others.reports.now().size() > before; }));
  EXPECT_FALSE(has_ended());
}

}  // namespace
}  // namespace hlc::process
