#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <thread>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::round_trip_test {
namespace {

template <class Message>
struct Place;  // where a message is at home

// clang-format off
template <> struct Place<VehicleState> { static auto topic() { return topics::vehicle_state(3); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<VehicleObservation> { static auto topic() { return topics::vehicle_observation(3); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<VehicleStateList> { static auto topic() { return topics::vehicle_state_list(); } static constexpr auto kRole = DomainRole::kLocal; };
template <> struct Place<TrajectoryCommand> { static auto topic() { return topics::command(); } static constexpr auto kRole = DomainRole::kLocal; };
template <> struct Place<PathTrackingCommand> { static auto topic() { return topics::command<PathTrackingCommand>(); } static constexpr auto kRole = DomainRole::kLocal; };
template <> struct Place<SpeedCurvatureCommand> { static auto topic() { return topics::vehicle_command<SpeedCurvatureCommand>(3); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<DirectCommand> { static auto topic() { return topics::vehicle_command<DirectCommand>(3); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<ReadyStatus> { static auto topic() { return topics::ready_status(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<SystemTrigger> { static auto topic() { return topics::system_trigger(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<Parameter> { static auto topic() { return topics::parameter(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<ParameterRequest> { static auto topic() { return topics::parameter_request(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<StopRequest> { static auto topic() { return topics::stop_request(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<Log> { static auto topic() { return topics::log(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<LogLevel> { static auto topic() { return topics::log_level(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<GoalState> { static auto topic() { return topics::goal_state(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<Visualization> { static auto topic() { return topics::visualization(); } static constexpr auto kRole = DomainRole::kLab; };
template <> struct Place<coordination::Traffic> { static auto topic() { return topics::traffic(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<coordination::Prediction> { static auto topic() { return topics::prediction(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<coordination::Outcome> { static auto topic() { return topics::outcome(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<ReportRecord> { static auto topic() { return topics::report(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<AutomatonRequest> { static auto topic() { return topics::automaton_request(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<AutomatonAnswer> { static auto topic() { return topics::automaton_answer(); } static constexpr auto kRole = DomainRole::kController; };
template <> struct Place<RunState> { static auto topic() { return topics::run_state(); } static constexpr auto kRole = DomainRole::kController; };
// clang-format on

template <class Message>
class RoundTrip : public testing::Test {};
TYPED_TEST_SUITE(RoundTrip, AllMessages);

TYPED_TEST(RoundTrip, MessagesArriveAsTheyWereWrittenAndInOrder) {
  const unsigned seed = 4;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), Place<TypeParam>::kRole)};
  Participant receiver{on_loopback("receiver", domain.first(), Place<TypeParam>::kRole)};
  Mailbox<TypeParam> mailbox{receiver, Place<TypeParam>::topic()};
  Writer<TypeParam> writer{sender, Place<TypeParam>::topic()};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  for (std::size_t i = 0; i < 20; ++i) {
    const auto message = sample<TypeParam>(random);
    ASSERT_TRUE(writer.write(message));
    const std::vector<TypeParam> received = mailbox.wait_for(i + 1);
    ASSERT_EQ(received.size(), i + 1);
    ASSERT_EQ(text(received.back()), text(message));
  }
  EXPECT_EQ(mailbox.reader().dropped(), 0U);
  EXPECT_EQ(mailbox.reader().lost(), 0U);
}

// A control thread may hold no lock over a write, but it can rely on this: the write itself runs no
// callback.
TEST(Callbacks, RunOnAnotherThreadThanTheWriterAlsoWithinOneProcess) {
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kController)};
  Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kController)};
  time::Signal signal;
  std::vector<std::thread::id> callers;
  Reader<coordination::Outcome> reader{
      receiver, topics::outcome(), [&](const coordination::Outcome&) {
        signal.post([&] { callers.push_back(std::this_thread::get_id()); });
      }};
  Writer<coordination::Outcome> writer{sender, topics::outcome()};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  ASSERT_TRUE(reader.wait_for_matched(1, soon()));
  ASSERT_TRUE(
      writer.write(coordination::Outcome{.vehicle = {1}, .step = {0}, .wants_fallback = false}));
  ASSERT_TRUE(signal.wait_until(soon(), [&] { return !callers.empty(); }));
  EXPECT_NE(callers.front(), std::this_thread::get_id());
}

TEST(LargeMessage, OfSeveralDatagramsArrives) {
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kController)};
  Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kController)};
  Mailbox<coordination::Traffic> mailbox{receiver, topics::traffic()};
  Writer<coordination::Traffic> writer{sender, topics::traffic()};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  constexpr std::size_t kDepth = 8;  // of the topic's history: what repairs can be asked for
  coordination::Traffic traffic;
  traffic.vehicle = {1};
  ConvexPolygon round;
  for (int i = 0; i < 200; ++i) {
    round.vertices_m.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i));
  }
  traffic.running.areas_m.assign(50, round);  // 160 kB
  for (std::size_t i = 0; i < kDepth; ++i) {
    traffic.step = {i};
    ASSERT_TRUE(writer.write(traffic));
  }
  const std::vector<coordination::Traffic> received = mailbox.wait_for(kDepth);
  ASSERT_EQ(received.size(), kDepth);
  EXPECT_EQ(text(received.back()), text(traffic));
}

// The library's default of ten instances would lose the samples of the eleventh and later vehicles.
TEST(KeyedTopics, AllOf30VehiclesAreHeard) {
  const test::DomainReservation domain;
  Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kController)};
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kController)};
  Mailbox<coordination::Outcome> of_many{receiver, topics::outcome()};
  Mailbox<coordination::Prediction> of_one{receiver, topics::prediction()};
  std::vector<std::unique_ptr<Writer<coordination::Outcome>>> writers;
  for (int id = 1; id <= 30; ++id) {
    writers.push_back(std::make_unique<Writer<coordination::Outcome>>(sender, topics::outcome()));
    ASSERT_TRUE(writers.back()->wait_for_matched(1, soon()));
  }
  Writer<coordination::Prediction> one_for_all{sender, topics::prediction()};
  ASSERT_TRUE(one_for_all.wait_for_matched(1, soon()));
  ASSERT_TRUE(of_many.reader().wait_for_matched(30, soon()));

  constexpr std::uint64_t kSteps = 20;
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    for (std::uint8_t id = 1; id <= 30; ++id) {
      coordination::Outcome outcome;
      outcome.vehicle = {id};
      outcome.step = {step};
      ASSERT_TRUE(writers[id - 1U]->write(outcome)) << "vehicle " << +id;
      coordination::Prediction prediction;
      prediction.vehicle = {id};
      prediction.step = {step};
      ASSERT_TRUE(one_for_all.write(prediction)) << "vehicle " << +id;
    }
    ASSERT_EQ(of_many.wait_for(30 * (step + 1)).size(), 30 * (step + 1));
    ASSERT_EQ(of_one.wait_for(30 * (step + 1)).size(), 30 * (step + 1));
  }
  std::map<std::uint8_t, std::uint64_t> received;
  for (const coordination::Outcome& outcome : of_many.wait_for(30 * kSteps)) {
    EXPECT_EQ(outcome.step.value, received[outcome.vehicle.value]++) << "out of order";
  }
  EXPECT_EQ(received.size(), 30U);
}

TEST(KeyedTopics, AVehicleIdWithoutRoomIsNotWritten) {
  const test::DomainReservation domain;
  Participant participant{on_loopback("sender", domain.first(), DomainRole::kController)};
  Writer<coordination::Outcome> writer{participant, topics::outcome()};
  EXPECT_FALSE(
      writer.write(coordination::Outcome{.vehicle = {31}, .step = {0}, .wants_fallback = false}));
  EXPECT_TRUE(
      writer.write(coordination::Outcome{.vehicle = {30}, .step = {0}, .wants_fallback = false}));
}

TEST(LateJoiner, GetsEveryReportAndTheLastRunState) {
  constexpr std::uint64_t kSteps = 2000;
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kController)};
  Writer<ReportRecord> red{sender, topics::report()};
  Writer<ReportRecord> blue{sender, topics::report()};
  Writer<RunState> run_state{sender, topics::run_state()};
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    ReportRecord record;
    record.report.step = {step};
    record.report.vehicle = {1};
    ASSERT_TRUE(red.write(record));
    record.report.vehicle = {2};
    ASSERT_TRUE(blue.write(record));
  }
  ASSERT_TRUE(run_state.write({RunPhase::kRunning, 7}));
  ASSERT_TRUE(run_state.write({RunPhase::kMinimalRiskStop, 7}));

  Participant late{on_loopback("late", domain.first(), DomainRole::kController)};
  Mailbox<ReportRecord> reports{late, topics::report()};
  Mailbox<RunState> states{late, topics::run_state()};
  std::map<std::uint8_t, std::uint64_t> next;
  for (const ReportRecord& record : reports.wait_for(2 * kSteps)) {
    ASSERT_EQ(record.report.step.value, next[record.report.vehicle.value]++);
  }
  EXPECT_EQ(next, (std::map<std::uint8_t, std::uint64_t>{{1, kSteps}, {2, kSteps}}));
  const std::vector<RunState> received = states.wait_for(1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received.front().phase, RunPhase::kMinimalRiskStop);
}

// A burst as long as the history: repairs must come from it.
TEST(Burst, OfAWholeHistoryArrivesCompletely) {
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kLab)};
  Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kLab)};
  Mailbox<SystemTrigger> mailbox{receiver, topics::system_trigger()};
  Writer<SystemTrigger> writer{sender, topics::system_trigger()};
  ASSERT_TRUE(writer.wait_for_matched(1, soon()));
  constexpr std::uint64_t kCount = 512;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    ASSERT_TRUE(writer.write({i}));
  }
  const std::vector<SystemTrigger> received = mailbox.wait_for(kCount);
  ASSERT_EQ(received.size(), kCount);
  for (std::uint64_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(received[i].next_start, i);
  }
}

TEST(OwnParticipant, IsNotHeardAndDoesNotCount) {
  const test::DomainReservation domain;
  Participant both{on_loopback("both", domain.first(), DomainRole::kController)};
  Participant other{on_loopback("other", domain.first(), DomainRole::kController)};
  Mailbox<coordination::Outcome> own{both, topics::outcome()};
  Mailbox<coordination::Outcome> others{other, topics::outcome()};
  Writer<coordination::Outcome> writer{both, topics::outcome()};
  Writer<coordination::Outcome> other_writer{other, topics::outcome()};
  ASSERT_TRUE(writer.wait_for_matched({"other"}, soon()));
  ASSERT_TRUE(other_writer.wait_for_matched({"both"}, soon()));
  ASSERT_TRUE(
      writer.write(coordination::Outcome{.vehicle = {1}, .step = {1}, .wants_fallback = false}));
  ASSERT_EQ(others.wait_for(1).size(), 1U);
  ASSERT_TRUE(other_writer.write(
      coordination::Outcome{.vehicle = {2}, .step = {2}, .wants_fallback = false}));
  const std::vector<coordination::Outcome> received = own.wait_for(1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received.front().vehicle.value, 2);
  EXPECT_EQ(writer.matched(), 1U);
  EXPECT_EQ(writer.matched_names(), std::set<std::string>{"other"});
  EXPECT_EQ(own.reader().matched_names(), std::set<std::string>{"other"});
}

}  // namespace
}  // namespace hlc::dds::round_trip_test
