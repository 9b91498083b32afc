#include "hlc_bridge/process/lab_control_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::process {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Nanoseconds kPeriod = 200'000'000;

/// Publishes a sample repeatedly, as vehicles do, until it has the effect.
template <class Condition, class Act>
bool repeat_until(Condition condition, Act act) {
  return time::Signal{}.repeat_until(dds::soon(), std::chrono::milliseconds{20}, condition, act);
}

/// Vehicle 1, its middleware and its controller as far as the lab control meets them: two timers
/// that answer every trigger at once, and a report for every list; it leaves standby with step 5.
class FakeVehicle {
 public:
  FakeVehicle(int lab_domain, int controller_domain)
      : vehicle_{dds::on_loopback(vehicle_name(1), lab_domain, dds::DomainRole::kLab)},
        middleware_{dds::on_loopback(middleware_name(1), lab_domain, dds::DomainRole::kLab)},
        controller_{std::make_unique<dds::Participant>(
            dds::on_loopback(controller_name(1), controller_domain, dds::DomainRole::kController))},
        parameters{vehicle_, dds::topics::parameter()},
        requests{vehicle_, dds::topics::parameter_request()},
        stop_requests{vehicle_, dds::topics::stop_request()},
        logs{vehicle_, dds::topics::log()},
        run_states{
            std::make_unique<dds::Mailbox<RunState>>(*controller_, dds::topics::run_state())},
        vehicle_ready_{vehicle_, dds::topics::ready_status()},
        middleware_ready_{middleware_, dds::topics::ready_status()},
        reports_{std::make_unique<dds::Writer<ReportRecord>>(*controller_, dds::topics::report())},
        triggers_{vehicle_, dds::topics::system_trigger(),
                  [this](const SystemTrigger& trigger) {
                    signal_.post([&] { received_.push_back(trigger.next_start); });
                  },
                  [this] { signal_.notify(); }},
        middleware_triggers_{middleware_, dds::topics::system_trigger()},
        thread_{[this] { answer_triggers(); }} {}

  ~FakeVehicle() {
    signal_.post([this] { ends_ = true; });
    thread_.join();
  }

  /// From the next list on no report comes: the controller is dead.
  void kill_controller_at(std::uint64_t step) {
    signal_.post([&] { controller_dies_at_ = step; });
  }
  /// Done with the triggers at that tick of the vehicle.
  void wait_for_vehicle_tick(Nanoseconds tick) {
    ASSERT_TRUE(signal_.wait_until(dds::soon(), [&] { return vehicle_tick_ >= tick; }));
  }

 private:
  dds::Participant vehicle_;
  dds::Participant middleware_;
  std::unique_ptr<dds::Participant> controller_;

 public:
  dds::Mailbox<Parameter> parameters;
  dds::Writer<ParameterRequest> requests;
  dds::Writer<StopRequest> stop_requests;
  dds::Mailbox<Log> logs;
  std::unique_ptr<dds::Mailbox<RunState>> run_states;

 private:
  void answer_triggers() {
    // The first ready status must find the lab control's reader, as processes see to it.
    if (!vehicle_ready_.wait_for_matched(1, dds::soon()) ||
        !middleware_ready_.wait_for_matched(1, dds::soon()) ||
        !triggers_.wait_for_matched(1, dds::soon())) {
      return;
    }
    vehicle_ready_.write({vehicle_name(1), 0});
    middleware_ready_.write({middleware_name(1), kListOffset});
    while (true) {
      static_cast<void>(
          signal_.wait_until(dds::soon(), [this] { return ends_ || !received_.empty(); }));
      const auto [received, ends, dies_at] = signal_.locked([this] {
        return std::tuple{std::exchange(received_, {}), ends_, controller_dies_at_};
      });
      for (const Nanoseconds tick : received) {
        answer(tick, dies_at);
      }
      if (ends) {
        return;
      }
    }
  }

  void answer(Nanoseconds tick, std::uint64_t dies_at) {
    if (tick == kStopSymbol) {
      return;
    }
    if (tick % kPeriod != kListOffset) {
      vehicle_ready_.write({vehicle_name(1), tick + kVehiclePeriod});
      signal_.post([&] { vehicle_tick_ = tick; });
      return;
    }
    const std::uint64_t step = step_at(tick, kPeriod);
    if (step >= dies_at) {
      run_states.reset();
      reports_.reset();
      controller_.reset();
    } else {
      ReportRecord record;
      record.report.vehicle = VehicleId{1};
      record.report.step = StepIndex{step};
      record.report.status =
          step < 5 ? coordination::StepStatus::kStandby : coordination::StepStatus::kPlanned;
      reports_->write(record);
    }
    middleware_ready_.write({middleware_name(1), tick + kPeriod});
  }

