#include "hlc_bridge/live/answer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/view/page_files.hpp"

namespace hlc::live {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Answer answer_here(const std::string& target, const std::string& method = "GET",
                   const std::string& host = "127.0.0.1:8400") {
  return answer_to({.method = method, .target = target, .host = host}, Audience::kThisMachine);
}

TEST(Answer, ThePageMayConnectToItsServerOnly) {
  const Answer answer = answer_here("/");
  EXPECT_EQ(answer.status, 200U);
  EXPECT_THAT(answer.type, StartsWith("text/html"));
  EXPECT_THAT(answer.body, HasSubstr("default-src 'none'; connect-src 'self';"));
  EXPECT_THAT(answer.body, HasSubstr("src=\"live.js\""));
  EXPECT_THAT(answer.body, Not(HasSubstr("src=\"main.js\"")));
}

TEST(Answer, EveryFileThatThePageImportsIsThere) {
  for (const auto& [name, text] : view::page_files()) {
    if (name == "run.html") continue;
    EXPECT_EQ(answer_here("/" + name).body, text) << name;
    EXPECT_THAT(answer_here("/" + name).type,
                StartsWith(name.ends_with(".css") ? "text/css" : "text/javascript"))
        << name;
  }
}

TEST(Answer, TheEventsAreAStream) {
  EXPECT_TRUE(answer_here("/events").is_events);
  EXPECT_TRUE(answer_here("/events?again").is_events);
  EXPECT_EQ(answer_here("/events").type, "text/event-stream");
}

TEST(Answer, OtherTargetsAreNotFound) {
  for (const char* target :
       {"", "*", "main.js", "//main.js", "/run.html", "/../main.js", "/main.js/", "/etc/passwd",
        "/%2e%2e/main.js", "http://127.0.0.1/main.js", "/events/"}) {
    EXPECT_EQ(answer_here(target).status, 404U) << target;
  }
}

TEST(Answer, OtherMethodsAreRefused) {
  for (const char* method : {"POST", "HEAD", "PUT", "DELETE", "OPTIONS", "get", ""}) {
    EXPECT_EQ(answer_here("/", method).status, 405U) << method;
    EXPECT_FALSE(answer_here("/events", method).is_events) << method;
  }
}

TEST(Answer, OnlyNamesOfThisMachineAreHosts) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8400", "localhost", "localhost:1", "[::1]:80"}) {
    EXPECT_EQ(answer_here("/", "GET", host).status, 200U) << host;
  }
  for (const char* host : {"", "example.org", "localhost.example.org", "127.0.0.1.example.org:80",
                           "127.0.0.11", "10.0.0.1"}) {
    EXPECT_EQ(answer_here("/", "GET", host).status, 403U) << host;
    EXPECT_FALSE(answer_here("/events", "GET", host).is_events) << host;
  }
}

TEST(Answer, WhereAllMayAskAnyHostIsGood) {
  EXPECT_EQ(
      answer_to({.method = "GET", .target = "/", .host = "lab-pc:8400"}, Audience::kAll).status,
      200U);
}

}  // namespace
}  // namespace hlc::live
