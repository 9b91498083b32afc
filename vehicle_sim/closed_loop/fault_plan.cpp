#include "vehicle_sim/closed_loop/fault_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hlc_bridge/messages/node_names.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kMs = kNanosecondsPerMillisecond;

constexpr std::array kKinds{FaultKind::kLose,   FaultKind::kWithhold, FaultKind::kDelay,
                            FaultKind::kRepeat, FaultKind::kReorder,  FaultKind::kCut,
                            FaultKind::kKill,   FaultKind::kFreeze,   FaultKind::kStep,
                            FaultKind::kDrift};

bool is_of_process(FaultKind kind) { return kind >= FaultKind::kKill; }
bool holds_up(FaultKind kind) { return kind == FaultKind::kKill || kind == FaultKind::kFreeze; }
bool sets_clock(FaultKind kind) { return kind == FaultKind::kStep || kind == FaultKind::kDrift; }

class Draw {
 public:
  Draw(std::uint64_t seed, const FaultPlanSettings& settings)
      : random_(seed), settings_(settings) {}

  std::vector<Fault> faults() {
    std::vector<Fault> faults;
    switch (settings_.style) {
      case FaultStyle::kScattered:
        scatter(1 + random_.below(settings_.most_faults), faults);
        break;
      case FaultStyle::kBurst:
        window_ = any_window(1500 * kMs);
        scatter(3 + random_.below(6), faults);
        break;
      case FaultStyle::kLossy:
        add_losses(faults);
        scatter(random_.below(3), faults);
        break;
      case FaultStyle::kRestart:
        for (std::size_t i = 1 + random_.below(3); i > 0; --i) add_restart(faults);
        break;
      case FaultStyle::kBorder:
        window_ = any_window(3000 * kMs);
        for (std::size_t i = 2 + random_.below(4); i > 0; --i) add_at_border(faults);
        scatter(random_.below(2), faults);
        break;
      case FaultStyle::kSilence:
        add_silence(faults);
        break;
    }
    std::ranges::stable_sort(faults, {}, &Fault::begin);
    return faults;
  }

 private:
  struct Window {
    Nanoseconds from{};
    Nanoseconds until{};
  };

  void scatter(std::size_t count, std::vector<Fault>& faults) {
    for (std::size_t i = 0; i < count; ++i) add(faults);
  }

  /// In which faults begin; at the start nobody drives yet.
  Window any_window(Nanoseconds length) {
    const Nanoseconds span = settings_.last - settings_.first;
    const Nanoseconds from = settings_.first + std::min(2000 * kMs, span / 4);
    const Nanoseconds room = settings_.last - from;
    const Nanoseconds lasts = std::min(length, room / 2);
    const Nanoseconds begin = from + random_.below(room - lasts + 1);
    return {.from = begin, .until = begin + lasts};
  }

  /// Of all links, or of those of one process.
  void add_losses(std::vector<Fault>& faults) {
    for (std::size_t i = 1 + random_.below(2); i > 0; --i) {
      Fault fault{.kind = random_.chance(0.7) ? FaultKind::kLose : FaultKind::kWithhold,
                  .begin = settings_.first,
                  .end = settings_.last};
      if (!is_asked_for(fault.kind)) continue;
      if (random_.chance(0.6)) {
        (random_.chance(0.5) ? fault.process : fault.peer) = any_process(true, false);
      }
      fault.share = 0.1 + 0.2 * random_.share();
      faults.push_back(fault);
    }
  }

  void add_restart(std::vector<Fault>& faults) {
    const std::string process = any_process(random_.chance(0.2), random_.chance(0.2));
    const Window when = any_window(duration(20 * kMs, 3000 * kMs));
    Fault death{.kind = FaultKind::kKill, .begin = when.from, .end = when.until};
    death.process = process;
    if (is_asked_for(death.kind) && !excludes_any(death, faults)) faults.push_back(death);
    Fault loss{.kind = random_.chance(0.5) ? FaultKind::kWithhold : FaultKind::kCut};
    if (!is_asked_for(loss.kind)) return;
    loss.begin = when.from - std::min(when.from - settings_.first, random_.below(1000 * kMs));
    loss.end = std::min(when.until + random_.below(3000 * kMs), settings_.last);
    do {
      loss.process = random_.chance(0.3) ? std::string{} : any_process(false, false);
    } while (loss.process == process);
    loss.peer = process;
    loss.share = random_.chance(0.5) ? 1.0 : random_.share();
    faults.push_back(loss);
  }