  time::Signal signal_;
  std::deque<Nanoseconds> received_;
  Nanoseconds vehicle_tick_{};
  bool ends_{};
  std::uint64_t controller_dies_at_{~std::uint64_t{0}};
  dds::Writer<ReadyStatus> vehicle_ready_;
  dds::Writer<ReadyStatus> middleware_ready_;
  std::unique_ptr<dds::Writer<ReportRecord>> reports_;
  dds::Reader<SystemTrigger> triggers_;
  dds::Mailbox<SystemTrigger> middleware_triggers_;  // the lab control waits for its match
  std::thread thread_;
};

class LabControlTest : public testing::Test {
 protected:
  LabControlOptions options() {
    LabControlOptions options;
    options.run = {.vehicle_ids = {1}, .period = kPeriod, .steps = steps_};
    options.run.startup_timeout = 60 * kNanosecondsPerSecond;
    options.transport = dds::Transport::kLoopback;
    options.lab_domain = domain_.first();
    options.controller_domain = domain_.first() + 50;
    options.time = machine::kLogicalTime;
    options.make_run = lab_control::make_lab_run<lab_control::LogicalRun>;
    options.out = folder_ / "run";
    return options;
  }

  void start() {
    process_ = std::make_unique<LabControlProcess>(options());
    code_ = std::async(std::launch::async, [this] { return process_->run(); });
  }

  void TearDown() override {
    if (process_) process_->interrupt();  // else a failed test would wait for its run forever
  }

  /// -1 if it does not end.
  [[nodiscard]] int exit_code() {
    if (code_.wait_until(dds::soon()) == std::future_status::ready) return code_.get();
    process_->interrupt();
    return -1;
  }

  result::RunFacts facts() { return record::read_facts(folder_ / "run" / "run.json"); }

  test::DomainReservation domain_;
  test::TemporaryFolder folder_;
  std::uint64_t steps_{3};
  FakeVehicle vehicle_{domain_.first(), domain_.first() + 50};
  std::unique_ptr<LabControlProcess> process_;
  std::future<int> code_;
};

TEST_F(LabControlTest, DrivesTheStepsAndKeepsTheReports) {
  start();
  EXPECT_EQ(exit_code(), kExitGood);
  const std::vector<ReportRecord> reports = record::read_reports(folder_ / "run" / "reports.csv");
  ASSERT_EQ(reports.size(), 9U);  // standby 0 ... 4, steps 5 ... 7, one period more
  for (std::size_t i = 0; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].report.step.value, i);
  }
  EXPECT_EQ(facts().first_step, 5U);
  EXPECT_EQ(facts().exit_code, kExitGood);
  EXPECT_GT(facts().wall_s, 0.0);
  EXPECT_NEAR(facts().clock_s, 9 * 0.2, 0.001);
}

TEST_F(LabControlTest, AnswersWhatItIsAskedFor) {
  steps_ = 5000;
  start();
  std::map<std::string, ParameterValue> answers;
  EXPECT_TRUE(repeat_until(
      [&] {
        for (const Parameter& answer : vehicle_.parameters.wait_for(0)) {
          answers[answer.name] = answer.value;
        }
        return answers.size() >= 2;
      },
      [&] {
        vehicle_.requests.write({"middleware_period_ms"});
        vehicle_.requests.write({"no_such_parameter"});
        vehicle_.requests.write({"active_vehicle_ids"});
      }));
  process_->interrupt();
  EXPECT_EQ(exit_code(), kExitInterrupted);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers["middleware_period_ms"], ParameterValue{std::uint64_t{200}});
  EXPECT_EQ(answers["active_vehicle_ids"], (ParameterValue{std::vector<std::int32_t>{1}}));
}

TEST_F(LabControlTest, TellsThatTheRunGoesOnAndThenWhoDied) {
  steps_ = 5000;
  start();
  ASSERT_EQ(vehicle_.run_states->wait_for(1).size(), 1U);
  EXPECT_EQ(vehicle_.run_states->wait_for(1)[0].phase, RunPhase::kRunning);
  vehicle_.kill_controller_at(12);
  EXPECT_EQ(exit_code(), kExitDied);
  ASSERT_GE(facts().died.size(), 1U);
  EXPECT_EQ(facts().died[0].process, controller_name(1));
  EXPECT_EQ(facts().reason, "died: high_level_controller_1");
  const std::vector<Log> logs = vehicle_.logs.wait_for(1);
  ASSERT_EQ(logs.size(), 1U);
  EXPECT_THAT(logs[0].content, HasSubstr("high_level_controller_1 died"));
  // Its last reports may have died with it.
  EXPECT_GE(record::read_reports(folder_ / "run" / "reports.csv").size(), 10U);
}

TEST_F(LabControlTest, InterruptionStopsTheRunAndKeepsWhatThereIs) {
  steps_ = 5000;
  start();
  vehicle_.wait_for_vehicle_tick(3 * kPeriod);
  // Three reports have been written, and perhaps not yet all read.
  EXPECT_TRUE(repeat_until(
      [&] { return record::read_reports(folder_ / "run" / "reports.csv").size() >= 3; }, [] {}));
  process_->interrupt();
  EXPECT_EQ(exit_code(), kExitInterrupted);
  EXPECT_EQ(facts().exit_code, kExitInterrupted);
  EXPECT_GE(record::read_reports(folder_ / "run" / "reports.csv").size(), 3U);
}

