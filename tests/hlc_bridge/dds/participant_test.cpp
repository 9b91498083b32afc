#include "hlc_bridge/dds/participant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

extern char** environ;

namespace hlc::dds::participant_test {
namespace {

using Names = std::set<std::string>;

/// The process peer.cpp.
class Peer {
 public:
  Peer(const std::string& name, int domain) {
    const std::string number = std::to_string(domain);
    std::string program = HLC_TEST_PEER;
    std::string first = name;
    std::string second = number;
    const std::array<char*, 4> arguments{program.data(), first.data(), second.data(), nullptr};
    if (posix_spawn(&pid_, HLC_TEST_PEER, nullptr, nullptr, arguments.data(), environ) != 0) {
      throw std::runtime_error("cannot start " + program);
    }
  }
  ~Peer() {
    if (pid_ != 0) {
      end(SIGKILL);
    }
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Ends it with this signal; its exit code, nothing if a signal killed it (SIGKILL, if it does
  /// not follow).
  std::optional<int> end(int signal_number) {
    int status = 0;
    kill(pid_, signal_number);
    const auto deadline = soon();
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) kill(pid_, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    pid_ = 0;
    return WIFEXITED(status) ? std::optional{WEXITSTATUS(status)} : std::nullopt;
  }

 private:
  pid_t pid_{};
};

/// A participant whose changes of presence wake the test.
class Watcher {
 public:
  explicit Watcher(int domain)
      : participant_{on_loopback("watcher", domain, DomainRole::kController),
                     [this] { signal_.post([this] { ++changes_; }); }} {}

  template <class Condition>
  bool wait(Condition condition) {
    return signal_.wait_until(soon(), [&] { return condition(participant_); });
  }
  Participant& participant() { return participant_; }
  /// The change of state is visible before its notification: waits for the notification.
  bool wait_for_changes(int at_least) {
    return signal_.wait_until(soon(), [&] { return changes_ >= at_least; });
  }

 private:
  time::Signal signal_;
  int changes_{};
  Participant participant_;
};

TEST(Participant, SeesOthersAppearAndLeave) {
  const test::DomainReservation domain;
  Watcher watcher{domain.first()};
  EXPECT_EQ(watcher.participant().alive(), Names{});
  {
    Participant red{on_loopback("red", domain.first(), DomainRole::kController)};
    Participant blue{on_loopback("blue", domain.first(), DomainRole::kController)};
    ASSERT_TRUE(watcher.participant().wait_for({"red", "blue"}, soon()));
    ASSERT_TRUE(red.wait_for({"watcher", "blue"}, soon()));
    EXPECT_EQ(watcher.participant().lost(), Names{});
    EXPECT_FALSE(red.is_alive("red")) << "a participant does not see itself";
  }
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.lost().size() == 2; }));
  EXPECT_EQ(watcher.participant().lost(), (Names{"red", "blue"}));
  EXPECT_EQ(watcher.participant().alive(), Names{});
  Participant again{on_loopback("red", domain.first(), DomainRole::kController)};
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_alive("red"); }));
  EXPECT_FALSE(watcher.participant().is_lost("red"));
  EXPECT_TRUE(watcher.wait_for_changes(5)) << "three participants came, two left";
}

TEST(Participant, SaysItsVersionToOthers) {
  const test::DomainReservation domains{1};
  const Participant observer{on_loopback("observer", domains.first(), DomainRole::kLab)};
  ParticipantOptions options = on_loopback("red", domains.first(), DomainRole::kLab);
  options.version = "revision 1";
  const Participant red{options};
  const Participant blue{on_loopback("blue", domains.first(), DomainRole::kLab)};
  ASSERT_TRUE(observer.wait_for({"red", "blue"}, soon()));
  EXPECT_EQ(observer.versions(), (std::map<std::string, std::string>{{"red", "revision 1"}}));
}

TEST(Participant, WaitForEndsAtTheDeadline) {
  const test::DomainReservation domain;
  Participant here{on_loopback("here", domain.first(), DomainRole::kController)};
  const Participant present{on_loopback("present", domain.first(), DomainRole::kController)};
  EXPECT_TRUE(here.wait_for({"present"}, soon()));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds{50};
  EXPECT_FALSE(here.wait_for({"present", "absent"}, deadline));
  EXPECT_GE(std::chrono::steady_clock::now(), deadline);
}

TEST(Participant, SeesNobodyOfAnotherDomain) {
  const test::DomainReservation domains{2};
  Participant here{on_loopback("here", domains.first(), DomainRole::kController)};
  Participant there{on_loopback("there", domains.first() + 1, DomainRole::kController)};
  Participant friend_of_here{on_loopback("friend", domains.first(), DomainRole::kController)};
  ASSERT_TRUE(here.wait_for({"friend"}, soon()));
  EXPECT_FALSE(here.is_alive("there"));
}

TEST(Participant, AProcessThatEndsCleanlyIsLostAtOnce) {
  const test::DomainReservation domain;
  Watcher watcher{domain.first()};
  Peer peer{"peer", domain.first()};
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_alive("peer"); }));
  EXPECT_EQ(peer.end(SIGTERM), 0);
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_lost("peer"); }));
}

