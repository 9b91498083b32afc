// One step of a controller's machine: what goes out in which order, and how long it waits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/controller/control_loop.hpp"
#include "tests/hlc_bridge/hlc/driven_machine.hpp"

namespace hlc::high_level_controller::hlc_machine_step_test {
namespace {

using namespace driven_machine;
using controller::east_bound::seen;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// So near that 1 and 2 are coupled; 1 plans first.
constexpr double kNear_m = 0.3;
const std::vector<coordination::MeasuredVehicle>& both() {
  static const std::vector<coordination::MeasuredVehicle> result{seen(1, 0.0, 0.0),
                                                                 seen(2, 0.0, kNear_m)};
  return result;
}

/// The other car's controller, whose messages are triggered by the test.
class Peer {
 public:
  Peer(std::uint8_t vehicle, double y_m)
      : controller_(controller::east_bound::controller(vehicle, y_m)) {}

  coordination::Traffic begin(std::uint64_t step) {
    if (!controller_->has_plan()) {
      static_cast<void>(loop_.stand_by(controller::east_bound::at(step - 1, both())));
    }
    return *loop_.begin(controller::east_bound::at(step, both())).traffic;
  }
  /// @param traffic  of the machine
  coordination::Prediction plan(const coordination::Traffic& traffic) {
    loop_.receive(traffic);
    static_cast<void>(loop_.proceed());
    return *loop_.proceed().prediction;
  }

 private:
  std::unique_ptr<controller::Controller> controller_;
  controller::ControlLoop loop_{*controller_};
};

/// The machine of one of the two, whose car drives.
class HlcMachineStep : public testing::Test {
 protected:
  void drive(const HlcRules& rules, std::uint8_t vehicle) {
    one_.emplace(rules, vehicle, vehicle == 1 ? 0.0 : kNear_m);
    other_.emplace(vehicle == 1 ? std::uint8_t{2} : std::uint8_t{1}, vehicle == 1 ? kNear_m : 0.0);
    one_->on(peers({vehicle == 1 ? std::uint8_t{2} : std::uint8_t{1}}));
    start(*one_, both());
  }
  /// Into a step; the machine's traffic.
  coordination::Traffic begin() {
    one_->next_list(both());
    const std::vector<coordination::Traffic> traffic = one_->take<coordination::Traffic>();
    EXPECT_THAT(traffic, SizeIs(1));
    return traffic.at(0);
  }
  /// Share of the time from the list to the step's end that has passed.
  [[nodiscard]] double share() const {
    const Nanoseconds list = one_->step() * kPeriod + kListOffset;
    return static_cast<double>(one_->now().run - list) / static_cast<double>(kPeriod - kListOffset);
  }
  /// Time passes until an action of that kind; at which share of the step.
  template <class Action>
  double share_of(const Nanoseconds at_most = kPeriod) {
    for (Nanoseconds passed = 0; passed < at_most; passed += kMillisecond) {
      if (!one_->take<Action>().empty()) return share();
      one_->pass(kMillisecond);
    }
    return 1.0;
  }

