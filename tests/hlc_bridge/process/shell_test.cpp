// The shell with machines and hosts of the test, without DDS.
#include "hlc_bridge/process/shell.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>

namespace hlc::process {
namespace {

struct Number {
  int value{};
};
struct Alive {
  int count{};
};
struct Tick {
  Nanoseconds time{};
};

/// A machine whose decisions the test makes; it is fed on the shell's thread.
struct ScriptedMachine {
  using Event = std::variant<Number, Alive, machine::StopSignal>;
  using Action = std::variant<Number, Tick, machine::LogLine>;

  void on(const Event& event) {
    if (const auto* number = std::get_if<Number>(&event)) numbers.push_back(number->value);
    if (const auto* alive = std::get_if<Alive>(&event)) presences.push_back(alive->count);
    if (std::holds_alternative<machine::StopSignal>(event)) code = 0;
  }
  std::vector<Action> advance(const Instant& now) {
    ++advances;
    return decide ? decide(*this, now) : std::vector<Action>{};
  }
  [[nodiscard]] WakeUp wake_up() const { return wake; }
  [[nodiscard]] std::size_t awaited() const { return enough; }
  [[nodiscard]] std::optional<int> exit_code() const { return code; }

  std::function<std::vector<Action>(ScriptedMachine&, const Instant&)> decide{};
  std::vector<int> numbers{};
  std::vector<int> presences{};
  int advances{};
  WakeUp wake{};
  std::size_t enough{1};
  std::optional<int> code{};
};
static_assert(machine::Machine<ScriptedMachine>);

struct Host {
  void perform(const Number& number) { numbers.push_back(number.value); }
  void perform(const Tick& tick) { ticks.push_back(tick.time); }
  void perform(const machine::LogLine& line) { lines.push_back(line.text); }
  void announce_tick(const ReadyStatus& status) {
    ready.push_back(status);
    if (on_ready) on_ready(status);
  }
  [[nodiscard]] Alive presence() const { return {.count = num_alive}; }

