// Random orders of events: what a middleware does depends on what comes, not on when.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/middleware/middleware_machine.hpp"
#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::middleware {
namespace {

using test::command;
using test::kMs;
using test::kPeriod;
using test::published_state;

using Random = std::mt19937_64;

bool chance(Random& random, int percent) {
  return std::uniform_int_distribution<int>{1, 100}(random) <= percent;
}

/// What must come for the tick, and what may: states, among them older and repeated ones, answers
/// with their copies, triggers of the vehicles' ticks. Shuffled.
std::vector<MiddlewareEvent> events_of_tick(Nanoseconds tick,
                                            const std::vector<std::uint8_t>& controllers,
                                            std::uint8_t vehicles, Random& random) {
  std::vector<MiddlewareEvent> events;
  if (const auto due = newest_valid_state_stamp(tick)) {
    for (std::uint8_t id = 1; id <= vehicles; ++id) {
      events.emplace_back(published_state(id, *due));
      if (*due >= 20 * kMs && chance(random, 50)) {
        events.emplace_back(published_state(id, *due - 20 * kMs));
      }
      if (chance(random, 30)) events.emplace_back(published_state(id, *due));
    }
  }
  for (const std::uint8_t id : controllers) {
    events.emplace_back(VehicleCommand{command(id, tick)});
    if (chance(random, 50)) events.emplace_back(VehicleCommand{command(id, tick)});
  }
  if (chance(random, 30)) events.emplace_back(VehicleCommand{command(200, tick)});
  if (chance(random, 30)) events.emplace_back(SystemTrigger{tick / (20 * kMs) * (20 * kMs)});
  std::ranges::shuffle(events, random);
  return events;
}

/// Feeds the events one by one; the machine is advanced now and then, and at the end.
void feed(test::MiddlewareInMemory& run, const std::vector<MiddlewareEvent>& events,
          Random& random) {
  for (const MiddlewareEvent& event : events) {
    run.post(event);
    if (chance(random, 60)) run.advance();
    if (chance(random, 10)) run.wait(kMs);
  }
  run.advance();
}

TEST(MiddlewareMachineProperty, WithPatienceListsDependOnNothingButTheMessages) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{seed};
    const auto vehicles = std::uniform_int_distribution<std::uint8_t>{1, 4}(random);
    std::vector<std::uint8_t> controllers{1};
    for (std::uint8_t id = 2; id <= vehicles && chance(random, 40); ++id) controllers.push_back(id);
    std::vector<std::int32_t> active;
    std::set<std::uint8_t> here;
    for (std::uint8_t id = 1; id <= vehicles; ++id) {
      active.push_back(id);
      here.insert(id);
    }
    test::MiddlewareInMemory run{
        {.vehicle_ids = controllers, .rules = logical_middleware_rules(false)}};
    run.begin_in_logical_time();
    run.publish_parameters(200, active);
    run.on(run.all_present(here));

    std::size_t forwarded = 0;
    for (Nanoseconds tick = kListOffset; tick < 6 * kPeriod; tick += kPeriod) {
      ASSERT_EQ(run.machine().wake_up().run, tick);
      std::vector<MiddlewareEvent> events = events_of_tick(tick, controllers, vehicles, random);
      forwarded += static_cast<std::size_t>(std::ranges::count_if(events, [](const auto& event) {
        const auto* sent = std::get_if<VehicleCommand>(&event);
        return sent != nullptr && vehicle_of(*sent) != 200;
      }));
      // What comes before the release may come in any order, too; but no list is answered that is
      // not there.
      const auto is_answer = [](const MiddlewareEvent& event) {
        return std::holds_alternative<VehicleCommand>(event);
      };
      const auto answers = std::ranges::stable_partition(events, std::not_fn(is_answer));
      const std::vector<MiddlewareEvent> last{answers.begin(), answers.end()};
      events.erase(answers.begin(), answers.end());
      const auto released_after = static_cast<std::ptrdiff_t>(
          std::uniform_int_distribution<std::size_t>{0, events.size()}(random));
      feed(run, {events.begin(), events.begin() + released_after}, random);
      ASSERT_TRUE(run.machine().wake_up().run) << "asks until it is released";
      run.release(tick);
      ASSERT_FALSE(run.machine().wake_up().run) << "the answers are not in";
      feed(run, {events.begin() + released_after, events.end()}, random);

      const std::vector<VehicleStateList> lists = run.all<VehicleStateList>();
      ASSERT_EQ(lists.size(), tick / kPeriod + 1);
      EXPECT_EQ(lists.back().t_now, tick);
      for (const VehicleState& state : lists.back().states) {
        EXPECT_EQ(state.create_stamp, newest_valid_state_stamp(tick).value_or(0));
      }
      feed(run, last, random);
      EXPECT_EQ(run.all<VehicleCommand>().size(), forwarded) << "each once";
    }

