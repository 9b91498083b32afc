#include "hlc_bridge/live/foxglove_protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::live {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(FoxgloveProtocol, TakesTheFirstSubprotocolThatItKnows) {
  EXPECT_EQ(subprotocol_among("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(subprotocol_among("other, foxglove.sdk.v1,foxglove.websocket.v1"), "foxglove.sdk.v1");
  for (const char* offered :
       {"", "other", "foxglove.websocket.v2", ",,", "foxglove.websocket.v1x"}) {
    EXPECT_EQ(subprotocol_among(offered), "") << offered;
  }
}

TEST(FoxgloveProtocol, AdvertisesEveryChannelWithItsSchema) {
  EXPECT_EQ(json::parse(server_info("7")).at("sessionId"), "7");
  const json advertised = json::parse(advertisement(view::LiveScene::channels()));
  EXPECT_EQ(advertised.at("op"), "advertise");
  ASSERT_EQ(advertised.at("channels").size(), view::LiveScene::channels().size());
  for (std::size_t id = 0; id < advertised.at("channels").size(); ++id) {
    const json& channel = advertised.at("channels")[id];
    EXPECT_EQ(channel.at("id"), id);
    EXPECT_EQ(channel.at("topic"), view::LiveScene::channels()[id].topic);
    EXPECT_EQ(json::parse(channel.at("schema").get<std::string>()).at("title"),
              channel.at("schemaName"));
  }
}

TEST(FoxgloveProtocol, AMessageHasItsSubscriptionAndItsTimeInLittleEndian) {
  EXPECT_EQ(message_data(0x01020304, 0x0A0B0C0D0E0F1011, "{}"),
            std::string("\x01\x04\x03\x02\x01\x11\x10\x0F\x0E\x0D\x0C\x0B\x0A{}"));
}

TEST(Subscriptions, FollowWhatTheClientSends) {
  Subscriptions subscriptions(4);
  EXPECT_EQ(subscriptions.take(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":3},
                                   {"id":2,"channelId":0}]})"),
            "");
  EXPECT_THAT(subscriptions.channels(), ElementsAre(Pair(2U, 0U), Pair(9U, 3U)));
  EXPECT_EQ(subscriptions.take(R"({"op":"unsubscribe","subscriptionIds":[9,77]})"), "");
  EXPECT_THAT(subscriptions.channels(), ElementsAre(Pair(2U, 0U)));
}

TEST(Subscriptions, WhatIsNotUnderstoodIsAnsweredAndChangesNothing) {
  Subscriptions subscriptions(4);
  for (const char* message :
       {"", "[]", "null", "{", R"({"op":7})", R"({"op":"publish"})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4}]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[7,null,{}]})",
        R"({"op":"unsubscribe","subscriptionIds":{"a":1}})", "\xff\xfe"}) {
    const json answer = json::parse(subscriptions.take(message), nullptr, false);
    ASSERT_TRUE(answer.is_object()) << message;
    EXPECT_EQ(answer.at("op"), "status") << message;
    EXPECT_THAT(subscriptions.channels(), IsEmpty()) << message;
  }
}

TEST(Subscriptions, AClientHasAThousandAtMost) {
  Subscriptions subscriptions(1);
  json message{{"op", "subscribe"}, {"subscriptions", json::array()}};
  for (int id = 0; id < 5000; ++id) {
    message["subscriptions"].push_back({{"id", id}, {"channelId", 0}});
  }
  EXPECT_THAT(subscriptions.take(message.dump()), HasSubstr("status"));
  EXPECT_EQ(subscriptions.channels().size(), 1000U);
}

TEST(Subscriptions, NoBytesDoHarm) {
  const std::string valid = R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":3}]})";
  for (std::uint64_t seed = 0; seed < test::num_seeds(2000); ++seed) {
    std::mt19937_64 random(seed);
    std::string message = valid;
    for (std::size_t changes = random() % 4 + 1; changes > 0; --changes) {
      message[random() % message.size()] = static_cast<char>(random());
    }
    Subscriptions subscriptions(4);
    static_cast<void>(subscriptions.take(message));
    for (const auto& [id, channel] : subscriptions.channels()) EXPECT_LT(channel, 4U) << seed;
  }
}

}  // namespace
}  // namespace hlc::live
