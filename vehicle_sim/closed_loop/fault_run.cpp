#include "vehicle_sim/closed_loop/fault_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"
#include "vehicle_sim/closed_loop/run_monitor.hpp"
#include "vehicle_sim/closed_loop/simulated_lab.hpp"

namespace hlc::closed_loop {
namespace {

/// Logical time: a run waits for 10 s for each process that is silent, leases are 10 s, and a
/// process without triggers times out after a minute.
constexpr Nanoseconds kLogicalPatience = 180 * kNanosecondsPerSecond;
/// A process that starts when the run is over may wait for the next one without a limit, as
/// vehicles and the lab's controllers do in real time: it ends when it is interrupted.
constexpr Nanoseconds kLateEnd = 5 * kNanosecondsPerSecond;
constexpr Nanoseconds kCheckPeriod = 100 * kNanosecondsPerMillisecond;
/// A process with more iterations in a check period waits for a past event.
constexpr std::uint64_t kMostIterations = 2'000;

Disturbance disturbance_of(const Fault& fault) {
  const auto amount = static_cast<Nanoseconds>(std::max<std::int64_t>(fault.amount, 0));
  Disturbance disturbance{.from = fault.process, .to = fault.peer};
  switch (fault.kind) {
    case FaultKind::kLose:
      disturbance.lost = fault.share;
      break;
    case FaultKind::kWithhold:
      disturbance.withheld = fault.share;
      break;
    case FaultKind::kRepeat:
      disturbance.repeated = fault.share;
      disturbance.repeat_delay = amount;
      break;
    case FaultKind::kReorder:
      disturbance.overtaken = fault.share;
      disturbance.overtake_delay = amount;
      break;
    case FaultKind::kFlood:
      disturbance.flood_hz = static_cast<double>(amount);
      break;
    default:
      disturbance.delay = amount;
      break;
  }
  return disturbance;
}

void begin(const Fault& fault, SimulatedLab& lab) {
  switch (fault.kind) {
    case FaultKind::kCut:
      return lab.network().add(Cut{.from = fault.process, .to = fault.peer});
    case FaultKind::kKill:
      return lab.kill(lab.slot(fault.process));
    case FaultKind::kFreeze:
      return lab.freeze(lab.slot(fault.process));
    case FaultKind::kStep:
      return lab.set_clocks(lab.slot(fault.process), fault.amount, 0);
    case FaultKind::kDrift:
      return lab.set_clocks(lab.slot(fault.process), 0, fault.amount);
    default:
      return lab.network().add(disturbance_of(fault));
  }
}

void finish(const Fault& fault, SimulatedLab& lab) {
  switch (fault.kind) {
    case FaultKind::kCut:
      return lab.network().remove(Cut{.from = fault.process, .to = fault.peer});
    case FaultKind::kKill:
      return lab.restart(lab.slot(fault.process));
    case FaultKind::kFreeze:
      return lab.resume(lab.slot(fault.process));
    case FaultKind::kStep:
      return lab.set_clocks(lab.slot(fault.process), -fault.amount, 0);
    case FaultKind::kDrift:
      return lab.set_clocks(lab.slot(fault.process), 0, -fault.amount);
    default:
      return lab.network().remove(disturbance_of(fault));
  }
}

class FaultRun {
 public:
  FaultRun(const scenario::Scenario& scenario, const FaultRunSettings& settings, const Trace& trace,
           RunDiary* diary)
      : settings_(settings),
        calm_from_(end_of(settings.faults)),
        monitor_(scenario, calm_from_, trace),
        writer_(monitor_, diary),
        lab_(scenario, settings.lab, writer_) {
    monitor_.attach(lab_);
    writer_.attach(lab_);
    if (settings.keeps_records) monitor_.keep_records();
    lab_.on_change = [this](const ProcessSlot& slot) {
      writer_.changed(slot);
      monitor_.changed(slot);
    };
    lab_.pose_of = [this](std::uint8_t vehicle) { return monitor_.pose_of(vehicle); };
    for (std::uint32_t i = 0; i < settings.faults.size(); ++i) {
      lab_.set_alarm(settings.faults[i].begin, 2 * i);
      if (settings.faults[i].end != kForGood) lab_.set_alarm(settings.faults[i].end, 2 * i + 1);
    }
    lab_.set_alarm(kCheckPeriod, kCheck);
  }

  FaultRunResult drive() {
    while (!is_over_ && !lab_.has_ended()) {
      const std::optional<std::uint32_t> alarm = lab_.step();
      if (alarm == kCheck) {
        check();
      } else if (alarm) {
        change(settings_.faults[*alarm / 2], *alarm % 2 == 0);
      }
    }
    return monitor_.result();
  }

 private:
  static constexpr std::uint32_t kCheck = ~std::uint32_t{0};

  void change(const Fault& fault, bool begins) {
    monitor_.trace([&] { return (begins ? "begin of " : "end of ") + to_string(fault); });
    begins ? begin(fault, lab_) : finish(fault, lab_);
    if (!begins || (fault.kind != FaultKind::kKill && fault.kind != FaultKind::kFreeze)) return;
    monitor_.held_up(lab_.slot(fault.process));
    if (fault.kind == FaultKind::kKill) monitor_.killed(lab_.slot(fault.process));
  }

