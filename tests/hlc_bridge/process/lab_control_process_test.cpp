// What the process adds to the machine: endpoints on two domains, and the files of a run.
#include "hlc_bridge/process/lab_control_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <string>

#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::process {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Nanoseconds kPeriod = 200'000'000;

template <class Condition, class Act>
bool repeat_until(Condition condition, Act act) {
  return time::Signal{}.repeat_until(dds::soon(), std::chrono::milliseconds{20}, condition, act);
}

/// The endpoints of vehicle 7 and its middleware on the lab's domain, and nothing behind them.
struct VehicleEndpoints {
  explicit VehicleEndpoints(int domain)
      : vehicle{dds::on_loopback(vehicle_name(7), domain, dds::DomainRole::kLab)},
        middleware{dds::on_loopback(middleware_name(7), domain, dds::DomainRole::kLab)},
        states{vehicle, dds::topics::vehicle_state(7)},
        triggers{vehicle, dds::topics::system_trigger()},
        middleware_triggers{middleware, dds::topics::system_trigger()},
        ready{middleware, dds::topics::ready_status()},
        requests{middleware, dds::topics::parameter_request()},
        parameters{middleware, dds::topics::parameter()} {}

  /// Ten of them make a vehicle ready.
  void publish_state() { states.write({.vehicle_id = 7, .create_stamp = next_state += kPeriod}); }

  dds::Participant vehicle;
  dds::Participant middleware;
  dds::Writer<VehicleState> states;
  dds::Mailbox<SystemTrigger> triggers;
  dds::Mailbox<SystemTrigger> middleware_triggers;  // the lab control waits for its match
  dds::Writer<ReadyStatus> ready;
  dds::Writer<ParameterRequest> requests;
  dds::Mailbox<Parameter> parameters;
  Nanoseconds next_state{};
};

/// Those of its controller on the controllers' domain.
struct ControllerEndpoints {
  explicit ControllerEndpoints(int domain)
      : participant{dds::on_loopback(controller_name(7), domain, dds::DomainRole::kController)},
        reports{participant, dds::topics::report()},
        run_states{participant, dds::topics::run_state()} {}

  dds::Participant participant;
  dds::Writer<ReportRecord> reports;
  dds::Mailbox<RunState> run_states;
};

class LabControlTest : public testing::Test {
 protected:
  LabControlTest() {
    options_.run = {.vehicle_ids = {7}, .period = kPeriod, .steps = 5000};
    options_.run.startup_timeout = 60 * kNanosecondsPerSecond;
    options_.transport = dds::Transport::kLoopback;
    options_.lab_domain = domain_.first();
    options_.controller_domain = domain_.first() + 50;
    options_.time = machine::kRealTime;
    options_.make_run = lab_control::make_lab_run<lab_control::RealTimeRun>;
    options_.out = folder_ / "run";
  }

  void start() {
    process_ = std::make_unique<LabControlProcess>(options_);
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }

  void TearDown() override {
    if (process_) process_->interrupt();  // else a failed test would wait for its run forever
  }

  /// Until the run has begun.
  [[nodiscard]] static bool begins(VehicleEndpoints& vehicle) {
    return repeat_until([&] { return !vehicle.triggers.now().empty(); },
                        [&] {
                          vehicle.ready.write({middleware_ready_id(7), 0});
                          vehicle.publish_state();
                        });
  }
  /// -1 if it does not end.
  [[nodiscard]] int exit_code() {
    if (code_.wait_until(dds::soon()) == std::future_status::ready) return code_.get();
    process_->interrupt();
    return -1;
  }

  [[nodiscard]] result::RunFacts facts() const {
    return record::read_facts(folder_ / "run" / "run.json");
  }
  [[nodiscard]] std::vector<ReportRecord> recorded() const {
    return record::read_reports(folder_ / "run" / "reports.csv");
  }

  test::DomainReservation domain_;
  test::TemporaryFolder folder_;
  LabControlOptions options_;
  std::unique_ptr<LabControlProcess> process_;
  std::future<int> code_;
};

TEST_F(LabControlTest, AVehicleThatLeavesAndComesBackWhileTheRunGathersIsReadyAgain) {
  start();
  {
    VehicleEndpoints first{domain_.first()};
    // The lab control has read a state when it has answered a question that was asked after it.
    ASSERT_TRUE(first.states.wait_for_matched(1, dds::soon()));
    ASSERT_TRUE(repeat_until([&] { return !first.parameters.now().empty(); },
                             [&] {
                               first.publish_state();
                               first.requests.write({"middleware_period_ms"});
                             }));
    EXPECT_EQ(first.parameters.now().front().value, ParameterValue{std::uint64_t{200}});
  }
  VehicleEndpoints second{domain_.first()};
  EXPECT_TRUE(begins(second));
  EXPECT_LT(second.triggers.now().front().next_start, kStopSymbol);
}

