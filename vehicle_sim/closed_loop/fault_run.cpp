#include "vehicle_sim/closed_loop/fault_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "vehicle_sim/closed_loop/run_judges.hpp"
#include "vehicle_sim/closed_loop/simulated_lab.hpp"

namespace hlc::closed_loop {
namespace {

/// After the interruption all have left: vehicles brake for a second; a vehicle without lab control
/// stays for kVehicleStays after the lease.
constexpr Nanoseconds kLeaveTime = 10 * kNanosecondsPerSecond;
/// Logical time: a run waits for 10 s for each process that is silent, leases are 10 s, and a
/// process without triggers times out after a minute.
constexpr Nanoseconds kLogicalPatience = 180 * kNanosecondsPerSecond;
constexpr Nanoseconds kCheckPeriod = 100 * kNanosecondsPerMillisecond;
/// A process with more turns in a check period waits for a past event.
constexpr std::uint64_t kMostTurns = 2'000;

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
      return lab.kill(lab.seat(fault.process));
    case FaultKind::kFreeze:
      return lab.freeze(lab.seat(fault.process));
    case FaultKind::kStep:
      return lab.set_clocks(lab.seat(fault.process), fault.amount, 0);
    case FaultKind::kDrift:
      return lab.set_clocks(lab.seat(fault.process), 0, fault.amount);
    default:
      return lab.network().add(disturbance_of(fault));
  }
}

void finish(const Fault& fault, SimulatedLab& lab) {
  switch (fault.kind) {
    case FaultKind::kCut:
      return lab.network().remove(Cut{.from = fault.process, .to = fault.peer});
    case FaultKind::kKill:
      return lab.restart(lab.seat(fault.process));
    case FaultKind::kFreeze:
      return lab.thaw(lab.seat(fault.process));
    case FaultKind::kStep:
      return lab.set_clocks(lab.seat(fault.process), -fault.amount, 0);
    case FaultKind::kDrift:
      return lab.set_clocks(lab.seat(fault.process), 0, -fault.amount);
    default:
      return lab.network().remove(disturbance_of(fault));
  }
}

class FaultRun {
 public:
  FaultRun(const scenario::Scenario& scenario, const FaultRunSettings& settings, const Trace& trace)
      : settings_(settings),
        calm_from_(end_of(settings.faults)),
        judges_(scenario, calm_from_, trace),
        lab_(scenario, settings.lab, judges_) {
    judges_.attach(lab_);
    lab_.on_change = [this](const Seat& seat) { judges_.changed(seat); };
    lab_.pose_of = [this](std::uint8_t vehicle) { return judges_.pose_of(vehicle); };
    for (std::uint32_t i = 0; i < settings.faults.size(); ++i) {
      lab_.set_alarm(settings.faults[i].begin, 2 * i);
      lab_.set_alarm(settings.faults[i].end, 2 * i + 1);
    }
    lab_.set_alarm(kCheckPeriod, kCheck);
  }

  FaultRunResult drive() {
    while (!is_over_ && !lab_.is_deserted()) {
      const std::optional<std::uint32_t> alarm = lab_.step();
      if (alarm == kCheck) {
        check();
      } else if (alarm) {
        change(settings_.faults[*alarm / 2], *alarm % 2 == 0);
      }
    }
    return judges_.result();
  }

 private:
  static constexpr std::uint32_t kCheck = ~std::uint32_t{0};

  void change(const Fault& fault, bool begins) {
    judges_.trace([&] { return (begins ? "begin of " : "end of ") + to_string(fault); });
    begins ? begin(fault, lab_) : finish(fault, lab_);
    if (!begins || (fault.kind != FaultKind::kKill && fault.kind != FaultKind::kFreeze)) return;
    judges_.held_up(lab_.seat(fault.process));
    if (fault.kind == FaultKind::kKill) judges_.killed(lab_.seat(fault.process));
  }

  void check() {
    lab_.set_alarm(lab_.now() + kCheckPeriod, kCheck);
    judges_.judge_ticks();
    check_waits();
    if (settings_.lab.is_logical) {
      if (lab_.now() >= calm_from_ + kLogicalPatience) expect_nobody();
      return;
    }
    if (!is_planning_judged_ && lab_.now() >= calm_from_ + PlanningCheck::kPatience) {
      is_planning_judged_ = true;
      judges_.judge_planning(able_vehicles());
    }
    if (!interrupted_at_ && lab_.now() >= calm_from_ + settings_.calm) interrupt();
    if (interrupted_at_ && lab_.now() >= *interrupted_at_ + kLeaveTime) expect_nobody();
  }

  /// No process polls for a past event; and in real time every running process has a wake-up time
  /// without messages. (In logical time a controller waits for its
  /// middleware alone, whose waits end.)
  void check_waits() {
    for (Seat& seat : lab_.seats()) {
      const std::uint64_t turns = std::exchange(seat.num_turns, 0);
      if (!seat.process || seat.is_frozen) continue;
      if (turns > kMostTurns) {
        judges_.report_violation(seat.name + " spins: " + std::to_string(turns) +
                                 " turns in 0.1 s");
      }
      if (seat.planned_turn == kNoTurn && !settings_.lab.is_logical) {
        judges_.report_violation(seat.name + " waits without an end");
      }
    }
  }

  /// Vehicles whose processes are all present. Without the lab control all make a minimal-risk
  /// stop, and an experiment that has not begun does not begin while a process is missing.
  [[nodiscard]] std::vector<std::uint8_t> able_vehicles() {
    std::vector<std::uint8_t> able;
    const bool is_complete_lab =
        std::ranges::all_of(lab_.seats(), [](const Seat& seat) { return seat.process != nullptr; });
    if (!lab_.seats().front().process || !(is_complete_lab || judges_.has_begun())) return able;
    if (!judges_.has_begun() && may_lose_start()) return able;
    for (const Seat& seat : lab_.seats()) {
      const std::uint8_t id = seat.key.vehicle;
      const bool is_complete = std::ranges::all_of(
          lab_.seats(), [id](const Seat& one) { return one.key.vehicle != id || one.process; });
      if (seat.key.role == Role::kVehicle && is_complete) able.push_back(id);
    }
    return able;
  }

  /// Nobody begins if the start trigger is lost for good.
  [[nodiscard]] bool may_lose_start() const {
    return std::ranges::any_of(settings_.faults, [](const Fault& fault) {
      return fault.kind == FaultKind::kWithhold || fault.kind == FaultKind::kKill;
    });
  }

  void interrupt() {
    interrupted_at_ = lab_.now();
    judges_.trace([] { return std::string("the run is interrupted"); });
    lab_.interrupt(lab_.seats().front());
  }

  void expect_nobody() {
    is_over_ = true;
    for (const Seat& seat : lab_.seats()) {
      if (seat.process) judges_.report_violation(seat.name + " does not end");
    }
  }

  const FaultRunSettings& settings_;
  Nanoseconds calm_from_;
  RunJudges judges_;
  SimulatedLab lab_;
  std::optional<Nanoseconds> interrupted_at_;
  bool is_planning_judged_{};
  bool is_over_{};
};

}  // namespace

FaultRunResult run_with_faults(const scenario::Scenario& scenario, const FaultRunSettings& settings,
                               const Trace& trace) {
  return FaultRun(scenario, settings, trace).drive();
}

}  // namespace hlc::closed_loop
