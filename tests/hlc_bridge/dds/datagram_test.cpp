// Datagrams that no participant would send. Whoever reaches the network can send them.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/mutated_datagram.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/hlc_bridge/dds/sent_datagrams.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::dds::datagram_test {
namespace {

using coordination::Outcome;
using coordination::Traffic;

/// A participant that exchanges messages with the process.
struct Peer {
  Peer(const std::string& name, int domain)
      : participant{on_loopback(name, domain, DomainRole::kController)} {}

  [[nodiscard]] bool is_matched() {
    return outcomes.wait_for_matched({"peer"}, soon()) &&
           traffic.wait_for_matched({"peer"}, soon()) &&
           answers.reader().wait_for_matched({"peer"}, soon());
  }

  Participant participant;
  Writer<Outcome> outcomes{participant, topics::outcome()};
  Writer<Traffic> traffic{participant, topics::traffic()};
  Mailbox<Outcome> answers{participant, topics::outcome()};
};

/// A process on the domain, datagrams for it, and a participant to which it answers.
class Datagrams : public testing::Test {
 protected:
  Datagrams() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Datagrams() override { ::close(socket_); }

  /// Records what two participants send to the process, one of them until it ends.
  void SetUp() override {
    const SentDatagrams sent;
    for (auto* source : {&former_source_, &source_}) {
      source->emplace("source", domain_.first());
      ASSERT_TRUE((*source)->is_matched());
      std::mt19937_64 random(1);
      for (std::uint64_t step = 0; step < 5; ++step) {
        ASSERT_TRUE((*source)->traffic.write(sample<Traffic>(random)));
        ASSERT_TRUE((*source)->outcomes.write({.vehicle = {2}, .step = {step}}));
      }
      ASSERT_TRUE(answers_to(**source));
      former_source_.reset();
    }
    for (const Datagram& datagram : sent.so_far()) {
      recorded_.push_back(datagram.bytes);
      // Discovery comes to even ports, messages to the next ones. For discovery a participant sends
      // nothing to itself.
      const int port = ntohs(datagram.to.sin_port);
      const bool is_for_all = IN_MULTICAST(ntohl(datagram.to.sin_addr.s_addr));
      if (!is_for_all && port % 2 == 0) ports_ = {port, port + 1};
    }
    ASSERT_NE(ports_.front(), 0);
  }

  /// To the process alone.
  void send(const Bytes& datagram, int port) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::sendto(socket_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
  }

  /// The process answers a question of this participant, which is repeated until it does: the
  /// process may match it later than it matches the process. False at the deadline, and as soon as
  /// the process has ended.
  [[nodiscard]] bool answers_to(Peer& judge,
                                std::chrono::milliseconds time = std::chrono::seconds{60}) {
    const Outcome question{.vehicle = {1}, .step = {++last_question_}};
    const auto is_answered = [&] {
      return std::ranges::any_of(judge.answers.now(), [&](const Outcome& answer) {
        return answer.vehicle == question.vehicle && answer.step == question.step;
      });
    };
    return test::eventually(time,
                            [&] {
                              if (is_answered() || peer_.wait_for(std::chrono::milliseconds{0}))
                                return true;
                              EXPECT_TRUE(judge.outcomes.write(question));
                              return false;
                            }) &&
           is_answered();
  }

  /// How it ended, and what it printed.
  [[nodiscard]] std::string end_of_process() {
    const auto code = peer_.wait_for(std::chrono::milliseconds{0});
    return (code ? fmt::format("exit code {}\n", *code) : "still running\n") +
           test::read_text(folder_.path() / "log");
  }

  test::DomainReservation domain_;
  test::TemporaryFolder folder_;
  test::ChildProcess peer_{{HLC_TEST_PEER, "peer", std::to_string(domain_.first())},
                           folder_.path() / "log"};
  std::vector<Bytes> recorded_;
  std::array<int, 2> ports_{};
  std::optional<Peer> former_source_;
  std::optional<Peer> source_;

 private:
  std::uint64_t last_question_{1'000'000'000};
  int socket_;
};

struct Forged {
  std::string name;
  Bytes submessages;
};
void PrintTo(const Forged& one, std::ostream* out) { *out << one.name; }

class ForgedDatagrams : public Datagrams, public testing::WithParamInterface<Forged> {};

// 84 bytes ended every process on the domain, or 52 in the name of a writer stopped it from
// receiving at all.
TEST_P(ForgedDatagrams, DoNotEndTheProcessNorStopItFromReceiving) {
  const Bytes& of_source = recorded_.back();
  Bytes datagram(of_source.begin(), of_source.begin() + kHeaderBytes);
  const Bytes& submessages = GetParam().submessages;
  datagram.insert(datagram.end(), submessages.begin(), submessages.end());
  for (const int port : ports_) send(datagram, port);
  Peer judge{"judge", domain_.first()};
  ASSERT_TRUE(judge.is_matched());
  EXPECT_TRUE(answers_to(judge)) << end_of_process();
}

Bytes bytes_after_statistics() {
  Bytes bytes = statistics_submessage();
  bytes.resize(bytes.size() + 4);
  return bytes;
}

/// A heartbeat (0x07) or gap (0x08) for all readers, from the source's first writer, whose messages
/// from number `begin` to 2^62 are announced or gone.
Bytes up_to_large_number(unsigned char kind, const Bytes& begin, unsigned char count) {
  Bytes bytes{kind, 1, 28, 0, 0, 0, 0, 0, 0, 0, 1, 2};
  bytes.insert(bytes.end(), begin.begin(), begin.end());
  bytes.insert(bytes.end(), {0, 0, 0, 0x40, 0, 0, 0, 0});
  bytes.insert(bytes.end(), {0, count, 0, 0});
  return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    Datagrams, ForgedDatagrams,
    testing::Values(
        Forged{"BytesAfterStatistics", bytes_after_statistics()},
        Forged{"HeartbeatOfALargeNumber", up_to_large_number(0x07, {0, 0, 0, 0x40, 0, 0, 0, 0}, 9)},
        Forged{"GapUpToALargeNumber", up_to_large_number(0x08, {0, 0, 0, 0, 1, 0, 0, 0}, 0)}),
    [](const auto& one) { return one.param.name; });

// A changed message in the name of a writer may take the place of that writer's, so that the
// process no longer answers; but it runs, and ends as it should.
TEST_F(Datagrams, ThatAreMutatedDoNotEndTheProcess) {
  constexpr std::size_t kBatch = 20;
  const std::uint64_t batches = test::num_costly_seeds(200);
  Peer judge{"judge", domain_.first()};
  ASSERT_TRUE(judge.is_matched());
  std::size_t next = 0;
  std::string sent;
  bool is_answering = true;
  for (std::uint64_t seed = 0; seed < batches && is_answering; ++seed) {
    std::mt19937_64 random(seed);
    sent = fmt::format("seed {}", seed);
    for (std::size_t i = 0; i < kBatch; ++i, ++next) {
      const Bytes datagram = mutated(recorded_[next % recorded_.size()], recorded_, random);
      const int port = ports_[random() % 2];
      send(datagram, port);
      sent += fmt::format("\n{} {:02x}", port, fmt::join(datagram, ""));
    }
    is_answering = answers_to(judge, std::chrono::seconds{5});
    ASSERT_FALSE(peer_.wait_for(std::chrono::milliseconds{0})) << end_of_process() << sent;
  }
  peer_.send(SIGTERM);
  EXPECT_EQ(peer_.wait_for(std::chrono::seconds{60}), 0) << end_of_process() << sent;
}

}  // namespace
}  // namespace hlc::dds::datagram_test