  void check() {
    lab_.set_alarm(lab_.now() + kCheckPeriod, kCheck);
    monitor_.check_ticks();
    check_waits();
    if (settings_.lab.is_logical) {
      if (lab_.now() >= calm_from_ + kLogicalPatience) expect_all_ended();
      return;
    }
    if (!is_planning_checked_ && !interrupted_at_ &&
        lab_.now() >= calm_from_ + PlanningCheck::kPatience) {
      is_planning_checked_ = true;
      monitor_.check_planning(able_vehicles());
    }
    if (interrupted_at_) {
      const Nanoseconds last = std::max(*interrupted_at_, calm_from_) + settings_.leave_time;
      if (lab_.now() >= last - kLateEnd) interrupt_late_starters();
      if (lab_.now() >= last) expect_all_ended();
    } else if (lab_.now() >= settings_.interrupt_at.value_or(calm_from_ + settings_.calm)) {
      interrupt();
    }
  }

  /// No process polls for a past event; and in real time every running process has a wake-up time
  /// without messages. (In logical time a controller waits for its
  /// middleware alone, whose waits end.)
  void check_waits() {
    for (ProcessSlot& slot : lab_.slots()) {
      const std::uint64_t iterations = std::exchange(slot.num_iterations, 0);
      if (!slot.process || slot.is_frozen) continue;
      if (iterations > kMostIterations) {
        monitor_.report_violation(slot.name + " spins: " + std::to_string(iterations) +
                                  " iterations in 0.1 s");
      }
      if (slot.planned_iteration == kNever && !settings_.lab.is_logical) {
        monitor_.report_violation(slot.name + " waits without an end");
      }
    }
  }

  /// Vehicles whose processes are all present. Without the lab control all make a minimal-risk
  /// stop, and an experiment that has not begun does not begin while a process is missing.
  /// The next lab control starts nothing before all have come back: those on standby wait for that
  /// start if nobody is left whose run they can join.
  [[nodiscard]] std::vector<std::uint8_t> able_vehicles() {
    std::vector<std::uint8_t> able;
    std::vector<std::uint8_t> waiting;
    const bool is_complete_lab = std::ranges::all_of(
        lab_.slots(), [](const ProcessSlot& slot) { return slot.process != nullptr; });
    if (!lab_.slots().front().process || !(is_complete_lab || monitor_.has_begun())) return able;
    if (!monitor_.has_begun() && may_lose_start()) return able;
    for (const ProcessSlot& slot : lab_.slots()) {
      const std::uint8_t id = slot.key.vehicle;
      const bool is_complete = std::ranges::all_of(lab_.slots(), [id](const ProcessSlot& one) {
        return one.key.vehicle != id || one.process;
      });
      if (slot.key.role != Role::kVehicle || !is_complete) continue;
      const bool waits_for_start = is_lab_control_killed() && monitor_.is_on_standby(id);
      (waits_for_start ? waiting : able).push_back(id);
    }
    if (!able.empty()) able.insert(able.end(), waiting.begin(), waiting.end());
    return able;
  }

  [[nodiscard]] bool is_lab_control_killed() const {
    return std::ranges::any_of(settings_.faults, [](const Fault& fault) {
      return fault.kind == FaultKind::kKill && fault.process == kLabControlName;
    });
  }

  /// Nobody begins if the start trigger is lost for good.
  [[nodiscard]] bool may_lose_start() const {
    return std::ranges::any_of(settings_.faults, [](const Fault& fault) {
      return fault.kind == FaultKind::kWithhold || fault.kind == FaultKind::kKill;
    });
  }

  void interrupt() {
    interrupted_at_ = lab_.now();
    monitor_.trace([] { return std::string("the run is interrupted"); });
    lab_.interrupt(lab_.slots().front());
  }

  void interrupt_late_starters() {
    for (const Fault& fault : settings_.faults) {
      const bool starts = fault.kind == FaultKind::kKill && fault.end >= *interrupted_at_;
      if (starts && fault.end != kForGood) lab_.interrupt(lab_.slot(fault.process));
    }
  }

  void expect_all_ended() {
    is_over_ = true;
    for (const ProcessSlot& slot : lab_.slots()) {
      if (slot.process) monitor_.report_violation(slot.name + " does not end");
    }
  }

  const FaultRunSettings& settings_;
  Nanoseconds calm_from_;
  RunMonitor monitor_;
  DiaryWriter writer_;
  SimulatedLab lab_;
  std::optional<Nanoseconds> interrupted_at_;
  bool is_planning_checked_{};
  bool is_over_{};
};

}  // namespace

FaultRunResult run_with_faults(const scenario::Scenario& scenario, const FaultRunSettings& settings,
                               const Trace& trace, RunDiary* diary) {
  return FaultRun(scenario, settings, trace, diary).drive();
}

}  // namespace hlc::closed_loop
