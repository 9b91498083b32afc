#include "tests/soak/fault_plan.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hlc::test {
namespace {

constexpr std::uint64_t kSeeds = 500;

TEST(FaultPlan, FollowsFromItsSeed) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FaultPlan a = plan_faults(seed, 3, true);
    const FaultPlan b = plan_faults(seed, 3, true);
    ASSERT_EQ(a.over_network, b.over_network);
    ASSERT_EQ(a.faults.size(), 3U);
    for (std::size_t i = 0; i < a.faults.size(); ++i) {
      ASSERT_EQ(to_text(a.faults[i]), to_text(b.faults[i])) << "seed " << seed;
    }
  }
}

TEST(FaultPlan, HoldsEveryKindOfFaultOnEveryVehicle) {
  std::set<std::pair<FaultKind, int>> seen;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const PlannedFault& fault : plan_faults(seed, 3, true).faults) {
      seen.insert({fault.kind, fault.vehicle});
    }
  }
  EXPECT_EQ(seen.size(), 7U * 3U + 1U);
}

TEST(FaultPlan, OnlyTheNetworkFailsInARunOverTheNetworkAndThereAloneWithRoot) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const bool with_network : {false, true}) {
      const FaultPlan plan = plan_faults(seed, 3, with_network);
      ASSERT_LE(plan.over_network, with_network);
      for (const PlannedFault& fault : plan.faults) {
        ASSERT_EQ(fault.kind == FaultKind::kCutNetwork, plan.over_network) << "seed " << seed;
      }
    }
  }
}

TEST(FaultPlan, FaultsFollowEachOtherWithinTheStatedTimesAndThoseThatPassLastAWhile) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    double before_s = 0.0;
    double longest_s = 8.0;
    for (const PlannedFault& fault : plan_faults(seed, 4, true).faults) {
      ASSERT_GE(fault.at_s, before_s) << "seed " << seed;
      ASSERT_LE(fault.at_s, before_s + longest_s) << "seed " << seed;
      before_s = fault.at_s;
      longest_s = 2.5;
      const bool kills =
          fault.kind == FaultKind::kKillController || fault.kind == FaultKind::kKillMiddleware ||
          fault.kind == FaultKind::kKillVehicle || fault.kind == FaultKind::kKillLabControl;
      ASSERT_EQ(fault.lasts_s == 0.0, kills) << to_text(fault);
      ASSERT_LE(fault.lasts_s, 3.5) << to_text(fault);
    }
  }
}

TEST(FaultPlan, NamesWhatIsStruck) {
  const PlannedFault killed{.kind = FaultKind::kKillMiddleware, .vehicle = 2, .at_s = 1.5};
  EXPECT_EQ(struck_process(killed), "middleware_2");
  EXPECT_EQ(to_text(killed), "1.50 s middleware_2 killed");
  EXPECT_EQ(to_text({FaultKind::kStopController, 3, 0.25, 2.0}),
            "0.25 s high_level_controller_3 stopped for 2.00 s");
  EXPECT_EQ(to_text({FaultKind::kReturnController, 3, 0.25, 2.0}),
            "0.25 s high_level_controller_3 killed for 2.00 s");
  EXPECT_EQ(struck_process({FaultKind::kReturnController, 3, 0.25, 2.0}),
            "high_level_controller_3");
  EXPECT_EQ(to_text({FaultKind::kCutNetwork, 1, 0.0, 1.0}), "0.00 s machine 1 cut off for 1.00 s");
  EXPECT_EQ(to_text({FaultKind::kKillLabControl, 0, 3.0, 0.0}), "3.00 s lab_control killed");
}

}  // namespace
}  // namespace hlc::test
