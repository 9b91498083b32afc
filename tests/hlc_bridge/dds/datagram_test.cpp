// Datagrams that no participant would send. Whoever reaches the network can send them.
#include "tests/hlc_bridge/dds/datagrams.hpp"

#include "tests/support/num_seeds.hpp"

namespace hlc::dds::datagram_test {
namespace {

struct Forged {
  std::string name;
  /// Submessages of the datagrams, in the name of the entity id `writer`, whose next message has
  /// the number `next`.
  std::vector<Bytes> (*datagrams)(const Bytes& writer, std::uint64_t next);
  bool is_dropped{true};  ///< by us, as the process's log then shows
};
void PrintTo(const Forged& one, std::ostream* out) { *out << one.name; }

constexpr std::uint64_t kLarge = std::uint64_t{1} << 62U;
constexpr std::uint64_t kWithinBounds = (std::uint64_t{1} << 16U) - 300;

Bytes with_header(const Bytes& header, const Bytes& submessages) {
  Bytes datagram = header;
  datagram.insert(datagram.end(), submessages.begin(), submessages.end());
  return datagram;
}

class ForgedDatagrams : public Datagrams, public testing::WithParamInterface<Forged> {};

// 84 bytes ended every process on the domain, or 52 in the name of a writer stopped it from
// receiving at all.
TEST_P(ForgedDatagrams, DoNotEndTheProcessNorStopItFromReceiving) {
  for (const Bytes& submessages :
       GetParam().datagrams(writer_->writer, source_->num_outcomes + 1)) {
    const Bytes datagram = with_header(writer_->header, submessages);
    for (const int port : ports_) send(datagram, port);
  }
  Peer judge{"judge", domain_.first()};
  ASSERT_TRUE(judge.is_matched());
  EXPECT_TRUE(answers_to(judge)) << end_of_process();
  const auto is_logged = [&] { return end_of_process().find("Dropped what") != std::string::npos; };
  if (GetParam().is_dropped) {
    EXPECT_TRUE(test::eventually(std::chrono::seconds{60}, is_logged)) << end_of_process();
  } else {
    EXPECT_FALSE(is_logged()) << end_of_process();
  }
}

void append(Bytes& bytes, std::uint64_t number, std::size_t words) {
  if (words == 2) append(bytes, number >> 32U, 1);
  for (std::size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<unsigned char>(number >> 8 * i));
}

/// A heartbeat (0x07) or gap (0x08) for all readers: messages `begin` to `end` are there, or all
/// from `begin` before `end` are gone.
Bytes heartbeat_or_gap(unsigned char kind, const Bytes& writer, std::uint64_t begin,
                       std::uint64_t end, unsigned char count = 0) {
  Bytes bytes{kind, 1, 28, 0, 0, 0, 0, 0};
  bytes.insert(bytes.end(), writer.begin(), writer.end());
  append(bytes, begin, 2);
  append(bytes, end, 2);
  // A heartbeat's count, larger than those before; the bits that follow in a gap: none.
  bytes.insert(bytes.end(), {0, 0, 0, count});
  return bytes;
}

/// DATA (0x15), or the only fragment of one (0x16), for all readers: nothing a reader could read.
Bytes data(unsigned char kind, const Bytes& writer, std::uint64_t number) {
  const bool is_fragment = kind == 0x16;
  const auto flags = static_cast<unsigned char>(is_fragment ? 1 : 5);
  const auto size = static_cast<unsigned char>(is_fragment ? 40 : 28);
  Bytes bytes{kind, flags, size, 0, 0, 0, static_cast<unsigned char>(is_fragment ? 28 : 16), 0};
  bytes.resize(8);
  bytes.insert(bytes.end(), {0, 0, 0, 0});
  bytes.insert(bytes.end(), writer.begin(), writer.end());
  append(bytes, number, 2);
  if (is_fragment) {
    append(bytes, 1, 1);                      // the first fragment
    bytes.insert(bytes.end(), {1, 0, 8, 0});  // one, of at most 8 bytes
    append(bytes, 8, 1);                      // bytes of the message
  }
  bytes.insert(bytes.end(), {0, 1, 0, 0, 0, 0, 0, 0});
  return bytes;
}

/// The same without any room for a message: `skipped` bytes before it are more than the submessage
/// has, so that its length is below 0.
Bytes data_of_negative_length(unsigned char kind, const Bytes& writer, std::uint64_t number) {
  constexpr unsigned char kSkipped = 40;
  const bool is_fragment = kind == 0x16;
  Bytes bytes = data(kind, writer, number);
  bytes[2] = is_fragment ? 36 : 24;  // length of the submessage
  bytes[6] = static_cast<unsigned char>(bytes[6] + kSkipped);
  bytes.resize(bytes.size() + kSkipped);
  return bytes;
}

/// The only fragment of a message of 30 000 bytes, of which it has 8.
std::vector<Bytes> short_fragment(const Bytes& writer, std::uint64_t next) {
  Bytes bytes = data(0x16, writer, next);
  constexpr std::size_t kSizeOfFragment = 30;
  for (const std::size_t at : {kSizeOfFragment, kSizeOfFragment + 2}) {
    bytes[at] = 30'000 & 0xff;
    bytes[at + 1] = 30'000 >> 8;
  }
  return {bytes};
}

/// A hundred heartbeats or gaps, each up to `step` more messages than the one before. Gaps from
/// message `begin`, or, if that is 0, each from the end of the one before.
std::vector<Bytes> hundred(unsigned char kind, const Bytes& writer, std::uint64_t next,
                           std::uint64_t step, std::uint64_t begin = 0) {
  std::vector<Bytes> all;
  for (unsigned char i = 1; i <= 100; ++i) {
    const std::uint64_t end = next + i * step;
    const std::uint64_t begin_of_gap = begin == 0 ? end - step : begin;
    all.push_back(kind == 0x08 ? heartbeat_or_gap(kind, writer, begin_of_gap, end)
                               : heartbeat_or_gap(kind, writer, end, end, i));
  }
  return all;
}

std::vector<Bytes> bytes_after_statistics(const Bytes& /*writer*/, std::uint64_t /*next*/) {
  Bytes bytes = statistics_submessage();
  bytes.resize(bytes.size() + 4);
  return {bytes};
}

using Number = std::uint64_t;
INSTANTIATE_TEST_SUITE_P(
    Datagrams, ForgedDatagrams,
    testing::Values(
        Forged{"BytesAfterStatistics", bytes_after_statistics, false},
        Forged{"HeartbeatOfALargeNumber",
               [](const Bytes& writer, Number /*next*/) {
                 return std::vector<Bytes>{heartbeat_or_gap(0x07, writer, kLarge, kLarge, 9)};
               }},
        Forged{"GapUpToALargeNumber",
               [](const Bytes& writer, Number /*next*/) {
                 return std::vector<Bytes>{heartbeat_or_gap(0x08, writer, 1, kLarge)};
               }},
        // As a late joiner receives one that is not forged at all.
        Forged{"HeartbeatOfALongHistory",
               [](const Bytes& writer, Number next) {
                 return std::vector<Bytes>{heartbeat_or_gap(0x07, writer, 1, next + 300'000, 9)};
               },
               false},
        Forged{
            "DataOfALargeNumber",
            [](const Bytes& writer, Number /*next*/) {
              return std::vector<Bytes>{data(0x15, writer, kLarge), data(0x15, writer, kLarge + 5)};
            }},
        Forged{
            "FragmentOfALargeNumber",
            [](const Bytes& writer, Number /*next*/) {
              return std::vector<Bytes>{data(0x16, writer, kLarge), data(0x16, writer, kLarge + 5)};
            }},
        Forged{"DataOfNegativeLength",
               [](const Bytes& writer, Number next) {
                 return std::vector<Bytes>{data_of_negative_length(0x15, writer, next)};
               }},
        Forged{"FragmentOfNegativeLength",
               [](const Bytes& writer, Number next) {
                 return std::vector<Bytes>{data_of_negative_length(0x16, writer, next)};
               }},
        Forged{"FragmentShorterThanItsSize", short_fragment},
        // To the readers for discovery, which do not match their writers.
        Forged{"DiscoveryOfNegativeLength",
               [](const Bytes& /*writer*/, Number next) {
                 const Bytes discovery{0, 1, 0, 0xc2};
                 return std::vector<Bytes>{data_of_negative_length(0x15, discovery, next),
                                           data_of_negative_length(0x16, discovery, next)};
               }},
        Forged{"HundredHeartbeatsEachFarAboveTheLast",
               [](const Bytes& writer, Number next) {
                 return hundred(0x07, writer, next, (Number{1} << 24U) - 300);
               }},
        Forged{"HundredGapsEachFarAboveTheLast",
               [](const Bytes& writer, Number next) {
                 return hundred(0x08, writer, next, (Number{1} << 24U) - 300, 1);
               }},
        Forged{"HundredHeartbeatsWithinTheBounds",
               [](const Bytes& writer, Number next) {
                 return hundred(0x07, writer, next, kWithinBounds);
               },
               false},
        Forged{"HundredGapsFromTheFirstMessageWithinTheBoundOfEach",
               [](const Bytes& writer, Number next) {
                 return hundred(0x08, writer, next, kWithinBounds, 1);
               }},
        Forged{"HundredGapsWithinTheBounds",
               [](const Bytes& writer, Number next) {
                 return hundred(0x08, writer, next, kWithinBounds);
               },
               false}),
    [](const auto& one) { return one.param.name; });

// Otherwise the process might ignore those above for their addresses.
TEST_F(Datagrams, InTheNameOfAWriterReachItsReader) {
  const std::uint64_t next = source_->num_outcomes + 1;
  const Outcome skipped{.vehicle = {3}, .step = {next}};
  send(with_header(writer_->header, heartbeat_or_gap(0x08, writer_->writer, next, next + 1)),
       ports_.back());
  ASSERT_TRUE(source_->write(skipped));
  ASSERT_TRUE(answers_to(*source_)) << end_of_process();
  // Reliable in both directions: the answer would have come first.
  EXPECT_FALSE(was_answered(skipped));
}

// Before anything of a writer was received, it may have a long past: a reader that joins late skips
// that.
TEST_F(Datagrams, OfAWriterWithALongPastAreAccepted) {
  constexpr std::uint64_t kPast = 1'000'000;
  const auto is_other = [&](const Datagram& one) {
    return !std::equal(writer_->header.begin(), writer_->header.end(), one.bytes.begin());
  };
  // The process may match a fresh writer only after the heartbeat: then the next one.
  Outcome first{.vehicle = {4}, .step = {0}};
  const auto is_first_skipped = [&] {
    const SentDatagrams sent;
    Peer fresh{"fresh", domain_.first()};
    if (!fresh.is_matched()) return false;
    const auto datagrams = sent.so_far();
    const auto of_fresh = std::find_if(datagrams.rbegin(), datagrams.rend(), is_other);
    if (of_fresh == datagrams.rend()) return false;
    const Bytes header(of_fresh->bytes.begin(), of_fresh->bytes.begin() + kHeaderBytes);
    // Every peer's writers have the same entity ids.
    send(with_header(header, heartbeat_or_gap(0x07, writer_->writer, kPast, kPast, 9)),
         ports_.back());
    first.step = {first.step.value + 1};
    return fresh.write(first) && answers_to(*source_) && !was_answered(first);
  };
  EXPECT_TRUE(test::eventually(std::chrono::seconds{60}, is_first_skipped)) << end_of_process();
  EXPECT_EQ(end_of_process().find("Dropped what"), std::string::npos) << end_of_process();
}

// A changed message in the name of a writer may take the place of that writer's, so that the
// process no longer answers it; but it answers another, runs, and ends as it should.
class MutatedDatagrams : public Datagrams {
 protected:
  static constexpr std::size_t kBatch = 20;

  /// What was sent, for a failure.
  std::string send_batch(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::string sent = fmt::format("seed {}", seed);
    for (std::size_t i = 0; i < kBatch; ++i, ++next_) {
      const Bytes datagram = mutated(recorded_[next_ % recorded_.size()], recorded_, random);
      const int port = ports_[random() % 2];
      send(datagram, port);
      sent += fmt::format("\n{} {:02x}", port, fmt::join(datagram, ""));
    }
    return sent;
  }

  /// The process has dealt with what was sent if it answers afterwards, this participant or a fresh
  /// one.
  [[nodiscard]] bool answers() {
    constexpr std::chrono::seconds kTime{5};
    if (judge_ && answers_to(*judge_, kTime)) return true;
    judge_.emplace("judge", domain_.first());
    if (answers_to(*judge_, kTime)) return true;
    judge_.reset();
    return false;
  }

 private:
  std::optional<Peer> judge_;
  std::size_t next_{};
};

TEST_F(MutatedDatagrams, DoNotEndTheProcess) {
  const std::uint64_t batches = test::num_costly_seeds(200);
  std::uint64_t num_sent = 0;
  std::uint64_t num_unanswered = 0;
  for (std::uint64_t seed = 0; seed < batches; ++seed, ++num_sent) {
    const std::string sent = send_batch(seed);
    if (!answers()) {
      ++num_unanswered;
      fmt::print("no answer, not even to a fresh peer, after seed {}\n", seed);
    }
    ASSERT_FALSE(peer_.wait_for(std::chrono::milliseconds{0})) << end_of_process() << sent;
  }
  EXPECT_EQ(num_sent, batches);
  RecordProperty("unanswered", std::to_string(num_unanswered));
  peer_.send(SIGTERM);
  EXPECT_EQ(peer_.wait_for(std::chrono::seconds{60}), 0) << end_of_process();
}

}  // namespace
}  // namespace hlc::dds::datagram_test
