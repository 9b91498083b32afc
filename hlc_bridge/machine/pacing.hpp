#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>

#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// How the time of a run passes for the machine of a process. Knows no clock and no thread:
/// `clocks` are their values, `run` being CLOCK_REALTIME. The shell calls it under its lock.
class Pacing {
 public:
  Pacing() = default;
  Pacing(const Pacing&) = delete;
  Pacing& operator=(const Pacing&) = delete;
  virtual ~Pacing() = default;

  /// The time with which the machine is advanced.
  [[nodiscard]] virtual Instant now(const Instant& clocks) const = 0;

  /// The tick that the machine waits for (WakeUp::run); after every advance.
  virtual void want(std::optional<Nanoseconds> tick) = 0;
  /// The requested tick is due.
  [[nodiscard]] virtual bool is_due() const = 0;
  /// When the thread must check again, by the clocks.
  [[nodiscard]] virtual WakeUp wake_up() const = 0;
  /// How long an event that is not urgent may wait until enough have arrived (Machine::awaited).
  [[nodiscard]] virtual Nanoseconds mail_delay() const = 0;

  /// A SystemTrigger was received. True if it releases the requested tick.
  virtual bool on_trigger(Nanoseconds /*next_start*/, Nanoseconds /*wall*/) { return false; }
  /// The tick to be announced in a ReadyStatus now, if any.
  [[nodiscard]] virtual std::optional<Nanoseconds> announcement(Nanoseconds /*wall*/) {
    return std::nullopt;
  }
  /// No trigger has arrived for too long while a tick is requested.
  [[nodiscard]] virtual bool is_timed_out(Nanoseconds /*wall*/) const { return false; }
};

/// Real time: the computer's clock is the time of the run.
class RealPacing : public Pacing {
 public:
  [[nodiscard]] Instant now(const Instant& clocks) const override { return clocks; }
  void want(std::optional<Nanoseconds> tick) override { wanted_ = tick; }
  [[nodiscard]] bool is_due() const override { return false; }
  [[nodiscard]] WakeUp wake_up() const override { return {.run = wanted_}; }
  [[nodiscard]] Nanoseconds mail_delay() const override { return 0; }

 private:
  std::optional<Nanoseconds> wanted_;
};

/// Who starts a run in logical time.
enum class LogicalStart : std::uint8_t {
  kByOurs,    ///< our lab control, once all processes are present
  kInTheLab,  ///< perhaps the operator of the lab's control centre
};

/// Logical time: ticks released one by one by the lab control (lab wire contract, 5.3). The process
/// publishes which tick it wants next (ReadyStatus), and the tick is due when a SystemTrigger with
/// exactly that time has arrived. Requesting a tick means that everything before it is done.
///
/// A ready status can be lost: it is republished every second of wall time. A lab control can stop
/// responding while its participant still announces itself. Then no trigger arrives, not even for
/// others, and after `patience` the process ends. In a healthy run, the longest time without a
/// trigger is that in which the lab control detects a death: kMessageTimeout + 2 s.
///
/// In the lab (LogicalStart::kInTheLab) the operator starts the run when he likes: before the first
/// trigger the patience has no limit. And the run may have started before the process has: its
/// control centre, once it receives a request for a tick of its past ("out of sync"), sends
/// no further triggers. So the process listens for kListen before it announces its first tick, and
/// a tick that the triggers have passed is due at once, late: the next one lies in the future.
///
/// A process that requests no ticks (a controller, which follows lists; the lab control, which
/// releases them) learns from it only that no time passes.
class LogicalPacing : public Pacing {
 public:
  static constexpr Nanoseconds kRepeat = kNanosecondsPerSecond;
  static constexpr Nanoseconds kPatience = 60 * kNanosecondsPerSecond;
  static constexpr Nanoseconds kMailDelay = 50 * kNanosecondsPerMillisecond;

  static constexpr Nanoseconds kListen = 300 * kNanosecondsPerMillisecond;

  /// The first trigger may come as late as the last process appears.
  [[nodiscard]] static constexpr Nanoseconds patience_for(Nanoseconds startup_timeout) {
    return std::max(kPatience, startup_timeout + kPatience / 2);
  }

  /// @param since  wall time of the process's start
  LogicalPacing(Nanoseconds patience, Nanoseconds since, LogicalStart start = {})
      : patience_(patience), start_(start), last_trigger_(since) {}