  std::optional<DrivenMachine> one_;
  std::optional<Peer> other_;
};

constexpr double kTolerance = 0.006;  // a millisecond of 200

TEST_F(HlcMachineStep, TrafficGoesOutAloneAndTheCommandBeforeReportDrawingAndOwnersLook) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.feed(one.wait_for_list(standing()));
  std::vector<std::vector<std::size_t>> kinds;
  do {
    kinds.emplace_back();
    for (const HlcAction& action : one.advance()) kinds.back().push_back(action.index());
  } while (one.is_due());
  const auto kind = [](const HlcAction& action) { return action.index(); };
  ASSERT_THAT(kinds, SizeIs(5));
  EXPECT_THAT(kinds[0], ElementsAre(kind(coordination::Traffic{})));
  EXPECT_THAT(kinds[1], ElementsAre(kind(coordination::Prediction{})));
  EXPECT_THAT(kinds[2], ElementsAre(kind(TrajectoryCommand{}), kind(TrajectoryCommand{})));
  EXPECT_THAT(kinds[3], ElementsAre(kind(ReportRecord{}), kind(DrawStep{}), kind(AfterStep{})))
      << "the vehicles that it waits for are determined after the command";
  EXPECT_THAT(kinds[4], IsEmpty()) << "policies may look ahead then";
}

TEST_F(HlcMachineStep, GoesOnAsSoonAsEverybodyHasAnswered) {
  drive(real_time(), 1);
  const coordination::Traffic traffic = begin();
  EXPECT_EQ(one_->machine().awaited(), 1U);
  one_->on(other_->begin(one_->step()));
  const std::vector<coordination::Prediction> predictions = one_->take<coordination::Prediction>();
  ASSERT_THAT(predictions, SizeIs(1));
  EXPECT_THAT(one_->take<ReportRecord>(), IsEmpty());
  one_->on(other_->plan(traffic));
  const std::vector<ReportRecord> records = one_->take<ReportRecord>();
  ASSERT_THAT(records, SizeIs(1));
  EXPECT_EQ(records[0].report.status, coordination::StepStatus::kPlanned);
  EXPECT_THAT(records[0].report.missing, IsEmpty());
  EXPECT_EQ(one_->machine().awaited(), machine::kOnlyUrgent);
}

TEST_F(HlcMachineStep, MessagesThatComeBeforeTheListCount) {
  drive(real_time(), 1);
  one_->on(other_->begin(one_->step() + 1));
  static_cast<void>(begin());
  EXPECT_THAT(one_->take<coordination::Prediction>(), SizeIs(1));
}

TEST_F(HlcMachineStep, InRealTimeTrafficIsAwaitedUntilItsDeadline) {
  drive(real_time(), 1);
  static_cast<void>(begin());
  EXPECT_NEAR(share_of<coordination::Prediction>(), StepDeadlines{}.traffic, kTolerance);
  const std::vector<ReportRecord> records = one_->take<ReportRecord>();
  ASSERT_THAT(records, SizeIs(1)) << "a missing vehicle is not coupled";
  EXPECT_THAT(records[0].report.missing, ElementsAre(VehicleId{2}));
}

TEST_F(HlcMachineStep, InRealTimePredecessorsAreAwaitedUntilTheirDeadline) {
  drive(real_time(), 2);
  static_cast<void>(begin());
  one_->on(other_->begin(one_->step()));
  EXPECT_NEAR(share_of<coordination::Prediction>(), StepDeadlines{}.predecessors, kTolerance);
  EXPECT_NEAR(share_of<ReportRecord>(), StepDeadlines{}.commit, kTolerance);
}

TEST_F(HlcMachineStep, InRealTimeTheOthersNewPlansAreAwaitedUntilTheirDeadline) {
  drive(real_time(), 1);
  static_cast<void>(begin());
  one_->on(other_->begin(one_->step()));
  EXPECT_THAT(one_->take<coordination::Prediction>(), SizeIs(1));
  EXPECT_NEAR(share_of<ReportRecord>(), StepDeadlines{}.commit, kTolerance);
}

TEST_F(HlcMachineStep, WhoIsGoneFromTheDomainIsNotAwaited) {
  for (const HlcRules& rules : {real_time(), logical_time()}) {
    drive(rules, 1);
    static_cast<void>(begin());
    EXPECT_THAT(one_->take<ReportRecord>(), IsEmpty());
    one_->on(peers());
    EXPECT_THAT(one_->take<ReportRecord>(), SizeIs(1));
  }
}

TEST_F(HlcMachineStep, AfterTheCommandsDeadlineThePlanInForceStaysAndTheMissIsCounted) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.feed(one.wait_for_list(standing()));
  static_cast<void>(one.advance());
  one.delay(190 * kMillisecond);  // the thread gets no processor
  one.advance_until_idle();
  const std::vector<ReportRecord> records = one.take<ReportRecord>();
  ASSERT_THAT(records, SizeIs(1));
  EXPECT_TRUE(records[0].deadline_missed);
  EXPECT_NEAR(static_cast<double>(records[0].late_ns), 10e6, 1e3);
  EXPECT_NEAR(static_cast<double>(records[0].response_ns), 190e6, 1e3);
  EXPECT_EQ(records[0].report.reason, coordination::FallbackReason::kLate);
  EXPECT_THAT(one.take<TrajectoryCommand>(), SizeIs(2)) << "of the plan in force";
}