  void add_at_border(std::vector<Fault>& faults) {
    constexpr std::array kKindsThere{FaultKind::kDelay, FaultKind::kRepeat, FaultKind::kReorder};
    Fault fault{.kind = kKindsThere[random_.below(kKindsThere.size())]};
    if (!is_asked_for(fault.kind)) return;
    set_time(fault);
    set_way(fault);
    fault.share = random_.chance(0.2) ? 1.0 : random_.share();
    const Nanoseconds steps = (1 + random_.below(2)) * 200 * kMs;
    fault.amount = static_cast<std::int64_t>(random_.between(steps - 20 * kMs, steps + 20 * kMs));
    faults.push_back(fault);
  }

  void add_silence(std::vector<Fault>& faults) {
    const double kind = random_.share();
    if (kind < 0.3) add_mute_controller(faults);
    if (kind >= 0.7) add_lossy_controllers(faults);
    for (std::size_t i = 1 + random_.below(4); i > 0; --i) add_lost_controllers(faults);
    scatter(random_.below(2), faults);
  }

  /// Every controller loses messages of every other one, all the time, so that two of them often
  /// miss each other's plans of the same step.
  void add_lossy_controllers(std::vector<Fault>& faults) {
    if (!is_asked_for(FaultKind::kWithhold)) return;
    Fault fault{.kind = FaultKind::kWithhold,
                .begin = settings_.first,
                .end = settings_.last,
                .share = 0.2 + 0.4 * random_.share()};
    for (const std::uint8_t from : settings_.vehicle_ids) {
      for (const std::uint8_t to : settings_.vehicle_ids) {
        if (from == to) continue;
        fault.process = controller_name(from);
        fault.peer = controller_name(to);
        faults.push_back(fault);
      }
    }
  }

  /// Of two controllers: of both, with losses all the time, or of one, for long.
  void add_lost_controllers(std::vector<Fault>& faults) {
    const auto any_controller = [this] {
      return controller_name(settings_.vehicle_ids[random_.below(settings_.vehicle_ids.size())]);
    };
    const bool is_mutual = random_.chance(0.6);
    Fault fault{.kind = is_mutual ? FaultKind::kWithhold : FaultKind::kCut,
                .begin = settings_.first,
                .end = settings_.last,
                .process = any_controller(),
                .peer = any_controller()};
    if (!is_asked_for(fault.kind) || fault.process == fault.peer) return;
    fault.share = is_mutual ? 0.2 + 0.6 * random_.share() : 1.0;
    if (!is_mutual) fault.begin += random_.below((fault.end - fault.begin) / 2);
    faults.push_back(fault);
    if (!is_mutual) return;
    std::swap(fault.process, fault.peer);
    faults.push_back(fault);
  }

  /// It is suspended for so long that it is believed dead, and no other one receives it any longer.
  void add_mute_controller(std::vector<Fault>& faults) {
    const std::vector<std::uint8_t>& ids = settings_.vehicle_ids;
    const std::uint8_t id = ids[random_.below(ids.size())];
    const Nanoseconds span = settings_.last - settings_.first;
    Fault pause{.kind = FaultKind::kFreeze,
                .begin = settings_.first + random_.below(span / 2),
                .process = controller_name(id)};
    pause.end = std::min(pause.begin + duration(3000 * kMs, 6000 * kMs), settings_.last);
    if (!is_asked_for(FaultKind::kFreeze) || !is_asked_for(FaultKind::kCut)) return;
    faults.push_back(pause);
    for (const std::uint8_t other : ids) {
      if (other == id) continue;
      faults.push_back({.kind = FaultKind::kCut,
                        .begin = pause.begin,
                        .end = settings_.last,
                        .process = controller_name(id),
                        .peer = controller_name(other)});
    }
  }

  [[nodiscard]] bool is_asked_for(FaultKind kind) const {
    return std::ranges::count(settings_.kinds, kind) > 0;
  }

  void add(std::vector<Fault>& faults) {
    Fault fault{.kind = settings_.kinds[random_.below(settings_.kinds.size())]};
    set_time(fault);
    if (is_of_process(fault.kind)) {
      set_process(fault);
    } else {
      set_way(fault);
    }
    set_amount(fault);
    if (excludes_any(fault, faults)) return;
    faults.push_back(fault);
    // Most cuts are of a cable: they affect both directions.
    if (fault.kind != FaultKind::kCut || !random_.chance(0.7)) return;
    std::swap(fault.process, fault.peer);
    faults.push_back(fault);
  }

