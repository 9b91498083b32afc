#include "hlc_bridge/mcap/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <tuple>

#include "hlc_bridge/mcap/message_recorder.hpp"
#include "planner/common/text_file.hpp"
#include "tests/hlc_bridge/mcap/mcap_reader.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::mcap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<JsonChannel> nothing(std::optional<Nanoseconds> /*recorded_from*/) { return {}; }

/// The part of a process that published `count` messages on three topics.
std::filesystem::path record_part(const std::filesystem::path& folder, const std::string& process,
                                  std::size_t count, std::mt19937_64& random) {
  Nanoseconds wall = random() % 100;
  MessageRecorder recorder({.folder = folder,
                            .process = process,
                            .definition_of = [](const std::string& type) { return "of " + type; },
                            .wall_time = [&wall] { return wall; }});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string n = std::to_string(random() % 3);
    const std::string payload(random() % 50, 'x');
    wall += random() % 3;
    recorder.record({.topic = "topic " + n, .type = "T" + n, .cdr = payload, .run = random() % 20});
  }
  EXPECT_TRUE(recorder.close());
  return recorder.file();
}

/// A part whose process was killed while it wrote ends anywhere.
TEST(Merge, HasEveryWholeMessageOfEveryPartByTimeAlsoOfPartsThatAreCutOff) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(100); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const test::TemporaryFolder folder;
    std::vector<std::filesystem::path> parts;
    std::vector<std::filesystem::path> cut_off;
    std::vector<test::McapMessage> expected;
    for (const char* process : {"a", "b", "c"}) {
      parts.push_back(record_part(folder / "messages", process, random() % 40, random));
      const std::string bytes = read_file(parts.back());
      if (random() % 2 == 0) {
        std::filesystem::resize_file(parts.back(), 8 + random() % (bytes.size() - 8));
        cut_off.push_back(parts.back());
      }
      const auto of_part = test::read_from_begin(parts.back());
      expected.insert(expected.end(), of_part.begin(), of_part.end());
    }
    std::ranges::stable_sort(expected, {}, [](const test::McapMessage& message) {
      return std::tuple(message.log_time, message.publish_time);
    });
    const Merged merged = merge(parts, nothing, folder / "run.mcap");
    EXPECT_EQ(merged.num_messages, expected.size());
    EXPECT_EQ(merged.cut_off, cut_off);
    EXPECT_TRUE(test::read_by_index(folder / "run.mcap") == expected);
  }
}

TEST(Merge, AddsOtherMessagesByTheirTime) {
  std::mt19937_64 random(1);
  const test::TemporaryFolder folder;
  const std::filesystem::path part = record_part(folder.path(), "a", 40, random);
  const JsonChannel scene{.topic = "scene", .type = "S", .messages = {{0, "{}"}, {10, "[]"}}};
  std::optional<Nanoseconds> begin;
  const auto scene_from = [&](std::optional<Nanoseconds> recorded_from) {
    begin = recorded_from;
    return std::vector{scene};
  };
  EXPECT_EQ(merge({part}, scene_from, folder / "run.mcap").num_messages, 42U);
  const std::vector<test::McapMessage> recorded = test::read_from_begin(part);
  EXPECT_EQ(begin, std::ranges::min(recorded, {}, &test::McapMessage::log_time).log_time);
  const std::vector<test::McapMessage> messages = test::read_by_index(folder / "run.mcap");
  EXPECT_TRUE(std::ranges::is_sorted(messages, {}, &test::McapMessage::log_time));
  std::vector<std::string> texts;
  for (const test::McapMessage& message : messages) {
    if (message.topic == "scene" && message.type == "S") texts.push_back(message.payload);
  }
  EXPECT_THAT(texts, ElementsAre("{}", "[]"));
}

TEST(Merge, APartWithoutAByteHasNoMessages) {
  const test::TemporaryFolder folder;
  test::put(folder / "a.mcap", "");
  const Merged merged = merge({folder / "a.mcap"}, nothing, folder / "run.mcap");
  EXPECT_EQ(merged.num_messages, 0U);
  EXPECT_THAT(merged.cut_off, ElementsAre(folder / "a.mcap"));
  EXPECT_THAT(test::read_by_index(folder / "run.mcap"), IsEmpty());
}

TEST(Merge, ErrorsNameThePartAndLeaveNothing) {
  const test::TemporaryFolder folder;
  test::put(folder / "a.mcap", "PNG, not MCAP");
  std::string channel_of_no_schema(kMagic);
  append_channel(channel_of_no_schema, 1, {.schema = 7});
  test::put(folder / "b.mcap", channel_of_no_schema);
  std::string message_of_no_channel(kMagic);
  append_message(message_of_no_channel, {.channel = 7});
  test::put(folder / "c.mcap", message_of_no_channel);
  std::string short_schema(kMagic);
  append_record(short_schema, Opcode::kSchema, "x");
  test::put(folder / "d.mcap", short_schema);
  for (const auto& [name, line] :
       std::vector<std::pair<const char*, const char*>>{{"a.mcap", "a.mcap: no MCAP file"},
                                                        {"b.mcap", "b.mcap: a record contradicts"},
                                                        {"c.mcap", "c.mcap: a record contradicts"},
                                                        {"d.mcap", "d.mcap: a record contradicts"},
                                                        {"e.mcap", "e.mcap"}}) {
    const auto merge_it = [&, part = folder / name] {
      merge({part}, nothing, folder / "run.mcap");
    };
    EXPECT_THAT(merge_it, testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(line)));
    EXPECT_FALSE(std::filesystem::exists(folder / "run.mcap"));
  }
}

}  // namespace
}  // namespace hlc::mcap