TEST_F(HlcMachineStep, InLogicalTimeWhoIsSilentForTenSecondsIsNotAwaitedUntilItsTrafficComes) {
  drive(logical_time(), 1);
  static_cast<void>(begin());
  one_->pass(kMessageTimeout - 1);
  EXPECT_THAT(one_->take<ReportRecord>(), IsEmpty());
  one_->pass(1);
  EXPECT_THAT(one_->take<ReportRecord>(), SizeIs(1));
  EXPECT_TRUE(one_->has_logged("high_level_controller_2: no message for 10 s; no longer waiting"));

  static_cast<void>(begin());
  EXPECT_THAT(one_->take<ReportRecord>(), SizeIs(1)) << "at once";
  one_->on(other_->begin(one_->step()));  // for the step that is over
  static_cast<void>(begin());
  EXPECT_THAT(one_->take<ReportRecord>(), IsEmpty());
}

TEST_F(HlcMachineStep, InRealTimeOnlyTheNewestListIsAnsweredInLogicalTimeEveryOne) {
  for (const HlcRules& rules : {real_time(), logical_time()}) {
    DrivenMachine one(rules);
    one.on(peers());
    start(one);
    for (std::uint64_t i = 1; i <= 3; ++i) one.feed(list_of(one.step() + i, standing()));
    one.advance_until_idle();
    EXPECT_THAT(one.take<ReportRecord>(), SizeIs(rules.answers_every_list ? 3 : 1));
    one.on(list_of(one.step() + 3, standing()));
    EXPECT_THAT(one.take<ReportRecord>(), IsEmpty()) << "each step is done once";
  }
}

TEST_F(HlcMachineStep, InRealTimeAListOfTheFarFutureIsDroppedAndTheNextIsAnswered) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  static_cast<void>(one.take<machine::LogLine>());
  for (const std::uint64_t steps : {std::uint64_t{10}, std::uint64_t{1'000'000}}) {
    one.feed(list_of(one.step() + steps, standing()));
  }
  one.advance_until_idle();
  EXPECT_THAT(one.take<ReportRecord>(), IsEmpty());
  const auto lines = one.take<machine::LogLine>();
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_THAT(lines[0].text, testing::HasSubstr("state list of middleware_1 dropped"));
  one.next_list(standing());
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(1));
}

AutomatonRequest slow(std::uint64_t id, std::uint8_t vehicle = 1) {
  return {.vehicle = {vehicle}, .id = id, .subgraph = {.labels = {}, .max_speed_mps = 0.6}};
}

TEST_F(HlcMachineStep, RequestsArePreparedOneByOneBesideTheRun) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.on(slow(1));
  one.on(slow(2));
  one.on(slow(3, 2));
  const std::vector<PrepareRequest> first = one.take<PrepareRequest>();
  ASSERT_THAT(first, SizeIs(1));
  one.next_list(standing());
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(1)) << "real time does not wait";
  one.on(prepare(one.machine().request_base(), first[0].request));
  EXPECT_THAT(one.take<PrepareRequest>(), SizeIs(1)) << "that of another vehicle is none";
  one.next_list(standing());
  const std::vector<AutomatonAnswer> answers = one.take<AutomatonAnswer>();
  ASSERT_THAT(answers, SizeIs(2));
  EXPECT_EQ(answers[0].outcome, RequestOutcome::kAccepted);
  EXPECT_EQ(answers[1].outcome, RequestOutcome::kInForce);
  EXPECT_EQ(answers[1].step, StepIndex{one.step()});
  EXPECT_TRUE(one.has_logged("planning on subgraph"));
}

