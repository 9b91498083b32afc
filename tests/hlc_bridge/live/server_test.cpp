#include "hlc_bridge/live/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <list>
#include <optional>
#include <stdexcept>

#include "tests/hlc_bridge/live/running_server.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/http_client.hpp"

namespace hlc::live {
namespace {

using test::HttpClient;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

constexpr const char* kEnd = "\ndata: [\"end\"]\n\n";

std::string answer_of(const RunningServer& server, const std::string& request) {
  HttpClient client(server.port());
  client.send(request);
  return client.read_all();
}

bool is_alive(const RunningServer& server) {
  HttpClient client(server.port());
  client.get("/");
  return client.read_all().ends_with("</html>\n");
}

TEST(Server, ServesThePage) {
  const RunningServer server;
  HttpClient client(server.port());
  client.get("/");
  const std::string head = client.read_until("\r\n\r\n");
  const std::string page = client.read_all();
  EXPECT_THAT(head, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(head, HasSubstr("Content-Length: " + std::to_string(page.size()) + "\r\n"));
  EXPECT_THAT(page, EndsWith("</html>\n"));
}

TEST(Server, AClientThatComesLateGetsEverythingAndThenWhatFollows) {
  RunningServer server;
  server.append("[1]");
  server.append("[2]");
  ASSERT_TRUE(test::eventually(20s, [&] { return server.num_events() == 2; }));
  HttpClient client(server.port());
  client.get("/events");
  EXPECT_THAT(client.read_until("[2]\n\n"),
              EndsWith("\r\n\r\nid: 1-0\ndata: [1]\n\nid: 1-1\ndata: [2]\n\n"));
  server.append("[3]");
  EXPECT_EQ(client.read_until("[3]\n\n"), "id: 1-2\ndata: [3]\n\n");
}

TEST(Server, AClientThatComesAgainGetsWhatItHasNotHad) {
  RunningServer server;
  for (int i = 0; i < 5; ++i) server.append("[" + std::to_string(i) + "]");
  ASSERT_TRUE(test::eventually(20s, [&] { return server.num_events() == 5; }));
  HttpClient client(server.port());
  client.get("/events", "Last-Event-ID: 1-2\r\n");
  EXPECT_THAT(client.read_until("[4]\n\n"),
              EndsWith("\r\n\r\nid: 1-3\ndata: [3]\n\nid: 1-4\ndata: [4]\n\n"));
}

TEST(Server, TheEndOfTheHistoryIsThatOfItsClientsAndOfTheServer) {
  std::optional<RunningServer> server(std::in_place);
  HttpClient client(server->port());
  client.get("/events");
  static_cast<void>(client.read_until("\r\n\r\n"));
  server->append("[\"end\"]");
  server->end();
  EXPECT_THAT(client.read_all(), EndsWith(kEnd));
  server.reset();  // although the client keeps its side open
}

TEST(Server, AHundredClientsGetTheSame) {
  RunningServer server;
  std::list<HttpClient> clients;
  for (int i = 0; i < 100; ++i) clients.emplace_back(server.port()).get("/events");
  for (int i = 0; i < 50; ++i) server.append("[\"" + std::string(1000, 'x') + "\"]");
  server.append("[\"end\"]");
  const std::string first = clients.front().read_until(kEnd);
  EXPECT_GT(first.size(), 50'000U);
  clients.pop_front();
  for (HttpClient& client : clients) EXPECT_EQ(client.read_until(kEnd), first);
}

TEST(Server, MoreClientsThanAllowedAreRefusedAndTheOthersStay) {
  RunningServer server;
  std::list<HttpClient> clients;
  for (std::size_t i = 0; i < kMostClients; ++i) {
    clients.emplace_back(server.port()).get("/events");
    static_cast<void>(clients.back().read_until("\r\n\r\n"));
  }
  HttpClient refused(server.port());
  refused.get("/events");
  EXPECT_EQ(refused.read_all(), "");
  server.append("[\"end\"]");
  for (HttpClient& client : clients) EXPECT_THAT(client.read_until(kEnd), EndsWith(kEnd));
}

TEST(Server, AClientThatStopsReadingIsDroppedAndTheOthersGoOn) {
  RunningServer server(1s);
  HttpClient stalled(server.port());
  stalled.get("/events");
  for (int i = 0; i < 60; ++i) server.append("[\"" + std::string(1'000'000, 'x') + "\"]");
  server.append("[\"end\"]");
  HttpClient reading(server.port());
  reading.get("/events");
  EXPECT_GT(reading.read_until(kEnd).size(), 60'000'000U);
  EXPECT_TRUE(test::eventually(20s, [&] { return server.num_clients() == 1; }));
  const std::string rest = stalled.read_all();
  EXPECT_LT(rest.size(), 60'000'000U);
}

TEST(Server, AClientThatHasGoneIsNoticedAlthoughNothingHappens) {
  const RunningServer server(50ms);
  {
    HttpClient client(server.port());
    client.get("/events");
    static_cast<void>(client.read_until("\r\n\r\n"));
    EXPECT_EQ(client.read_until(":\n\n"), ":\n\n");
  }
  EXPECT_TRUE(test::eventually(20s, [&] { return server.num_clients() == 0; }));
}

TEST(Server, AClientThatSendsNoWholeRequestIsDropped) {
  const RunningServer server(50ms);
  HttpClient client(server.port());
  client.send("GET / HTTP/1.1\r\nHost: loc");
  EXPECT_EQ(client.read_all(), "");
  EXPECT_TRUE(is_alive(server));
}

TEST(Server, WhatIsNoRequestIsAnswered) {
  const RunningServer server;
  for (const std::string& request :
       {std::string("\r\n\r\n\r\n"), std::string("nonsense\r\n\r\n"), std::string(2000, '\0'),
        std::string("GET /\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\nno field\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"),
        std::string("\x16\x03\x01\x02\x03\xfc\x03\x03")}) {
    EXPECT_THAT(answer_of(server, request + "\r\n\r\n"), StartsWith("HTTP/1.1 400")) << request;
  }
  EXPECT_TRUE(is_alive(server));
}

TEST(Server, AHeaderOrABodyThatIsTooLongIsRefused) {
  const RunningServer server;
  std::string ten_megabytes;
  ten_megabytes.resize(10'000'000, 'x');
  EXPECT_THAT(answer_of(server, "GET / HTTP/1.1\r\nHost: localhost\r\nX: " + ten_megabytes),
              StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(answer_of(server,
                        "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10000000"
                        "\r\n\r\n" +
                            ten_megabytes),
              StartsWith("HTTP/1.1 413"));
  EXPECT_TRUE(is_alive(server));
}

TEST(Server, OtherHostsAndMethodsAreRefused) {
  const RunningServer server;
  EXPECT_THAT(answer_of(server, "GET / HTTP/1.1\r\nHost: example.org\r\n\r\n"),
              StartsWith("HTTP/1.1 403 Forbidden"));
  EXPECT_THAT(answer_of(server, "POST / HTTP/1.1\r\nHost: localhost\r\n\r\n"),
              testing::AllOf(StartsWith("HTTP/1.1 405"), HasSubstr("\r\nAllow: GET\r\n")));
}

TEST(Server, APortThatIsTakenIsNamed) {
  const History history("1");
  const NewestMessages newest("1");
  const Server first({.port = 0}, history, newest);
  try {
    const Server second({.port = first.port()}, history, newest);
    FAIL() << "two servers on one port";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "--port = " + std::to_string(first.port()) + " is taken, must be free");
  }
}

TEST(Server, WithoutAPortTheNextFreeOneIsTaken) {
  const History history("1");
  const NewestMessages newest("1");
  const Server first({}, history, newest);
  const Server second({}, history, newest);
  EXPECT_GE(first.port(), kFirstPort);
  EXPECT_GT(second.port(), first.port());
  EXPECT_EQ(second.url(), "http://127.0.0.1:" + std::to_string(second.port()) + "/");
}

TEST(Server, AnAddressThatIsNotThisMachinesIsNamed) {
  const History history("1");
  const NewestMessages newest("1");
  for (const char* address : {"here", "", "192.0.2.1"}) {
    try {
      const Server server({.address = address, .port = 0}, history, newest);
      FAIL() << address;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), StartsWith(std::string("--listen = ") + address));
    }
  }
}

TEST(Server, OnlyAnAddressBeyondLoopbackIsOpenToOthers) {
  const History history("1");
  const NewestMessages newest("1");
  EXPECT_FALSE(Server({.port = 0}, history, newest).is_open_to_others());
  EXPECT_TRUE(Server({.address = "0.0.0.0", .port = 0}, history, newest).is_open_to_others());
}

}  // namespace
}  // namespace hlc::live