TEST_F(LabControlTest, StopRequestOfAControllerEndsTheRun) {
  steps_ = 5000;
  start();
  vehicle_.wait_for_vehicle_tick(kPeriod);
  ASSERT_TRUE(vehicle_.stop_requests.wait_for_matched(1, dds::soon()));
  vehicle_.stop_requests.write({1});
  EXPECT_EQ(exit_code(), kExitDied);
  EXPECT_EQ(facts().reason, "high_level_controller_1 requested the stop");
}

class EmptyLabTest : public testing::Test {
 protected:
  EmptyLabTest() {
    options_.run = {.vehicle_ids = {7}, .period = kPeriod, .steps = 3};
    options_.run.startup_timeout = kNanosecondsPerSecond;
    options_.transport = dds::Transport::kLoopback;
    options_.lab_domain = domain_.first();
    options_.controller_domain = domain_.first() + 50;
    options_.time = machine::kLogicalTime;
    options_.make_run = lab_control::make_lab_run<lab_control::LogicalRun>;
    options_.out = folder_.path();
  }
  test::DomainReservation domain_;
  test::TemporaryFolder folder_;
  LabControlOptions options_;
};

TEST_F(EmptyLabTest, NamesWhoDoesNotAppear) {
  LabControlProcess process{options_};
  EXPECT_EQ(process.run(), kExitMissing);
  EXPECT_EQ(record::read_facts(folder_ / "run.json").reason,
            "after 1 s: missing: vehicle_raspberry_7, middleware_7, high_level_controller_7");
}

/// A vehicle of the real-time run as far as the lab control meets it.
struct FakeRealVehicle {
  explicit FakeRealVehicle(int domain)
      : participant{dds::on_loopback(vehicle_name(7), domain, dds::DomainRole::kLab)},
        states{participant, dds::topics::vehicle_state(7)},
        triggers{participant, dds::topics::system_trigger()} {}
  dds::Participant participant;
  dds::Writer<VehicleState> states;
  dds::Mailbox<SystemTrigger> triggers;
};

TEST_F(EmptyLabTest, AVehicleThatLeavesAndComesBackWhileTheRunGathersIsReadyAgain) {
  options_.time = machine::kRealTime;
  options_.make_run = lab_control::make_lab_run<lab_control::RealTimeRun>;
  options_.run.startup_timeout = 60 * kNanosecondsPerSecond;
  options_.out.clear();
  LabControlProcess process{options_};
  std::future<int> code = std::async(std::launch::async, [&] { return process.run(); });
  // Ten states make a vehicle ready.
  Nanoseconds create = 0;
  const auto next_state = [&create] {
    return VehicleState{.vehicle_id = 7, .create_stamp = create += kNanosecondsPerSecond / 10};
  };
  {
    FakeRealVehicle first{domain_.first()};
    // The lab control has read a state when it has answered a question that was asked after it.
    dds::Participant asking{dds::on_loopback("asking", domain_.first(), dds::DomainRole::kLab)};
    dds::Mailbox<Parameter> answers{asking, dds::topics::parameter()};
    dds::Writer<ParameterRequest> requests{asking, dds::topics::parameter_request()};
    ASSERT_TRUE(first.states.wait_for_matched(1, dds::soon()));
    ASSERT_TRUE(repeat_until([&] { return !answers.wait_for(0).empty(); },
                             [&] {
                               first.states.write(next_state());
                               requests.write({"middleware_period_ms"});
                             }));
  }
  FakeRealVehicle second{domain_.first()};
  dds::Participant middleware{
      dds::on_loopback(middleware_name(7), domain_.first(), dds::DomainRole::kLab)};
  dds::Mailbox<SystemTrigger> triggers{middleware, dds::topics::system_trigger()};
  dds::Writer<ReadyStatus> ready{middleware, dds::topics::ready_status()};
  ASSERT_TRUE(repeat_until([&] { return !second.triggers.wait_for(0).empty(); },
                           [&] {
                             ready.write({middleware_ready_id(7), 0});
                             second.states.write(next_state());
                           }))
      << "the run does not begin";
  EXPECT_LT(second.triggers.wait_for(0).front().next_start, kStopSymbol);
  process.interrupt();
  EXPECT_EQ(code.get(), kExitInterrupted);
}

TEST_F(EmptyLabTest, DoesNotWriteIntoAFolderThatHoldsARun) {
  test::put(folder_ / "reports.csv", "mine");
  EXPECT_THAT([&] { LabControlProcess{options_}; },
              ThrowsMessage<std::invalid_argument>(HasSubstr("holds no reports.csv")));
}

}  // namespace
}  // namespace hlc::process