  [[nodiscard]] Instant now(const Instant& clocks) const override {
    return {.run = released_.value_or(0), .wall = clocks.wall, .has_begun = released_.has_value()};
  }
  void want(std::optional<Nanoseconds> tick) override {
    if (tick == wanted_) return;
    wanted_ = tick;
    next_announcement_ = 0;
    release_if_passed();
  }
  [[nodiscard]] bool is_due() const override { return wanted_ && released_ >= wanted_; }
  [[nodiscard]] WakeUp wake_up() const override {
    return {.wall = wanted_ ? std::optional(next_announcement_) : std::nullopt};
  }
  [[nodiscard]] Nanoseconds mail_delay() const override { return kMailDelay; }

  bool on_trigger(Nanoseconds next_start, Nanoseconds wall) override {
    last_trigger_ = wall;
    if (next_start != kStopSymbol)
      newest_trigger_ = std::max(newest_trigger_.value_or(0), next_start);
    if (wanted_ != next_start) return release_if_passed();  // for other processes
    released_ = next_start;
    return true;
  }
  [[nodiscard]] std::optional<Nanoseconds> announcement(Nanoseconds wall) override {
    if (!wanted_ || is_due() || wall < next_announcement_) return std::nullopt;
    if (start_ == LogicalStart::kInTheLab) {
      if (!listens_until_) listens_until_ = wall + kListen;
      if (wall < *listens_until_) {
        next_announcement_ = *listens_until_;
        return std::nullopt;
      }
    }
    next_announcement_ = wall + kRepeat;
    return wanted_;
  }
  [[nodiscard]] bool is_timed_out(Nanoseconds wall) const override {
    if (start_ == LogicalStart::kInTheLab && !newest_trigger_) return false;
    return wanted_ && !is_due() && wall - std::min(wall, last_trigger_) >= patience_;
  }

 private:
  bool release_if_passed() {
    if (start_ != LogicalStart::kInTheLab || !wanted_ || newest_trigger_ <= wanted_) return false;
    released_ = newest_trigger_;
    return true;
  }

  Nanoseconds patience_;
  LogicalStart start_;
  Nanoseconds last_trigger_;                   ///< wall
  std::optional<Nanoseconds> newest_trigger_;  ///< the largest time
  std::optional<Nanoseconds> listens_until_;   ///< wall
  std::optional<Nanoseconds> wanted_;
  std::optional<Nanoseconds> released_;
  Nanoseconds next_announcement_{};  ///< wall
};

/// What a process is given of the kind of time that its run has (flag --simulated_time), so that it
/// never asks which of the two it is. What its machine is given: pacing_rules.hpp and the machines'
/// own rules.
struct RunTime {
  using MakePacing = std::unique_ptr<Pacing> (*)(Nanoseconds startup_timeout, Nanoseconds since);

  /// startup_timeout: wall time. since: wall time now.
  MakePacing make_pacing{};
  Nanoseconds lease{};  ///< that long after its death others see a participant as lost
};

inline constexpr RunTime kRealTime{
    .make_pacing = [](Nanoseconds, Nanoseconds) -> std::unique_ptr<Pacing> {
      return std::make_unique<RealPacing>();
    },
    .lease = 2 * kNanosecondsPerSecond};
inline constexpr RunTime kLogicalTime{
    .make_pacing = [](Nanoseconds startup_timeout, Nanoseconds since) -> std::unique_ptr<Pacing> {
      return std::make_unique<LogicalPacing>(LogicalPacing::patience_for(startup_timeout), since);
    },
    .lease = 10 * kNanosecondsPerSecond};

inline constexpr RunTime kLogicalTimeInTheLab{
    .make_pacing = [](Nanoseconds startup_timeout, Nanoseconds since) -> std::unique_ptr<Pacing> {
      return std::make_unique<LogicalPacing>(LogicalPacing::patience_for(startup_timeout), since,
                                             LogicalStart::kInTheLab);
    },
    .lease = kLogicalTime.lease};

[[nodiscard]] constexpr RunTime run_time(bool is_logical, bool is_in_the_lab = false) {
  if (!is_logical) return kRealTime;
  return is_in_the_lab ? kLogicalTimeInTheLab : kLogicalTime;
}

}  // namespace hlc::machine
