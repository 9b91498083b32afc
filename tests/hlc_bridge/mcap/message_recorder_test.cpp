#include "hlc_bridge/mcap/message_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <stdexcept>

#include "tests/hlc_bridge/mcap/mcap_reader.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::mcap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class MessageRecorderTest : public testing::Test {
 protected:
  MessageRecorder::Options options() {
    return {.folder = folder_ / "messages",
            .process = "car",
            .definition_of = [](const std::string& type) { return "of " + type; },
            .wall_time = [this] { return wall_.load(); },
            .on_failure = [this](const std::string& line) { failures_.push_back(line); }};
  }
  [[nodiscard]] std::vector<Nanoseconds> log_times(const std::filesystem::path& file) const {
    std::vector<Nanoseconds> times;
    for (const auto& message : test::read_from_begin(file)) times.push_back(message.log_time);
    return times;
  }

  test::TemporaryFolder folder_;
  std::atomic<Nanoseconds> wall_{100};
  std::vector<std::string> failures_;
};

TEST_F(MessageRecorderTest, AMessageWithoutATimeHasTheNewestOfItsProcess) {
  MessageRecorder recorder(options());
  for (const std::optional<Nanoseconds> run :
       {std::optional<Nanoseconds>(), {5}, {}, {3}, {}, {9}}) {
    recorder.record({.topic = "a", .type = "A", .cdr = "x", .run = run});
  }
  EXPECT_TRUE(recorder.close());
  EXPECT_THAT(log_times(recorder.file()), ElementsAre(0U, 5U, 5U, 3U, 5U, 9U));
}

TEST_F(MessageRecorderTest, HasTheMessagesOfAllThreadsEachTopicInOrder) {
  constexpr std::size_t kThreads = 4;
  constexpr std::size_t kMessages = 2000;
  MessageRecorder recorder(options());
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&recorder, thread] {
      for (std::size_t i = 0; i < kMessages; ++i) {
        const std::string payload = std::to_string(i);
        recorder.record({.topic = std::to_string(thread), .type = "A", .cdr = payload, .run = {}});
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(recorder.close());
  std::map<std::string, std::uint32_t> next;
  for (const test::McapMessage& message : test::read_from_begin(recorder.file())) {
    EXPECT_EQ(message.sequence, next[message.topic]);
    EXPECT_EQ(message.payload, std::to_string(next[message.topic]));
    EXPECT_EQ(message.metadata.at("publisher"), "car");
    ++next[message.topic];
  }
  EXPECT_THAT(next, SizeIs(kThreads));
  for (const auto& [topic, count] : next) EXPECT_EQ(count, kMessages) << topic;
}

TEST_F(MessageRecorderTest, AProcessStartedAgainWritesAnotherFile) {
  MessageRecorder first(options());
  MessageRecorder second(options());
  EXPECT_EQ(first.file().filename(), "car.mcap");
  EXPECT_EQ(second.file().filename(), "car_2.mcap");
}

/// The last message is written without another one after it.
TEST_F(MessageRecorderTest, APublishedMessageIsInTheFileSoonAlsoIfTheProcessIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    MessageRecorder recorder(options());
    for (int i = 0; i < 100; ++i) {
      recorder.record({.topic = "a", .type = "A", .cdr = "x", .run = {}});
    }
    pause();
    _exit(0);
  }
  const std::filesystem::path file = folder_ / "messages/car.mcap";
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::size_t count = 0;
  while (count < 100 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
    std::error_code ignored;
    if (std::filesystem::file_size(file, ignored) < 8 || ignored) continue;
    count = test::read_from_begin(file).size();
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(count, 100U);
}

TEST_F(MessageRecorderTest, AFullDiskIsOneLineAndTheProcessGoesOn) {
  {
    const test::FullDisk full(1000);
    MessageRecorder recorder(options());
    const std::string payload(10'000, 'x');
    recorder.record({.topic = "a", .type = "A", .cdr = payload, .run = {}});
    EXPECT_FALSE(recorder.close());
    recorder.record({.topic = "a", .type = "A", .cdr = payload, .run = {}});
  }
  EXPECT_THAT(failures_, ElementsAre(HasSubstr("car.mcap: no longer written: File too large")));
}

TEST_F(MessageRecorderTest, AFolderThatCannotBeCreatedIsNamed) {
  test::put(folder_ / "messages", "a file");
  const auto create = [this] { MessageRecorder recorder(options()); };
  EXPECT_THAT(create,
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("messages/car.mcap")));
}

}  // namespace
}  // namespace hlc::mcap