TEST(Participant, AProcessThatIsKilledIsLostAfterItsLease) {
  const test::DomainReservation domain;
  Watcher watcher{domain.first()};
  Mailbox<coordination::Outcome> mailbox{watcher.participant(), topics::outcome()};
  // The library keeps what it knew of one that has left for the next one that comes.
  Peer former{"former", domain.first()};
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_alive("former"); }));
  EXPECT_EQ(former.end(SIGTERM), 0);
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_lost("former"); }));
  Peer peer{"peer", domain.first()};
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_alive("peer"); }));
  ASSERT_TRUE(mailbox.reader().wait_for_matched({"peer"}, soon()));
  EXPECT_EQ(peer.end(SIGKILL), std::nullopt);
  ASSERT_TRUE(watcher.wait([](const Participant& p) { return p.is_lost("peer"); }));
  ASSERT_TRUE(mailbox.wait_until([&] { return mailbox.reader().matched() == 0; }));
}

TEST(Participant, EndpointsMayOutliveIt) {
  const test::DomainReservation domain;
  auto participant = std::make_unique<Participant>(
      on_loopback("short-lived", domain.first(), DomainRole::kController));
  Writer<coordination::Outcome> writer{*participant, topics::outcome()};
  Mailbox<coordination::Outcome> mailbox{*participant, topics::outcome()};
  participant.reset();
  EXPECT_TRUE(
      writer.write(coordination::Outcome{.vehicle = {1}, .step = {0}, .wants_fallback = false}));
}

TEST(Participant, EndsUnderFullTraffic) {
  const test::DomainReservation domain;
  Participant sender{on_loopback("sender", domain.first(), DomainRole::kController)};
  Writer<coordination::Outcome> writer{sender, topics::outcome()};
  std::atomic<bool> done{false};
  std::thread traffic{[&] {
    for (std::uint64_t step = 0; !done; ++step) {
      writer.write(coordination::Outcome{.vehicle = {1}, .step = {step}, .wants_fallback = false});
    }
  }};
  for (int i = 0; i < 10; ++i) {
    Participant receiver{on_loopback("receiver", domain.first(), DomainRole::kController)};
    Mailbox<coordination::Outcome> mailbox{receiver, topics::outcome()};
    EXPECT_FALSE(mailbox.wait_for(1).empty());
  }
  done = true;
  traffic.join();
}

TEST(Participant, BadOptionsAreRefusedAndTheProcessGoesOn) {
  for (const int domain : {-1, 233, 1000}) {
    EXPECT_THROW(Participant{on_loopback("red", domain, DomainRole::kLab)}, std::invalid_argument);
  }
  EXPECT_THROW(Participant{on_loopback("", 1, DomainRole::kLab)}, std::invalid_argument);
  ParticipantOptions options = on_loopback("red", 1, DomainRole::kLocal);
  options.discovery_server = DiscoveryServer{"44.53.00.5f.45.50.52.4f.53.49.4d.41", "127.0.0.1", 1};
  EXPECT_THROW(Participant{options}, std::invalid_argument);
}

TEST(Participant, WithoutFreeFileDescriptorsIsRefusedWithTheReason) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const test::DomainReservation domain(1);
  std::string reason;
  const rlimit few{20, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &few);
  try {
    const Participant participant{on_loopback("blue", domain.first(), DomainRole::kLab)};
  } catch (const std::exception& error) {
    reason = error.what();
  }
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_THAT(reason, testing::HasSubstr("free file descriptors must be >= 20, got "));
  EXPECT_THAT(reason, testing::HasSubstr("(ulimit -n 20)"));
}

TEST(Endpoints, OfATopicOnTheWrongDomainAreRefused) {
  const test::DomainReservation domain;
  Participant participant{on_loopback("red", domain.first(), DomainRole::kLab)};
  EXPECT_THROW((Writer<coordination::Outcome>{participant, topics::outcome()}),
               std::invalid_argument);
  EXPECT_THROW((Reader<coordination::Outcome>{participant, topics::outcome(),
                                              [](const coordination::Outcome&) {}}),
               std::invalid_argument);
}

TEST(Endpoints, TellOfMatchesOnBothSides) {
  const test::DomainReservation domain;
  Participant red{on_loopback("red", domain.first(), DomainRole::kController)};
  time::Signal signal;
  Writer<coordination::Outcome> writer{red, topics::outcome(), [&] { signal.notify(); }};
  EXPECT_EQ(writer.matched(), 0U);
  EXPECT_FALSE(writer.wait_for_matched(1, std::chrono::steady_clock::now()));
  {
    Participant blue{on_loopback("blue", domain.first(), DomainRole::kController)};
    Participant green{on_loopback("green", domain.first(), DomainRole::kController)};
    Mailbox<coordination::Outcome> at_blue{blue, topics::outcome()};
    Mailbox<coordination::Outcome> at_green{green, topics::outcome()};
    ASSERT_TRUE(signal.wait_until(soon(), [&] {
      return writer.matched_names() == Names{"blue", "green"};
    }));
    EXPECT_EQ(writer.matched(), 2U);
    ASSERT_TRUE(at_blue.reader().wait_for_matched({"red"}, soon()));
    EXPECT_EQ(at_blue.reader().matched(), 1U);
  }
  ASSERT_TRUE(signal.wait_until(soon(), [&] { return writer.matched() == 0; }));
  EXPECT_EQ(writer.matched_names(), Names{});
}

}  // namespace
}  // namespace hlc::dds::participant_test