    run.post(VehicleCommand{command(1, kListOffset)});  // before the stop: goes on
    run.post(SystemTrigger{kStopSymbol});
    run.on(VehicleCommand{command(1, kListOffset)});  // after it: does not
    EXPECT_EQ(run.all<VehicleCommand>().size(), forwarded + 1);
    EXPECT_EQ(run.all<SystemTrigger>().back().next_start, kStopSymbol);
    run.wait(MiddlewareMachine::kLeaveTime);
    EXPECT_EQ(run.machine().exit_code(), kExitGood);
    EXPECT_EQ(run.count_lines("no longer waiting"), 0U);
  }
}

/// The random life of a middleware in real time, and what must hold after every advance.
class RandomLife {
 public:
  explicit RandomLife(std::uint64_t seed) : random_{seed} {
    run_.on(run_.all_present({1, 2, 3}));
    run_.publish_parameters(200, {1, 2, 3});
  }

  void step() {
    switch (std::uniform_int_distribution<int>{0, 8}(random_)) {
      case 0:
        triggered_ = true;
        between_ = false;
        run_.on(SystemTrigger{5});
        break;
      case 1:
        triggered_ = false;
        between_ = true;
        ready_.clear();
        run_.on(SystemTrigger{kStopSymbol});
        break;
      case 2:
      case 3: {
        const std::size_t before = run_.all<VehicleCommand>().size();
        const std::uint8_t id = chance(random_, 50) ? 1 : 2;
        run_.on(VehicleCommand{command(id, run_.now().run - (chance(random_, 50) ? kPeriod : 0))});
        EXPECT_EQ(run_.all<VehicleCommand>().size(), before + (between_ ? 0 : 1));
        break;
      }
      case 4:
        ready_.insert(chance(random_, 50) ? 1 : 2);
        for (const std::uint8_t id : ready_) {
          run_.on(ReadyStatus{.source_id = controller_ready_id(id)});
        }
        break;
      case 5:
        run_.publish_parameters(200, {1, 2, 3});
        break;
      case 6:
        run_.on(chance(random_, 50) ? run_.all_present({1, 2, 3}) : MiddlewarePeers{});
        break;
      case 7:
        run_.on(published_state(1, run_.now().run));
        break;
      default:
        pass();
    }
    EXPECT_FALSE(run_.machine().exit_code());
    ASSERT_TRUE(run_.machine().wake_up().run) << "it never waits within a tick";
  }

 private:
  /// Up to a period and a half; mostly to the wake-up.
  void pass() {
    const std::size_t lists_before = run_.all<VehicleStateList>().size();
    const std::size_t ready_before = run_.all<ReadyStatus>().size();
    const Nanoseconds due = *run_.machine().wake_up().run;
    Nanoseconds time = due - std::min(due, run_.now().run);
    if (chance(random_, 30)) {
      time = std::uniform_int_distribution<Nanoseconds>{0, kPeriod * 3 / 2}(random_);
    }
    run_.pass(time);
    const std::vector<VehicleStateList> lists = run_.all<VehicleStateList>();
    const bool is_tick = run_.now().run >= due;
    ASSERT_EQ(lists.size(), lists_before + (is_tick ? 1 : 0));
    if (is_tick) {
      EXPECT_EQ(lists.back().t_now % kPeriod, kListOffset);
      EXPECT_GE(lists.back().t_now, due);
      EXPECT_GT(lists.back().t_now + kPeriod, run_.now().run);
    }
    if (triggered_ || ready_.size() < 2 || !is_tick) {
      EXPECT_EQ(run_.all<ReadyStatus>().size(), ready_before);
    }
  }

  Random random_;
  test::MiddlewareInMemory run_{
      {.vehicle_ids = {1, 2}, .keep_running = true, .rules = real_middleware_rules(false)}};
  bool triggered_{};
  bool between_{};
  std::set<std::uint8_t> ready_;
};

TEST(MiddlewareMachineProperty, WithoutPatienceItWritesListsOnTheGridAndNeverWithheldCommands) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomLife life{seed};
    for (int i = 0; i < 200 && !testing::Test::HasFatalFailure(); ++i) life.step();
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace hlc::middleware