  /// Short ones as often as long ones: of each order of magnitude.
  Nanoseconds duration(Nanoseconds least, Nanoseconds most) {
    const double share = random_.share();
    const double ratio = static_cast<double>(most) / static_cast<double>(least);
    return static_cast<Nanoseconds>(static_cast<double>(least) * std::pow(ratio, share));
  }

  void set_time(Fault& fault) {
    const bool is_process = is_of_process(fault.kind);
    const Nanoseconds span = settings_.last - settings_.first;
    const Nanoseconds lasts = std::min(
        is_process ? duration(10 * kMs, 8000 * kMs) : duration(50 * kMs, 6000 * kMs), span);
    fault.begin = settings_.first + random_.below(span - lasts + 1);
    if (window_) fault.begin = window_->from + random_.below(window_->until - window_->from + 1);
    fault.end = std::min(fault.begin + lasts, settings_.last);
  }

  std::string any_process(bool with_vehicles, bool with_lab_control) {
    const std::uint8_t id = settings_.vehicle_ids[random_.below(settings_.vehicle_ids.size())];
    if (with_lab_control && random_.chance(0.1)) return kLabControlName;
    switch (random_.below(with_vehicles ? 3 : 2)) {
      case 0:
        return controller_name(id);
      case 1:
        return middleware_name(id);
      default:
        return vehicle_name(id);
    }
  }

  void set_process(Fault& fault) {
    const bool with_vehicles = sets_clock(fault.kind) || random_.chance(0.3);
    fault.process = any_process(with_vehicles, true);
  }

  void set_way(Fault& fault) {
    if (fault.kind == FaultKind::kCut || random_.chance(0.6))
      fault.process = any_process(true, true);
    if (fault.kind == FaultKind::kCut || random_.chance(0.4)) {
      do {
        fault.peer = any_process(true, true);
      } while (fault.peer == fault.process);
    }
    // All processes or none: an overloaded network.
    if (fault.kind == FaultKind::kCut && random_.chance(0.3)) fault.peer.clear();
  }

  std::int64_t either_way(Nanoseconds most) {
    const auto amount = static_cast<std::int64_t>(random_.between(1, most));
    return random_.chance(0.5) ? amount : -amount;
  }

  void set_amount(Fault& fault) {
    const bool is_vehicle = fault.process.starts_with("vehicle");
    switch (fault.kind) {
      case FaultKind::kLose:
      case FaultKind::kWithhold:
      case FaultKind::kRepeat:
      case FaultKind::kReorder:
        fault.share = random_.chance(0.2) ? 1.0 : random_.share();
        fault.amount = static_cast<std::int64_t>(duration(1 * kMs, 400 * kMs));
        break;
      case FaultKind::kDelay:
        fault.amount = static_cast<std::int64_t>(duration(1 * kMs, 400 * kMs));
        break;
      case FaultKind::kStep:
        fault.amount = either_way(is_vehicle ? 2 * kMs : 300 * kMs);
        break;
      case FaultKind::kDrift:
        fault.amount = either_way(is_vehicle ? 200'000 : 2 * kMs);
        break;
      case FaultKind::kFlood:
      case FaultKind::kCut:
      case FaultKind::kKill:
      case FaultKind::kFreeze:
        break;
    }
  }

  static bool excludes_any(const Fault& fault, const std::vector<Fault>& faults) {
    return std::ranges::any_of(faults, [&](const Fault& other) {
      const bool same_resource = (holds_up(fault.kind) && holds_up(other.kind)) ||
                                 (sets_clock(fault.kind) && sets_clock(other.kind));
      return same_resource && fault.process == other.process && fault.begin <= other.end &&
             other.begin <= fault.end;
    });
  }

  SeededRandom random_;
  const FaultPlanSettings& settings_;
  std::optional<Window> window_;
};

}  // namespace

std::span<const FaultKind> all_fault_kinds() { return kKinds; }

std::vector<Fault> draw_faults(std::uint64_t seed, const FaultPlanSettings& settings) {
  if (settings.kinds.empty()) return {};
  return Draw(seed, settings).faults();
}

Nanoseconds end_of(std::span<const Fault> faults) {
  Nanoseconds end = 0;
  for (const Fault& fault : faults) {
    end = std::max(end, fault.end == kForGood ? fault.begin : fault.end);
  }
  return end;
}

}  // namespace hlc::closed_loop