TEST_F(LabControlTest, TellsControllersAndOperatorWhatHappensAndRecordsIt) {
  start();
  VehicleEndpoints vehicle{domain_.first()};
  dds::Mailbox<Log> operators_log{vehicle.vehicle, dds::topics::log()};
  auto controller = std::make_unique<ControllerEndpoints>(domain_.first() + 50);
  ASSERT_TRUE(operators_log.reader().wait_for_matched(1, dds::soon()) &&
              controller->reports.wait_for_matched(1, dds::soon()));
  ASSERT_TRUE(begins(vehicle));
  ASSERT_EQ(controller->run_states.wait_for(1).size(), 1U);
  EXPECT_EQ(controller->run_states.now()[0].phase, RunPhase::kRunning);
  EXPECT_EQ(facts().reason, "lab_control did not end the run") << "for whoever kills it";

  ReportRecord record;
  record.report.vehicle = VehicleId{7};
  for (std::uint64_t step = 1; step <= 3; ++step) {
    record.report.step = StepIndex{step};
    controller->reports.write(record);
  }
  EXPECT_TRUE(repeat_until([&] { return recorded().size() == 3; }, [] {}));
  controller = nullptr;
  EXPECT_THAT(operators_log.wait_for(1).at(0).content, HasSubstr("high_level_controller_7 died"));
  process_->interrupt();  // else the others would make their minimal-risk stop first
  EXPECT_EQ(exit_code(), kExitDied);
  EXPECT_EQ(recorded().size(), 3U);
  EXPECT_EQ(facts().exit_code, kExitDied);
  EXPECT_EQ(facts().reason, "died: high_level_controller_7");
  ASSERT_EQ(facts().died.size(), 1U);
  EXPECT_EQ(facts().died[0].process, controller_name(7));
  EXPECT_GT(facts().wall_s, 0.0);
}

TEST_F(LabControlTest, StopRequestOfAControllerEndsTheRun) {
  start();
  VehicleEndpoints vehicle{domain_.first()};
  dds::Participant controller{
      dds::on_loopback(controller_name(7), domain_.first(), dds::DomainRole::kLab)};
  dds::Writer<StopRequest> stop_requests{controller, dds::topics::stop_request()};
  ASSERT_TRUE(begins(vehicle));
  ASSERT_TRUE(stop_requests.wait_for_matched(1, dds::soon()));
  stop_requests.write({7});
  EXPECT_EQ(exit_code(), kExitDied);
  EXPECT_EQ(facts().reason, "high_level_controller_7 requested the stop");
}

TEST_F(LabControlTest, ARunFolderThatIsRemovedDoesNotEndTheRun) {
  start();
  VehicleEndpoints vehicle{domain_.first()};
  ASSERT_TRUE(begins(vehicle));
  std::filesystem::remove_all(folder_ / "run");
  process_->interrupt();
  EXPECT_EQ(exit_code(), kExitInterrupted);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
}

TEST_F(LabControlTest, ARunFolderThatCannotBeWrittenIsInvalidFromTheStart) {
  std::filesystem::create_directories(folder_ / "run" / "run.json");
  EXPECT_THAT([&] { LabControlProcess{options_}; },
              ThrowsMessage<std::runtime_error>(HasSubstr("run.json: cannot be written")));
}

TEST_F(LabControlTest, NamesWhoDoesNotAppear) {
  options_.run.startup_timeout = kNanosecondsPerSecond;
  start();
  EXPECT_EQ(exit_code(), kExitMissing);
  EXPECT_EQ(facts().reason,
            "after 1 s: missing: vehicle_raspberry_7, middleware_7, high_level_controller_7");
}

TEST_F(LabControlTest, DoesNotWriteIntoAFolderThatHoldsARun) {
  options_.out = folder_.path();
  test::put(folder_ / "reports.csv", "mine");
  EXPECT_THAT([&] { LabControlProcess{options_}; },
              ThrowsMessage<std::invalid_argument>(HasSubstr("holds no reports.csv")));
}

}  // namespace
}  // namespace hlc::process
