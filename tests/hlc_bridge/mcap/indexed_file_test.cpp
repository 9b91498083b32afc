#include "hlc_bridge/mcap/indexed_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/hlc_bridge/mcap/mcap_reader.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::mcap {
namespace {

class IndexedFileTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path file_{folder_ / "run.mcap"};
};

/// Files of no, one and several chunks.
TEST_F(IndexedFileTest, EveryMessageIsFoundThroughTheIndex) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(20); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::vector<test::McapMessage> expected;
    {
      IndexedFile file(file_);
      Nanoseconds time = random() % 1000;
      const std::size_t count = seed == 0 ? 0 : random() % 400;
      for (std::size_t i = 0; i < count; ++i) {
        const std::string topic = "topic " + std::to_string(random() % 5);
        const std::uint16_t schema = file.add(Schema{.name = "type of " + topic});
        const std::uint16_t channel =
            file.add(Channel{.schema = schema, .topic = topic, .metadata = {{"publisher", "a"}}});
        const std::string payload(random() % 20'000, static_cast<char>(random()));
        file.add(Message{.channel = channel,
                         .sequence = static_cast<std::uint32_t>(i),
                         .log_time = time,
                         .publish_time = 2 * time,
                         .payload = payload});
        expected.push_back({.topic = topic,
                            .type = "type of " + topic,
                            .metadata = {{"publisher", "a"}},
                            .sequence = static_cast<std::uint32_t>(i),
                            .log_time = time,
                            .publish_time = 2 * time,
                            .payload = payload});
        time += random() % 3;
      }
      file.finish();
      EXPECT_EQ(file.num_messages(), expected.size());
    }
    EXPECT_TRUE(test::read_by_index(file_) == expected);
  }
}

TEST_F(IndexedFileTest, LeavesNothingIfItIsNotFinished) {
  { IndexedFile file(file_); }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(IndexedFileTest, ErrorsNameTheFile) {
  const auto create = [this] { IndexedFile file(folder_ / "missing/run.mcap"); };
  EXPECT_THAT(create, testing::ThrowsMessage<std::runtime_error>(
                          testing::HasSubstr("missing/run.mcap: cannot be written")));
}

}  // namespace
}  // namespace hlc::mcap