  std::vector<int> numbers{};
  std::vector<Nanoseconds> ticks{};
  std::vector<std::string> lines{};
  std::vector<ReadyStatus> ready{};
  std::function<void(const ReadyStatus&)> on_ready{};
  std::atomic<int> num_alive{3};
};

using TestShell = Shell<ScriptedMachine>;

std::unique_ptr<machine::Pacing> real() { return std::make_unique<machine::RealPacing>(); }
std::unique_ptr<machine::Pacing> logical(Nanoseconds patience = machine::LogicalPacing::kPatience) {
  return std::make_unique<machine::LogicalPacing>(patience, time::wall_time_now());
}

TEST(Shell, FeedsPresenceThenWhatCameAndPerformsWhatTheMachineSays) {
  Host host;
  TestShell shell{"node",
                  {.decide =
                       [](ScriptedMachine& machine, const Instant&) {
                         std::vector<ScriptedMachine::Action> actions;
                         for (const int number : machine.numbers) {
                           actions.emplace_back(Number{10 * number});
                         }
                         actions.emplace_back(machine::info("done"));
                         machine.code = 7;
                         return actions;
                       }},
                  real()};
  shell.post(Number{1});
  shell.post(Number{2});
  EXPECT_EQ(shell.run(host), 7);
  EXPECT_EQ(shell.machine().presences, std::vector<int>{3});
  EXPECT_EQ(host.numbers, (std::vector<int>{10, 20}));
  EXPECT_EQ(host.lines, std::vector<std::string>{"done"});
  EXPECT_EQ(shell.machine().advances, 1);
}

TEST(Shell, StopFromAnotherThreadEndsAMachineThatWaitsForNothing) {
  Host host;
  TestShell shell{"node", {.enough = machine::kOnlyUrgent}, real()};
  std::thread stopper{[&] { shell.stop(); }};
  EXPECT_EQ(shell.run(host), 0);
  stopper.join();
}

TEST(Shell, ChangesOfPresenceWakeTheMachineAtOnce) {
  Host host;
  std::thread other;
  TestShell shell{"node",
                  {.decide =
                       [&](ScriptedMachine& machine, const Instant&) {
                         if (machine.presences.size() == 1 && !other.joinable()) {
                           other = std::thread{[&] {
                             host.num_alive = 4;
                             shell.presence_changed();
                           }};
                         }
                         if (machine.presences.size() == 2) machine.code = 0;
                         return std::vector<ScriptedMachine::Action>{};
                       },
                   .enough = machine::kOnlyUrgent},
                  logical()};
  EXPECT_EQ(shell.run(host), 0);
  other.join();
  EXPECT_EQ(shell.machine().presences, (std::vector<int>{3, 4}));
}

TEST(Shell, RealTimeTicksAreGivenWhenTheClockIsThere) {
  Host host;
  const Nanoseconds begin = time::real_time_now();
  constexpr Nanoseconds kPeriod = 1'000'000;
  TestShell shell{"node",
                  {.decide =
                       [&](ScriptedMachine& machine, const Instant& now) {
                         std::vector<ScriptedMachine::Action> actions;
                         if (!machine.wake.run) machine.wake.run = begin + kPeriod;
                         if (now.run >= *machine.wake.run) {
                           actions.emplace_back(Tick{now.run});
                           *machine.wake.run += kPeriod;
                         }
                         if (now.run >= begin + 20 * kPeriod) machine.code = 0;
                         return actions;
                       }},
                  real()};
  EXPECT_EQ(shell.run(host), 0);
  ASSERT_FALSE(host.ticks.empty());
  EXPECT_GE(host.ticks.front(), begin + kPeriod);
  EXPECT_TRUE(host.ready.empty()) << "no requests in real time";
}

/// Ticks at 0, 20, 40; the lab control is the test.
std::vector<ScriptedMachine::Action> tick_thrice(ScriptedMachine& machine, const Instant& now) {
  if (!machine.wake.run) {
    machine.wake.run = 0;
    return {};
  }
  if (!now.has_begun || now.run < *machine.wake.run) return {};
  *machine.wake.run += 20;
  if (now.run == 40) machine.code = 0;
  return {Tick{now.run}};
}

TEST(Shell, LogicalTicksAreGivenWhenTheyAreReleased) {
  Host host;
  TestShell shell{"node", {.decide = tick_thrice, .enough = machine::kOnlyUrgent}, logical()};
  host.on_ready = [&](const ReadyStatus& status) {
    shell.trigger(status.next_start + 5);  // for another vehicle
    shell.trigger(status.next_start);
  };
  EXPECT_EQ(shell.run(host), 0);
  EXPECT_EQ(host.ticks, (std::vector<Nanoseconds>{0, 20, 40}));
  ASSERT_EQ(host.ready.size(), 3U);
  EXPECT_EQ(host.ready[1].source_id, "node");
  EXPECT_EQ(host.ready[1].next_start, 20U);
}

TEST(Shell, ALabControlThatSendsNoTriggersEndsTheProcess) {
  Host host;
  TestShell shell{"node", {.decide = tick_thrice}, logical(1)};
  EXPECT_EQ(shell.run(host), kExitDied);
  EXPECT_EQ(host.lines,
            std::vector<std::string>{"lab_control is not responding: no triggers received"});
}

TEST(Shell, WhatIsNotAwaitedIsReadAfterAWhileAnyway) {
  Host host;
  TestShell shell{"node",
                  {.decide =
                       [](ScriptedMachine& machine, const Instant&) {
                         if (!machine.numbers.empty()) machine.code = 0;
                         return std::vector<ScriptedMachine::Action>{};
                       },
                   .enough = 100},
                  logical()};
  std::thread other{[&] { shell.post(Number{1}); }};
  EXPECT_EQ(shell.run(host), 0);
  other.join();
}

TEST(Shell, WakesUpByWallTime) {
  Host host;
  const Nanoseconds due = time::wall_time_now() + 2'000'000;
  TestShell shell{"node",
                  {.decide =
                       [&](ScriptedMachine& machine, const Instant& now) {
                         if (now.wall >= due) machine.code = 0;
                         return std::vector<ScriptedMachine::Action>{};
                       },
                   .wake = {.wall = due},
                   .enough = machine::kOnlyUrgent},
                  logical()};
  EXPECT_EQ(shell.run(host), 0);
}

}  // namespace
}  // namespace hlc::process
