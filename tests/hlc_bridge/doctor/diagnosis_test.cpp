#include "hlc_bridge/doctor/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hlc::doctor {
namespace {

constexpr Nanoseconds kNow = 1'700'000'000'000'000'000;

/// Three seconds of vehicle 1 alone, with all that a run needs.
Received good(std::int64_t age_ns = 2'000'000) {
  Received received;
  received.ended_at = kNow + 3'000'000'000;
  received.lab_control_answers = true;
  received.period_ms = 200;
  received.controllers = {"high_level_controller_1"};
  for (Nanoseconds i = 0; i < 150; ++i) {
    const Nanoseconds now = kNow + i * 20'000'000;
    note({.vehicle_id = 1, .create_stamp = now - static_cast<Nanoseconds>(age_ns)}, now, received);
  }
  return received;
}

std::vector<Finding> bad_ones(const std::vector<int>& ids, const Received& received) {
  std::vector<Finding> findings = diagnose(ids, received);
  std::erase_if(findings, [](const Finding& f) { return f.verdict != Verdict::kBad; });
  return findings;
}

TEST(Diagnosis, OfALabThatIsCompleteIsGood) {
  for (const Finding& finding : diagnose({1}, good())) {
    EXPECT_EQ(finding.verdict, Verdict::kGood) << finding.what;
    EXPECT_EQ(finding.advice, "");
  }
}

TEST(Diagnosis, ProgramsOfAnotherRevisionAreNamedAndTheLabsOwnAreNot) {
  Received received = good();
  received.versions = {{"middleware_1", "revision a"}, {"high_level_controller_1", "revision b"}};
  const auto is_bad = [](const Finding& finding) { return finding.verdict == Verdict::kBad; };
  const std::vector<Finding> findings = diagnose({1}, received, "revision a");
  const auto found = std::ranges::find_if(findings, is_bad);
  ASSERT_EQ(std::ranges::count_if(findings, is_bad), 1);
  EXPECT_EQ(found->what, "high_level_controller_1: revision b, this machine: revision a");
}

TEST(Diagnosis, NamesWhoDoesNotAnswerAndSaysWhatToDo) {
  const std::vector<Finding> findings = bad_ones({1, 2}, good());
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].what, "vehicle 2: no state");
  EXPECT_NE(findings[0].advice, "");

  Received silent;
  silent.listened_to_middleware = true;
  EXPECT_EQ(bad_ones({1, 2}, silent).size(), 4U) << "lab control, two vehicles, middleware";
}

TEST(Diagnosis, TellsOfClocksThatDiffer) {
  const auto ahead = bad_ones({1}, good(-40'000'000));
  ASSERT_EQ(ahead.size(), 1U);
  EXPECT_EQ(ahead[0].what, "vehicle 1: its clock is ahead of this machine's by at least 40.0 ms");
  const auto behind = bad_ones({1}, good(400'000'000));
  ASSERT_EQ(behind.size(), 1U);
  EXPECT_EQ(behind[0].what, "vehicle 1: its states are at least 400.0 ms old when they arrive");
}

TEST(Diagnosis, TakesTheYoungestStateForTheClock) {
  Received received = good();
  note({.vehicle_id = 1, .create_stamp = kNow - 900'000'000}, kNow, received);
  EXPECT_TRUE(bad_ones({1}, received).empty()) << "one late state is no clock that differs";
}

TEST(Diagnosis, TellsOfAVehicleThatTheCamerasDoNotSeeAnyMore) {
  Received received = good();
  const auto note_with_age = [&received](Nanoseconds age) {
    note({.vehicle_id = 1, .create_stamp = kNow, .ips_update_age = age}, kNow, received);
  };
  note_with_age(600'000'000);
  const auto findings = bad_ones({1}, received);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].what, "vehicle 1: the cameras have not seen it for more than 500.0 ms");
  note_with_age(80'000'000);
  EXPECT_TRUE(bad_ones({1}, received).empty());
}

TEST(Diagnosis, DoesNotCompareLogicalTimeWithAClock) {
  Received received = good();
  received.vehicles.clear();
  for (Nanoseconds i = 1; i <= 150; ++i) {
    note({.vehicle_id = 1, .create_stamp = i * 20'000'000}, kNow, received);
  }
  EXPECT_TRUE(bad_ones({1}, received).empty());
}

TEST(Diagnosis, TellsOfStatesThatAreLost) {
  Received received = good();
  received.ended_at = kNow + 10'000'000'000;
  const auto findings = bad_ones({1}, received);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].what.find("vehicle 1: 15.0 states per second instead of 50"), 0U);
}

TEST(Diagnosis, CountsStatesFromTheFirstOneOn) {
  Received received = good();
  ASSERT_EQ(received.vehicles.at(1).first_at, kNow);
  const std::vector<Finding> findings = diagnose({1}, received);
  EXPECT_EQ(findings[1].what.find("vehicle 1: 50.0 states per second"), 0U) << findings[1].what;
}

TEST(Diagnosis, ComparesTheListsStampsWithTheClock) {
  Received received = good();
  received.listened_to_middleware = true;
  note({.t_now = kNow}, kNow + 300'000, received);
  note({.t_now = kNow}, kNow + 900'000'000, received);
  EXPECT_TRUE(bad_ones({1}, received).empty()) << "one late list is no clock that differs";
  note({.t_now = kNow}, kNow - 40'000'000, received);
  ASSERT_EQ(bad_ones({1}, received).size(), 1U);
  EXPECT_EQ(bad_ones({1}, received)[0].what,
            "middleware: 3 state lists, stamped at least 40.0 ms ahead of this clock");

  Received late = good();
  late.listened_to_middleware = true;
  note({.t_now = kNow}, kNow + 400'000'000, late);
  ASSERT_EQ(bad_ones({1}, late).size(), 1U);
  EXPECT_EQ(bad_ones({1}, late)[0].what, "middleware: 1 state lists, at least 400.0 ms old");
  EXPECT_EQ(bad_ones({1}, late)[0].advice, "the middleware or this machine is overloaded");

  Received logical = good();
  logical.listened_to_middleware = true;
  note({.t_now = 200'000'001}, kNow, logical);
  EXPECT_TRUE(bad_ones({1}, logical).empty());
}

TEST(Diagnosis, IsCompleteOnceEverythingAndEveryVehicleLongEnoughWasReceived) {
  constexpr Nanoseconds kSpan = 3'000'000'000;
  Received received = good();
  EXPECT_FALSE(is_complete({1}, received, kNow + kSpan - 1, kSpan));
  EXPECT_TRUE(is_complete({1}, received, kNow + kSpan, kSpan));
  EXPECT_FALSE(is_complete({1, 2}, received, kNow + kSpan, kSpan)) << "no state of 2";
  received.listened_to_middleware = true;
  EXPECT_FALSE(is_complete({1}, received, kNow + kSpan, kSpan));
  note({.t_now = kNow}, kNow, received);
  EXPECT_TRUE(is_complete({1}, received, kNow + kSpan, kSpan));
  received.controllers.clear();
  EXPECT_FALSE(is_complete({1}, received, kNow + kSpan, kSpan));
  received = good();
  received.lab_control_answers = false;
  EXPECT_FALSE(is_complete({1}, received, kNow + kSpan, kSpan));
}

TEST(Diagnosis, NotesAVehicleThatNobodyAskedFor) {
  const std::vector<Finding> findings = diagnose({}, good());
  EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& finding) {
    return finding.verdict == Verdict::kNote && finding.what == "vehicle 1: also present";
  }));
}

}  // namespace
}  // namespace hlc::doctor
