#include "hlc_bridge/mcap/recorded_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <tuple>

#include "hlc_bridge/mcap/indexed_file.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::mcap::recorded_messages_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Topic, sequence, log time and payload.
using Messages = std::vector<std::tuple<std::string, std::uint32_t, Nanoseconds, std::string>>;

class RecordedMessages : public testing::Test {
 protected:
  Messages write(std::mt19937_64& random) const {
    Messages written;
    IndexedFile file(file_);
    Nanoseconds time = random() % 1000;
    const std::size_t count = random() % 400;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::string topic = "topic " + std::to_string(random() % 5);
      const std::uint16_t schema = file.add(Schema{.name = "type of " + topic});
      const std::uint16_t channel = file.add(Channel{.schema = schema, .topic = topic});
      const std::string payload(random() % 20'000, static_cast<char>(random()));
      file.add(Message{.channel = channel, .sequence = i, .log_time = time, .payload = payload});
      written.emplace_back(topic, i, time, payload);
      time += random() % 3;
    }
    file.finish();
    return written;
  }
  [[nodiscard]] Messages read() const {
    Messages messages;
    read_messages(file_, [&](const Channel& channel, const Message& message) {
      messages.emplace_back(channel.topic, message.sequence, message.log_time, message.payload);
    });
    return messages;
  }
  void expect_refused(const std::string& bytes, const std::string& why) const {
    write_file(file_, bytes);
    EXPECT_THAT([this] { static_cast<void>(read()); },
                ThrowsMessage<std::runtime_error>(HasSubstr("run.mcap: " + why)));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_{folder_ / "run.mcap"};
};

TEST_F(RecordedMessages, AreThoseThatWereWrittenInTheirOrder) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(20); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Messages written = write(random);
    EXPECT_TRUE(read() == written);
  }
}

TEST_F(RecordedMessages, OfAFileThatIsCutOffAreRefusedWithItsName) {
  std::mt19937_64 random(3);
  static_cast<void>(write(random));
  const std::string whole = read_file(file_);
  for (std::uint64_t i = 0; i < test::num_costly_seeds(100); ++i) {
    const std::size_t size = 8 + random() % (whole.size() / 2);
    SCOPED_TRACE(size);
    expect_refused(whole.substr(0, size), "cut off");
  }
}

TEST_F(RecordedMessages, OfForeignFilesAreRefusedWithTheirName) {
  expect_refused("", "no MCAP file");
  expect_refused("a text", "no MCAP file");
  std::string message_without_channel;
  append_message(message_without_channel, {.channel = 7, .payload = "x"});
  const auto chunk_of = [](const std::string& compression, const std::string& records) {
    std::string content;
    append(content, std::uint64_t{0});
    append(content, std::uint64_t{0});
    append(content, std::uint64_t{records.size()});
    append(content, std::uint32_t{0});
    append_text(content, compression);
    append(content, std::uint64_t{records.size()});
    std::string bytes(kMagic);
    append_record(bytes, Opcode::kChunk, content + records);
    append_end(bytes);
    return bytes;
  };
  expect_refused(chunk_of("", message_without_channel), "a message has no channel before it");
  expect_refused(chunk_of("lz4", message_without_channel), "a chunk is compressed or too short");
  expect_refused(chunk_of("", message_without_channel.substr(0, 20)),
                 "a record in a chunk is cut off");
}

TEST_F(RecordedMessages, OfAMissingFileAreRefusedWithItsName) {
  EXPECT_THAT([this] { static_cast<void>(read()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("run.mcap: ")));
}

}  // namespace
}  // namespace hlc::mcap::recorded_messages_test