TEST_F(HlcMachineStep, OfTooManyRequestsTheFirstAreDropped) {
  DrivenMachine one(real_time());
  for (std::uint64_t id = 1; id <= 2 + SubgraphSwitching::kMaxWaiting; ++id) one.on(slow(id));
  std::vector<std::uint64_t> prepared;
  for (std::vector<PrepareRequest> next = one.take<PrepareRequest>(); !next.empty();
       next = one.take<PrepareRequest>()) {
    prepared.push_back(next.at(0).request.id);
    one.on(PreparedRequest{.request = next.at(0).request, .choice = {}, .refusal = "no"});
  }
  ASSERT_THAT(prepared, SizeIs(1 + SubgraphSwitching::kMaxWaiting));
  EXPECT_EQ(prepared[0], 1U) << "in work before";
  EXPECT_EQ(prepared[1], 3U);
}

// Of requests without end, each answered at once, the answers were stored until the next step.
TEST_F(HlcMachineStep, BetweenTwoStepsABoundedNumberOfRequestsIsPrepared) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  std::size_t num_prepared = 0;
  for (std::uint64_t id = 1; id <= 1000; ++id) {
    one.on(slow(id));
    for (const PrepareRequest& next : one.take<PrepareRequest>()) {
      one.on(PreparedRequest{.request = next.request, .choice = {}, .refusal = "no"});
      ++num_prepared;
    }
  }
  EXPECT_EQ(num_prepared, 1 + SubgraphSwitching::kMaxWaiting);
  one.next_list(standing());
  EXPECT_THAT(one.take<AutomatonAnswer>(), SizeIs(num_prepared));
  one.on(slow(1001));
  EXPECT_THAT(one.take<PrepareRequest>(), SizeIs(1)) << "and goes on";
}

TEST_F(HlcMachineStep, InLogicalTimeOfListsWithoutEndTheNewestAreAnswered) {
  DrivenMachine one(logical_time());
  one.on(peers());
  start(one);
  for (std::uint64_t i = 1; i <= 1000; ++i) one.feed(list_of(one.step() + i, standing()));
  for (int i = 0; i < 1000; ++i) static_cast<void>(one.advance());
  const std::vector<ReportRecord> reports = one.take<ReportRecord>();
  ASSERT_EQ(reports.size(), 64U);
  EXPECT_EQ(reports.back().report.step.value, one.step() + 1000);
}

TEST_F(HlcMachineStep, InLogicalTimeTheStepWaitsForWhatIsBeingPreparedButNotForEver) {
  DrivenMachine one(logical_time());
  one.on(peers());
  start(one);
  one.on(slow(1));
  const PrepareRequest first = one.take<PrepareRequest>().at(0);
  one.next_list(standing());
  EXPECT_THAT(one.take<ReportRecord>(), IsEmpty());
  one.on(prepare(one.machine().request_base(), first.request));
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(1));
  EXPECT_THAT(one.take<AutomatonAnswer>(), SizeIs(2));

  one.on(slow(2));
  one.next_list(standing());
  one.pass(logical_time().preparation_patience - 1);
  EXPECT_THAT(one.take<ReportRecord>(), IsEmpty());
  one.pass(1);
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(1)) << "it is in force later";
}

TEST_F(HlcMachineStep, PoliciesLookAheadWhenTheCopyOfTheCommandIsOut) {
  const policy::LookAheadSettings look_ahead{
      .candidates = {{}, {.max_speed_mps = 0.6}}, .steps = 2, .max_expansions = 100};
  DrivenMachine one(real_time_in_the_lab(), 1, 0.0, {.policies = {look_ahead}});
  one.on(peers());
  start(one);
  one.next_list(standing());
  EXPECT_THAT(one.take<TrajectoryCommand>(), SizeIs(1));
  EXPECT_EQ(one.machine().wake_up().wall, one.now().wall + CommandCopies::kPause);
  one.pass(CommandCopies::kPause);
  EXPECT_THAT(one.take<TrajectoryCommand>(), SizeIs(1));
  one.next_list(standing());
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(2));
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_machine_step_test
