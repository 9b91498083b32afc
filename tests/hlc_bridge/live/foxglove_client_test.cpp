// Clients of the server that draw by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <list>
#include <nlohmann/json.hpp>

#include "tests/hlc_bridge/live/running_server.hpp"
#include "tests/hlc_bridge/live/websocket.hpp"
#include "tests/support/child_process.hpp"

namespace hlc::live {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

constexpr const char* kSubscribe =
    R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1},{"id":6,"channelId":0}]})";

json text_of(const std::optional<Websocket::Frame>& frame) {
  if (!frame || frame->opcode != 1) return {};
  return json::parse(frame->payload, nullptr, false);
}

struct Data {
  std::uint32_t subscription{};
  std::uint64_t time{};
  std::string text;
};

Data data_of(const std::optional<Websocket::Frame>& frame) {
  if (!frame || frame->opcode != 2 || frame->payload.size() < 13) return {};
  Data data;
  std::memcpy(&data.subscription, &frame->payload[1], sizeof data.subscription);
  std::memcpy(&data.time, &frame->payload[5], sizeof data.time);
  data.text = frame->payload.substr(13);
  return data;
}

/// A client after the server's first two messages.
void greet(Websocket& client) {
  EXPECT_THAT(client.answer(), StartsWith("HTTP/1.1 101 "));
  EXPECT_THAT(client.answer(), HasSubstr("Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n"));
  EXPECT_EQ(text_of(client.next()).value("op", ""), "serverInfo");
  EXPECT_EQ(text_of(client.next()).value("op", ""), "advertise");
}

TEST(FoxgloveClient, GetsTheNewestMessageOfItsChannelsAndThenWhatFollows) {
  RunningServer server;
  server.append(view::SceneMessage{.channel = 1, .time = 40, .text = "old"});
  server.append(view::SceneMessage{.channel = 1, .time = 80, .text = "newest"});
  server.append(view::SceneMessage{.channel = 2, .time = 80, .text = "of no interest"});
  Websocket client(server.port());
  greet(client);
  client.send(kSubscribe);
  const Data first = data_of(client.next());
  EXPECT_EQ(first.subscription, 5U);
  EXPECT_EQ(first.time, 80U);
  EXPECT_EQ(first.text, "newest");
  server.append(view::SceneMessage{.channel = 0, .time = 120, .text = "map"});
  const Data second = data_of(client.next());
  EXPECT_EQ(second.subscription, 6U);
  EXPECT_EQ(second.text, "map");
}

TEST(FoxgloveClient, GetsAStatusForWhatIsNotUnderstood) {
  const RunningServer server;
  Websocket client(server.port());
  greet(client);
  client.send("nonsense");
  EXPECT_EQ(text_of(client.next()).value("op", ""), "status");
}

TEST(FoxgloveClient, IsClosedWhenTheRunHasEnded) {
  RunningServer server;
  Websocket client(server.port());
  greet(client);
  server.end();
  const auto frame = client.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->opcode, 8);
}

TEST(FoxgloveClient, ThatSendsTooMuchIsDropped) {
  const RunningServer server;
  Websocket client(server.port());
  greet(client);
  client.send(std::string(65'536, 'x'));
  EXPECT_EQ(text_of(client.next()).value("op", ""), "status");
  client.send(std::string(65'537, 'x'));
  const auto frame = client.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->opcode, 8);
  EXPECT_EQ(frame->payload.substr(0, 2), "\x03\xF1");  // 1009: too big
  EXPECT_TRUE(test::eventually(20s, [&] { return server.num_clients() == 0; }));
}

TEST(FoxgloveClient, ThatStopsReadingIsDropped) {
  RunningServer server(1s);
  Websocket stalled(server.port());
  greet(stalled);
  stalled.send(kSubscribe);
  ASSERT_TRUE(test::eventually(20s, [&] { return server.num_clients() == 1; }));
  const std::string text(1'000'000, 'x');
  EXPECT_TRUE(test::eventually(60s, [&] {
    server.append(view::SceneMessage{.channel = 1, .time = 1, .text = text});
    return server.num_clients() == 0;
  }));
}

TEST(FoxgloveClient, OfAPageOfAnotherSiteIsRefused) {
  const RunningServer server;
  const std::string subprotocol = Websocket::kSubprotocol;
  for (const char* origin : {"https://example.org", "null", "http://localhost.example.org"}) {
    const Websocket client(server.port(), subprotocol + "Origin: " + std::string(origin) + "\r\n");
    EXPECT_THAT(client.answer(), StartsWith("HTTP/1.1 403")) << origin;
  }
  for (const char* origin : {"https://app.foxglove.dev", "file://", "http://localhost:8080"}) {
    const Websocket client(server.port(), subprotocol + "Origin: " + std::string(origin) + "\r\n");
    EXPECT_THAT(client.answer(), StartsWith("HTTP/1.1 101")) << origin;
  }
  EXPECT_THAT(Websocket(server.port(), "").answer(), StartsWith("HTTP/1.1 400"));
}

}  // namespace
}  // namespace hlc::live
