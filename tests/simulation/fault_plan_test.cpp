#include "vehicle_sim/closed_loop/fault_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace hlc::closed_loop {
namespace {

FaultPlanSettings settings_of(std::span<const FaultKind> kinds) {
  return {.vehicle_ids = {1, 2, 3}, .kinds = {kinds.begin(), kinds.end()}};
}

TEST(FaultPlan, TheSameSeedGivesTheSameFaultsAndAnotherOneOthers) {
  const FaultPlanSettings settings = settings_of(all_fault_kinds());
  EXPECT_EQ(draw_faults(5, settings), draw_faults(5, settings));
  EXPECT_NE(draw_faults(5, settings), draw_faults(6, settings));
}

TEST(FaultPlan, FaultsLieInTheirTimeAndAreOfTheKindsAskedFor) {
  const std::vector kinds{FaultKind::kKill, FaultKind::kCut};
  FaultPlanSettings settings = settings_of(kinds);
  settings.first = kNanosecondsPerSecond;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::vector<Fault> faults = draw_faults(seed, settings);
    EXPECT_FALSE(faults.empty());
    EXPECT_LE(end_of(faults), settings.last);
    EXPECT_TRUE(std::ranges::is_sorted(faults, {}, &Fault::begin));
    for (const Fault& fault : faults) {
      EXPECT_GE(fault.begin, settings.first);
      EXPECT_LT(fault.begin, fault.end);
      EXPECT_TRUE(std::ranges::count(kinds, fault.kind) == 1) << to_string(fault);
    }
  }
}

TEST(FaultPlan, EveryKindComesSoonerOrLaterAndEveryKindOfProcessIsKilledAndFrozen) {
  std::set<FaultKind> kinds;
  std::set<std::pair<FaultKind, std::string>> held_up;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    for (const Fault& fault : draw_faults(seed, settings_of(all_fault_kinds()))) {
      kinds.insert(fault.kind);
      const bool holds_up = fault.kind == FaultKind::kKill || fault.kind == FaultKind::kFreeze;
      if (holds_up) held_up.emplace(fault.kind, fault.process);
    }
  }
  EXPECT_EQ(kinds.size(), all_fault_kinds().size());
  EXPECT_EQ(held_up.size(), 2U * (1 + 3 * 3)) << "lab control, and three processes per vehicle";
}

TEST(FaultPlan, EveryStyleKeepsToTheTimeAndTheKinds) {
  const std::vector kinds{FaultKind::kLose, FaultKind::kKill, FaultKind::kRepeat};
  FaultPlanSettings settings = settings_of(kinds);
  settings.first = kNanosecondsPerSecond;
  for (const FaultStyle style : {FaultStyle::kScattered, FaultStyle::kBurst, FaultStyle::kLossy,
                                 FaultStyle::kRestart, FaultStyle::kBorder, FaultStyle::kSilence}) {
    settings.style = style;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const std::vector<Fault> faults = draw_faults(seed, settings);
      EXPECT_TRUE(std::ranges::is_sorted(faults, {}, &Fault::begin));
      for (const Fault& fault : faults) {
        EXPECT_GE(fault.begin, settings.first) << to_string(fault);
        EXPECT_LT(fault.begin, fault.end) << to_string(fault);
        EXPECT_LE(fault.end, settings.last) << to_string(fault);
        EXPECT_TRUE(std::ranges::count(kinds, fault.kind) == 1) << to_string(fault);
      }
    }
  }
}

TEST(FaultPlan, NobodyIsKilledWhileItStandsStill) {
  const std::vector kinds{FaultKind::kKill, FaultKind::kFreeze};
  FaultPlanSettings settings = settings_of(kinds);
  settings.vehicle_ids = {1};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::vector<Fault> faults = draw_faults(seed, settings);
    for (std::size_t i = 0; i < faults.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_TRUE(faults[i].process != faults[j].process || faults[j].end < faults[i].begin);
      }
    }
  }
}

TEST(FaultPlan, WithoutKindsThereAreNoFaults) {
  EXPECT_TRUE(draw_faults(1, settings_of({})).empty());
  EXPECT_EQ(end_of({}), 0U);
}

TEST(FaultPlan, AFaultIsALine) {
  const Fault cut{.kind = FaultKind::kCut,
                  .begin = 2'150'000'000,
                  .end = 3'200'000'000,
                  .process = "middleware_1"};
  EXPECT_EQ(to_string(cut), "2.150 s ... 3.200 s: cut middleware_1 -> any");
  const Fault flood{.kind = FaultKind::kFlood,
                    .begin = 2'000'000'000,
                    .end = 3'000'000'000,
                    .process = "lab_control",
                    .amount = 2000};
  EXPECT_EQ(to_string(flood), "2.000 s ... 3.000 s: flood lab_control -> any, 2000 a second");
}

TEST(FaultPlan, AFaultForGoodIsOverForTheOthersWhenItBegins) {
  const Fault death{
      .kind = FaultKind::kKill, .begin = 2'000'000'000, .end = kForGood, .process = "middleware_1"};
  EXPECT_EQ(to_string(death), "2.000 s ... end: kill middleware_1");
  EXPECT_EQ(end_of(std::vector{death}), death.begin);
}

}  // namespace
}  // namespace hlc::closed_loop
