#include "vehicle_sim/tracking/command_buffer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/num_seeds.hpp"

namespace hlc::tracking::command_buffer_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

/// The number of points serves as a mark by which a test knows the command again.
TrajectoryCommand command(Nanoseconds create_ms, Nanoseconds valid_after_ms, std::size_t mark) {
  return {.vehicle_id = 1,
          .create_stamp = create_ms * kMillisecond,
          .valid_after_stamp = valid_after_ms * kMillisecond,
          .points = std::vector<TrajectoryPoint>(mark)};
}

std::size_t mark_at(CommandBuffer<TrajectoryCommand>& buffer, Nanoseconds t_ms) {
  const TrajectoryCommand* usable = buffer.usable_at(t_ms * kMillisecond);
  return usable == nullptr ? 0 : usable->points.size();
}

TEST(CommandBuffer, NothingIsUsableBeforeACommandArrives) {
  CommandBuffer<TrajectoryCommand> buffer;
  EXPECT_EQ(buffer.usable_at(0), nullptr);
}

TEST(CommandBuffer, CommandIsUsableFromValidAfterForOneSecond) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 100, 1));
  EXPECT_EQ(mark_at(buffer, 99), 0U);
  EXPECT_EQ(mark_at(buffer, 100), 1U);
  EXPECT_NE(buffer.usable_at(1'100 * kMillisecond - 1), nullptr);
  EXPECT_EQ(mark_at(buffer, 1'100), 0U);
}

TEST(CommandBuffer, LargestCreateStampWinsWhateverTheOrderOfArrival) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(200, 200, 2));
  buffer.add(command(0, 0, 1));
  EXPECT_EQ(mark_at(buffer, 300), 2U);
  buffer.add(command(100, 100, 3));
  EXPECT_EQ(mark_at(buffer, 320), 2U);
}

TEST(CommandBuffer, LaterArrivalWinsATie) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  buffer.add(command(0, 0, 2));
  EXPECT_EQ(mark_at(buffer, 0), 2U);
  buffer.add(command(0, 0, 3));
  EXPECT_EQ(mark_at(buffer, 20), 3U);
}

TEST(CommandBuffer, CopyWithLaterValidityTakesOver) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  buffer.add(command(0, 800, 2));
  EXPECT_EQ(mark_at(buffer, 780), 1U);
  EXPECT_EQ(mark_at(buffer, 800), 2U);
  EXPECT_EQ(mark_at(buffer, 1'780), 2U);
  EXPECT_EQ(mark_at(buffer, 1'800), 0U);
}

TEST(CommandBuffer, CopyOfAnOlderPlanNeverComesBack) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  buffer.add(command(0, 800, 2));
  buffer.add(command(200, 200, 3));
  EXPECT_EQ(mark_at(buffer, 200), 3U);
  EXPECT_EQ(mark_at(buffer, 900), 3U);
  EXPECT_EQ(mark_at(buffer, 1'200), 0U) << "the newest word has expired, and no older one counts";
}

TEST(CommandBuffer, NewerCommandThatIsNotYetValidDoesNotInterrupt) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  buffer.add(command(200, 400, 2));
  EXPECT_EQ(mark_at(buffer, 380), 1U);
  EXPECT_EQ(mark_at(buffer, 400), 2U);
}

TEST(CommandBuffer, ClearForgetsEverything) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  EXPECT_EQ(mark_at(buffer, 0), 1U);
  buffer.add(command(200, 200, 2));
  buffer.clear();
  EXPECT_EQ(mark_at(buffer, 200), 0U);
  buffer.add(command(100, 100, 3));
  EXPECT_EQ(mark_at(buffer, 220), 3U);
}

TEST(CommandBuffer, FloodOfFutureCommandsDoesNotPushOutTheActiveOne) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 0, 1));
  EXPECT_EQ(mark_at(buffer, 0), 1U);
  for (std::size_t i = 0; i < 10 * CommandBuffer<TrajectoryCommand>::kCapacity; ++i) {
    buffer.add(command(200, 100'000 + i, 2));
  }
  EXPECT_EQ(mark_at(buffer, 500), 1U);
}

TEST(CommandBuffer, EarliestArrivalMakesRoom) {
  CommandBuffer<TrajectoryCommand> buffer;
  buffer.add(command(0, 100, 1));
  for (std::size_t i = 0; i < CommandBuffer<TrajectoryCommand>::kCapacity - 1; ++i) {
    buffer.add(command(200, 1'000, 2));
  }
  CommandBuffer<TrajectoryCommand> with_one_more = buffer;
  EXPECT_EQ(mark_at(buffer, 100), 1U);
  with_one_more.add(command(200, 1'000, 2));
  EXPECT_EQ(mark_at(with_one_more, 100), 0U);
}

/// The rule read word for word, over everything that ever arrived.
const TrajectoryCommand* by_the_rule(const std::vector<TrajectoryCommand>& arrived, Nanoseconds t) {
  const TrajectoryCommand* best = nullptr;
  for (const TrajectoryCommand& candidate : arrived) {
    if (candidate.valid_after_stamp <= t &&
        (best == nullptr || candidate.create_stamp >= best->create_stamp)) {
      best = &candidate;
    }
  }
  const bool is_usable = best != nullptr && t - best->valid_after_stamp < 1'000 * kMillisecond;
  return is_usable ? best : nullptr;
}

TEST(CommandBuffer, AnswersByTheRuleForRandomArrivals) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    CommandBuffer<TrajectoryCommand> buffer;
    std::vector<TrajectoryCommand> arrived;
    for (Nanoseconds t_ms = 0; t_ms < 6'000; t_ms += 20) {
      for (auto n = random() % 8; n > 5; --n) {  // few values each, so that ties are frequent
        const Nanoseconds create_ms = t_ms / 200 * 200 + random() % 5 * 100;
        const Nanoseconds valid_after_ms = create_ms + random() % 7 * 200;
        arrived.push_back(command(create_ms, valid_after_ms, arrived.size() + 1));
        buffer.add(arrived.back());
      }
      const TrajectoryCommand* want = by_the_rule(arrived, t_ms * kMillisecond);
      ASSERT_EQ(mark_at(buffer, t_ms), want == nullptr ? 0 : want->points.size()) << t_ms;
    }
  }
}

}  // namespace
}  // namespace hlc::tracking::command_buffer_test
