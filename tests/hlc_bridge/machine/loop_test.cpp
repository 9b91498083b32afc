#include "hlc_bridge/machine/loop.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hlc::machine {
namespace {

/// Ends at the signal, and counts.
struct CountingMachine {
  using Event = std::variant<StopSignal, std::string>;
  using Action = std::variant<LogLine>;

  void on(const Event& event) {
    if (std::holds_alternative<StopSignal>(event)) code = 0;
    ++events;
  }
  std::vector<Action> advance(const Instant& /*now*/) { return {}; }
  [[nodiscard]] WakeUp wake_up() const { return {}; }
  [[nodiscard]] std::size_t awaited() const { return 1; }
  [[nodiscard]] std::optional<int> exit_code() const { return code; }

  std::size_t events{};
  std::optional<int> code{};
};

struct Host {
  void perform(const LogLine& /*line*/) {}
  [[nodiscard]] std::string presence() const { return {}; }
};

constexpr MailBudget::Publisher kPeer{1};
constexpr std::size_t kBytes = 60'000;

/// A peer publishes that many messages while the machine is busy.
std::size_t post(Loop<CountingMachine>& loop, std::size_t messages) {
  std::size_t posted = 0;
  for (std::size_t i = 0; i < messages; ++i) {
    if (!loop.admits(kPeer, kBytes)) continue;
    loop.post(std::string("message"));
    ++posted;
  }
  return posted;
}

std::optional<int> iterate(Loop<CountingMachine>& loop) {
  Host host;
  return loop.iterate(
      host, [] { return Instant{}; }, [](const auto& access) { return access(); });
}

TEST(Loop, WhatWaitsOfAFloodingPeerIsBoundedAndItsMailIsReadAgainAfterwards) {
  Loop<CountingMachine> loop("node", {}, std::make_unique<RealPacing>());
  const std::size_t posted = post(loop, 10'000);
  EXPECT_LE(posted * kBytes, MailBudget::kMostBytes);
  EXPECT_EQ(iterate(loop), std::nullopt);
  EXPECT_EQ(loop.machine().events, posted + 1) << "and the presence";
  EXPECT_EQ(post(loop, 1), 1U);
}

TEST(Loop, TheSignalToStopIsReadAfterAFlood) {
  Loop<CountingMachine> loop("node", {}, std::make_unique<RealPacing>());
  static_cast<void>(post(loop, 10'000));
  loop.post_urgent(StopSignal{});
  EXPECT_EQ(iterate(loop), 0);
}

}  // namespace
}  // namespace hlc::machine
