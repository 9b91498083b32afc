#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/mutated_datagram.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"
#include "tests/hlc_bridge/dds/send_datagram.hpp"
#include "tests/hlc_bridge/dds/sent_datagrams.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::dds::datagram_test {

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

  [[nodiscard]] bool write(const Outcome& outcome) {
    ++num_outcomes;
    return outcomes.write(outcome);
  }

  Participant participant;
  Writer<Outcome> outcomes{participant, topics::outcome()};
  Writer<Traffic> traffic{participant, topics::traffic()};
  Mailbox<Outcome> answers{participant, topics::outcome()};
  std::uint64_t num_outcomes{};  ///< written, and so the sequence number of the last
};

/// A reliable writer, as datagrams name it.
struct Address {
  Bytes header;  ///< of a datagram of its participant
  Bytes writer;  ///< its entity id
};

inline std::uint64_t number_at(const Bytes& datagram, std::size_t place) {
  std::array<std::uint32_t, 2> words{};  // the higher one first
  std::memcpy(words.data(), &datagram[place], sizeof words);
  return (std::uint64_t{words[0]} << 32U) + words[1];
}

/// Of the writer of which the datagram has a heartbeat that announces message `number` or a later
/// one. Not of the library's own writers, for discovery.
inline std::optional<Address> address_in(const Bytes& bytes, std::uint64_t number) {
  for (const std::size_t at : submessages(bytes)) {
    if (bytes[at] != 0x07 || at + 32 > bytes.size()) continue;
    const auto writer = bytes.begin() + static_cast<long>(at) + 8;
    const bool is_of_library = (writer[3] & 0xc0U) != 0;
    if (!is_of_library && number_at(bytes, at + 20) >= number)
      return Address{.header = Bytes(bytes.begin(), bytes.begin() + kHeaderBytes),
                     .writer = Bytes(writer, writer + 4)};
  }
  return std::nullopt;
}

/// A process on the domain, datagrams for it, and a participant to which it answers.
class Datagrams : public testing::Test {
 protected:
  static constexpr std::uint64_t kSteps = 5;

  Datagrams() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~Datagrams() override { ::close(socket_); }

  /// Records what two participants send to the process, one of them until it ends.
  void SetUp() override {
    const SentDatagrams sent;
    for (auto* source : {&former_source_, &source_}) {
      source->emplace("source", domain_.first());
      ASSERT_TRUE((*source)->is_matched());
      std::mt19937_64 random(1);
      for (std::uint64_t step = 0; step < kSteps; ++step) {
        ASSERT_TRUE((*source)->traffic.write(sample<Traffic>(random)));
        ASSERT_TRUE((*source)->write({.vehicle = {2}, .step = {step}}));
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
    ASSERT_TRUE(test::eventually(std::chrono::seconds{60}, [&] {
      find_writer(sent);
      return writer_.has_value() || !answers_to(*source_);
    }));
    ASSERT_TRUE(writer_) << end_of_process();
  }

  /// The source's writer of outcomes, by a heartbeat to the process: it has written more than the
  /// one of traffic. The source sends its messages to itself, too.
  void find_writer(const SentDatagrams& sent) {
    const Bytes& last = recorded_.back();
    for (const Datagram& datagram : sent.so_far()) {
      const bool is_of_source =
          std::equal(last.begin(), last.begin() + kHeaderBytes, datagram.bytes.begin());
      if (!is_of_source || ntohs(datagram.to.sin_port) != ports_.back()) continue;
      if (const auto found = address_in(datagram.bytes, kSteps + 1)) writer_ = found;
    }
  }

  /// To the process alone.
  void send(const Bytes& datagram, int port) const {
    send_datagram(socket_, datagram.data(), datagram.size(), port);
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
                              EXPECT_TRUE(judge.write(question));
                              return false;
                            }) &&
           is_answered();
  }

  /// The process answered this outcome, as the source knows.
  [[nodiscard]] bool was_answered(const Outcome& outcome) const {
    return std::ranges::any_of(source_->answers.now(), [&](const Outcome& answer) {
      return answer.vehicle == outcome.vehicle && answer.step == outcome.step;
    });
  }

  /// How it ended, and what it printed.
  [[nodiscard]] std::string end_of_process() {
    const auto code = peer_.wait_for(std::chrono::milliseconds{0});
    return (code ? fmt::format("exit code {}\n", *code) : "still running\n") +
           test::read_text(folder_.path() / "log");
  }

  test::DomainReservation domain_;
  test::TemporaryFolder folder_;
  test::ChildProcess peer_{{HLC_TEST_PEER, "peer", std::to_string(domain_.first()), "180"},
                           folder_.path() / "log"};
  std::vector<Bytes> recorded_;
  std::array<int, 2> ports_{};
  std::optional<Address> writer_;  ///< the source's
  std::optional<Peer> former_source_;
  std::optional<Peer> source_;

 private:
  std::uint64_t last_question_{1'000'000'000};
  int socket_;
};

}  // namespace hlc::dds::datagram_test
