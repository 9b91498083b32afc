#include "hlc_bridge/dds/presence.hpp"

#include <gtest/gtest.h>

namespace hlc::dds::presence_test {
namespace {

using Names = std::set<std::string>;

TEST(Presence, WhoAppearedIsAliveUntilItLeaves) {
  Presence presence;
  presence.appeared({1}, "red");
  presence.appeared({2}, "blue");
  EXPECT_EQ(presence.alive(), (Names{"red", "blue"}));
  EXPECT_EQ(presence.lost(), Names{});
  presence.left({1});
  EXPECT_EQ(presence.alive(), Names{"blue"});
  EXPECT_EQ(presence.lost(), Names{"red"});
}

TEST(Presence, WhoComesBackIsNotLost) {
  Presence presence;
  presence.appeared({1}, "red");
  presence.left({1});
  presence.appeared({2}, "red");
  EXPECT_EQ(presence.alive(), Names{"red"});
  EXPECT_EQ(presence.lost(), Names{});
}

TEST(Presence, ANameIsLostOnlyWhenItsLastParticipantLeft) {
  Presence presence;
  presence.appeared({1}, "ParticipantSingleton");
  presence.appeared({2}, "ParticipantSingleton");
  presence.left({1});
  EXPECT_EQ(presence.lost(), Names{});
  presence.left({2});
  EXPECT_EQ(presence.lost(), Names{"ParticipantSingleton"});
}

TEST(Presence, VersionsAreOfThoseThatAreThereAndSayTheirs) {
  Presence presence;
  presence.appeared({1}, "red", "revision 1");
  presence.appeared({2}, "blue", "revision 2");
  presence.appeared({3}, "green");
  presence.left({2});
  EXPECT_EQ(presence.versions(), (std::map<std::string, std::string>{{"red", "revision 1"}}));
}

TEST(Presence, RepeatedOrUnknownEventsChangeNothing) {
  Presence presence;
  presence.left({3});
  presence.appeared({1}, "red");
  presence.appeared({1}, "red");
  presence.left({1});
  presence.left({1});
  EXPECT_EQ(presence.alive(), Names{});
  EXPECT_EQ(presence.lost(), Names{"red"});
}

TEST(Presence, NamesAreKnownWhileTheParticipantIsThere) {
  Presence presence;
  EXPECT_TRUE(presence.names_of({1}).empty());
  presence.appeared({1}, "red");
  EXPECT_EQ(presence.names_of({1}), std::vector<std::string>{"red"});
  presence.left({1});
  EXPECT_TRUE(presence.names_of({1}).empty());
}

TEST(Presence, AParticipantOfSeveralVehiclesIsEachOfTheirProcesses) {
  Presence presence;
  presence.appeared({1}, "middleware_1,12", "revision 1");
  presence.appeared({2}, "middleware_12");
  EXPECT_EQ(presence.alive(), (Names{"middleware_1", "middleware_12"}));
  EXPECT_EQ(presence.names_of({1}), (std::vector<std::string>{"middleware_1", "middleware_12"}));
  EXPECT_EQ(presence.versions().size(), 2U);
  presence.left({1});
  EXPECT_EQ(presence.alive(), Names{"middleware_12"}) << "another one serves it, too";
  EXPECT_EQ(presence.lost(), Names{"middleware_1"});
}

}  // namespace
}  // namespace hlc::dds::presence_test
