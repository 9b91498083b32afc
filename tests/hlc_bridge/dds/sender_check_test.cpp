#include "hlc_bridge/dds/sender_check.hpp"

#include <gtest/gtest.h>

#include "hlc_bridge/dds/sender.hpp"
#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::dds::sender_check_test {
namespace {

constexpr ParticipantKey kStranger{9};
constexpr ParticipantKey kShared{3};

/// Whether messages of `publisher` count as those of the middleware of vehicle 2.
bool counts_as_middleware_2(const Presence& presence, const ParticipantKey& publisher,
                            bool is_among_others = false) {
  return counts(presence, publisher, "middleware_2", is_among_others);
}

TEST(Sender, OnlyAParticipantOfItsNameCounts) {
  Presence presence;
  presence.appeared(kStranger, "stranger");
  EXPECT_FALSE(counts_as_middleware_2(presence, kStranger)) << "nor while the other is absent";
  presence.appeared({2}, "middleware_2");
  EXPECT_TRUE(counts_as_middleware_2(presence, {2}));
  EXPECT_FALSE(counts_as_middleware_2(presence, kStranger));
  presence.appeared({4}, "middleware_2");
  EXPECT_TRUE(counts_as_middleware_2(presence, {4})) << "a restarted one, until the lease expires";
}

TEST(Sender, AParticipantForSeveralVehiclesIsTheSenderOfEach) {
  Presence presence;
  presence.appeared(kShared, "middleware_1,2");
  EXPECT_TRUE(counts_as_middleware_2(presence, kShared));
  EXPECT_FALSE(counts(presence, kShared, "middleware_12", false));
}

TEST(Sender, TheLastMessagesOfAProcessCountAfterItHasLeft) {
  Presence presence;
  presence.appeared({2}, "middleware_2");
  presence.left({2});
  EXPECT_TRUE(counts_as_middleware_2(presence, {2}));
  presence.appeared(kStranger, "stranger");
  presence.left(kStranger);
  EXPECT_FALSE(counts_as_middleware_2(presence, kStranger));
}

TEST(Sender, AmongTheLabsProgramsOthersCountUntilOneOfTheNameIsThere) {
  Presence presence;
  presence.appeared(kStranger, "ParticipantSingleton");
  EXPECT_TRUE(counts_as_middleware_2(presence, kStranger, true));
  presence.appeared({2}, "middleware_2");
  EXPECT_FALSE(counts_as_middleware_2(presence, kStranger, true));
  presence.left({2});
  EXPECT_TRUE(counts_as_middleware_2(presence, kStranger, true));
}

TEST(Sender, IsTheControllerOfTheVehicleThatTheMessageNames) {
  EXPECT_EQ(kItsController(coordination::Traffic{.vehicle = {7}}), "high_level_controller_7");
  EXPECT_EQ(kItsController(StopRequest{.vehicle_id = 8}), "high_level_controller_8");
  EXPECT_EQ(kItsController(ReportRecord{.report = {.vehicle = {9}}}), "high_level_controller_9");
}

TEST(Sender, OfFormerParticipantsOnlySoManyAreKept) {
  Presence presence;
  for (std::size_t i = 0; i <= Presence::kMostFormer; ++i) {
    const ParticipantKey key{1, static_cast<std::uint8_t>(i >> 8U), static_cast<std::uint8_t>(i)};
    presence.appeared(key, "stranger");
    presence.left(key);
  }
  EXPECT_EQ(presence.last_names_of({1, 0, 0}), nullptr);
  EXPECT_NE(presence.last_names_of({1, 0, 1}), nullptr);
}

}  // namespace
}  // namespace hlc::dds::sender_check_test
