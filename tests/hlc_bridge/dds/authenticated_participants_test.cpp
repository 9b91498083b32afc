#include "hlc_bridge/dds/authenticated_participants.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hlc_bridge/dds/security.hpp"

namespace hlc::dds::authenticated_participants_test {
namespace {

ParticipantKey key_with(const std::string& identity, std::uint8_t last) {
  ParticipantKey key{};
  const IdentityKey begin = key_of_identity(identity).value();
  std::copy(begin.begin(), begin.end(), key.begin());
  key.back() = last;
  return key;
}

TEST(AuthenticatedParticipants, LetsInWhoHasBeenAnnouncedAndHasProvenItsIdentity) {
  AuthenticatedParticipants participants;
  const ParticipantKey key = key_with("middleware_2", 1);
  EXPECT_FALSE(participants.announced({.key = key, .name = "middleware_2", .user_data = "1.0"}));
  const auto present = participants.authenticated(key);
  ASSERT_TRUE(present);
  EXPECT_EQ(present->key, key);
  EXPECT_EQ(present->name, "middleware_2");
  EXPECT_EQ(present->user_data, "1.0");
}

TEST(AuthenticatedParticipants, TakesBothInAnyOrder) {
  AuthenticatedParticipants participants;
  const ParticipantKey key = key_with("middleware_2", 1);
  EXPECT_FALSE(participants.authenticated(key));
  EXPECT_TRUE(participants.announced({.key = key, .name = "middleware_2", .user_data = {}}));
}

TEST(AuthenticatedParticipants, IsAskedForAgainAfterAParticipantHasLeft) {
  AuthenticatedParticipants participants;
  const ParticipantKey key = key_with("middleware_2", 1);
  EXPECT_FALSE(participants.authenticated(key));
  participants.left(key);
  EXPECT_FALSE(participants.announced({.key = key, .name = "middleware_2", .user_data = {}}));
}

TEST(AuthenticatedParticipants, NamesOnceWhoIsRefused) {
  AuthenticatedParticipants participants;
  const ParticipantKey key = key_with("middleware_2", 1);
  EXPECT_FALSE(participants.announced({.key = key, .name = "stranger", .user_data = {}}));
  EXPECT_EQ(participants.refused(key), "stranger");
  EXPECT_EQ(participants.refused(key), std::nullopt);
  participants.left(key);
  EXPECT_EQ(participants.refused(key), std::nullopt);
  for (std::size_t i = 1; i < AuthenticatedParticipants::kMostNamed; ++i) {
    EXPECT_EQ(participants.refused(key_with("middleware_3", static_cast<std::uint8_t>(i))), "");
  }
  EXPECT_EQ(participants.refused(key_with("middleware_4", 1)), std::nullopt);
}

TEST(AuthenticatedParticipants, NamesWhoTakesTheNameOfAnotherIdentity) {
  AuthenticatedParticipants participants;
  const auto name_of = [&](const std::string& identity, const std::string& name) {
    const ParticipantKey key = key_with(identity, 1);
    participants.left(key);
    EXPECT_FALSE(participants.authenticated(key));
    return participants.announced({.key = key, .name = name, .user_data = {}}).value().name;
  };
  EXPECT_EQ(name_of("high_level_controller_2", "high_level_controller_3"),
            "high_level_controller_3 with another's identity");
  EXPECT_EQ(name_of("middleware_2", "middleware_2,3"), "middleware_2,3 with another's identity");
  EXPECT_EQ(name_of("middleware", "middleware_2,3"), "middleware_2,3");
  EXPECT_EQ(name_of("middleware", std::string(70, 'x')),
            std::string(70, 'x') + " with another's identity");
}

}  // namespace
}  // namespace hlc::dds::authenticated_participants_test
