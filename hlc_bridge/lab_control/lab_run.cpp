#include "hlc_bridge/lab_control/lab_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {
namespace {

std::string deaths_line(const std::vector<Death>& deaths) {
  std::vector<std::string> names;
  for (const Death& death : deaths) {
    names.push_back(death.process);
  }
  return fmt::format("died: {}", fmt::join(names, ", "));
}

std::vector<std::string> controller_names(const std::vector<std::uint8_t>& ids) {
  std::vector<std::string> names;
  for (const std::uint8_t id : ids) names.push_back(controller_name(id));
  return names;
}

}  // namespace

LabRun::LabRun(LabRunSettings settings)
    : settings_{std::move(settings)},
      attendance_{settings_.vehicle_ids, settings_.guest_ids},
      reports_{settings_.vehicle_ids},
      standing_{settings_.period} {}

void LabRun::report(const ReportRecord& record) {
  if (!reports_.add(record)) return;
  result_.first_step = reports_.first_step();
  const std::uint64_t step = record.report.step.value;
  if (result_.first_step && step < *result_.first_step + settings_.steps) {
    standing_.add(record.report, {*result_.first_step});
  }
  note_progress();
}

void LabRun::interrupt() {
  is_end_requested_ = true;
  fail(kExitInterrupted, "interrupted");
}

void LabRun::stop_requested(std::uint8_t vehicle_id) {
  is_end_requested_ = true;
  fail(kExitDied, controller_name(vehicle_id) + " requested the stop");
}

LabRunActions LabRun::advance(Nanoseconds now) {
  LabRunActions actions;
  if (finished()) {
    return actions;
  }
  note_time(now);
  actions.stuck = standing_.take_stuck();
  actions.arrived = standing_.take_arrived();
  if (phase_ == Phase::kGathering) {
    gather(actions);
  }
  if (phase_ == Phase::kGathering || finished()) {
    return actions;
  }
  update_returns(actions);
  update_deaths(actions);
  leave_running_phases(actions);
  if (phase_ == Phase::kBraking && clock() >= phase_end()) {
    enter(Phase::kFinished);
    if (result_.reason.empty() && !result_.deaths.empty()) {
      result_.reason = deaths_line(result_.deaths);
    }
    return actions;
  }
  go_on(actions);
  return actions;
}

void LabRun::note_time(Nanoseconds now) {
  now_ = std::max(now_, now);
  reports_.stamp(now_);
  if (!started_ || progress_) last_progress_ = now_;
  if (!started_) phase_since_.wall = now_;
  progress_ = false;
  started_ = true;
}

void LabRun::enter(Phase phase) {
  phase_ = phase;
  phase_since_ = {.wall = now_, .clock = clock() == kNever ? 0 : clock()};
}

void LabRun::gather(LabRunActions& actions) {
  for (const std::string& process : attendance_.lost()) drop(process);
  const bool too_late = now_ - phase_since_.wall >= settings_.startup_timeout;
  if (!is_end_requested_ && attendance_.unreached_timers().empty() && not_ready().empty()) {
    enter(Phase::kRunning);
    running_since_ = phase_since_;
    last_progress_ = now_;
    actions.run_state = RunPhase::kRunning;
  } else if (is_end_requested_ || too_late) {
    fail(kExitMissing,
         fmt::format("after {} s: {}", settings_.startup_timeout / kNanosecondsPerSecond,
                     waiting_for()));
    actions.triggers.push_back(kStopSymbol);
    enter(Phase::kFinished);
  }
}

bool LabRun::is_back(const std::string& process) const {
  if (!attendance_.is_there(process)) return false;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    if (process == controller_name(id)) {
      return reports_.last_received(id) > attendance_.died_at(process) && !is_drive_overdue(id);
    }
  }
  return true;
}

std::vector<std::string> LabRun::silent_among(const std::vector<std::string>& pending) const {
  std::vector<std::string> absent;
  for (const std::string& process : pending) {
    if (!attendance_.is_there(process)) absent.push_back(process);
  }
  return absent.empty() ? pending : absent;
}

void LabRun::update_returns(LabRunActions& actions) {
  if (settings_.on_death != OnDeath::kContinue || phase_ != Phase::kRunning) {
    return;
  }
  const std::set<std::string> gone = attendance_.dropped();
  for (const std::string& process : gone) {
    if (is_back(process)) {
      attendance_.take_back(process);
      on_return(process);
      actions.returns.push_back(process);
    }
  }
}

void LabRun::update_deaths(LabRunActions& actions) {
  for (const std::string& process : attendance_.lost()) {
    mark_dead(process, "participant left or lease expired", actions);
  }
  for (const Death& death : overdue()) {
    mark_dead(death.process, death.sign, actions);
  }
  const std::vector<std::string> pending = pending_replies();
  if (!pending.empty() && now_ - last_progress_ >= kAnswerTimeout) {
    for (const std::string& process : silent_among(pending)) {
      mark_dead(process, "answer overdue", actions);
    }
    last_progress_ = now_;
  }
}

void LabRun::mark_dead(const std::string& process, const std::string& sign,
                       LabRunActions& actions) {
  if (!attendance_.drop(process)) {
    return;
  }
  drop(process);
  const bool is_expected_exit = phase_ == Phase::kBraking && attendance_.is_lost(process);
  if (is_expected_exit) {
    return;
  }
  actions.deaths.push_back({process, sign});
  record_death({process, sign});
  attendance_.died(process, now_);
  if (settings_.on_death == OnDeath::kContinue) {
    return;
  }
  fail(kExitDied, "");
  if (phase_ == Phase::kRunning) {
    enter(Phase::kMinimalRiskStop);
    actions.run_state = RunPhase::kMinimalRiskStop;
  }
}

void LabRun::record_death(const Death& death) {
  auto place = result_.deaths.end();
  for (const std::uint8_t id : settings_.vehicle_ids) {
    if (death.process == middleware_name(id)) {
      place = std::find_if(result_.deaths.begin(), result_.deaths.end(), [&](const Death& other) {
        return other.process == controller_name(id);
      });
    }
  }
  result_.deaths.insert(place, death);
}

void LabRun::leave_running_phases(LabRunActions& actions) {
  if (phase_ != Phase::kRunning && phase_ != Phase::kMinimalRiskStop) {
    return;
  }
  if (is_end_requested_) {
    stop(actions);
  } else if (clock() >= phase_end()) {
    if (phase_ == Phase::kRunning && !result_.first_step) {
      fail(kExitMissing, standby_line());
    }
    const std::vector<std::uint8_t> standing = reports_.on_standby();
    if (phase_ == Phase::kRunning && !standing.empty()) {
      fail(kExitMissing, fmt::format("still on standby at the end: {}; see its log",
                                     fmt::join(controller_names(standing), ", ")));
    }
    const std::set<std::string>& gone = attendance_.dropped();
    if (settings_.on_death == OnDeath::kContinue && !gone.empty()) {
      fail(kExitDied, fmt::format("died and not back: {}", fmt::join(gone, ", ")));
    }
    if (const std::string stuck = standing_.stuck_line();
        phase_ == Phase::kRunning && !stuck.empty()) {
      fail(kExitStuck, stuck);
    }
    stop(actions);
  }
}

void LabRun::stop(LabRunActions& actions) {
  result_.wall = last_progress_ - running_since_.wall;
  result_.clock = clock() == kNever ? 0 : clock() - running_since_.clock;
  enter(Phase::kBraking);
  actions.triggers.push_back(kStopSymbol);
  for (const std::uint8_t id : settings_.vehicle_ids) {
    for (const std::string& process : {middleware_name(id), controller_name(id)}) {
      attendance_.drop(process);
      drop(process);
    }
  }
}

Nanoseconds LabRun::phase_end() const {
  switch (phase_) {
    case Phase::kRunning:
      return result_.first_step ? (*result_.first_step + settings_.steps + 1) * settings_.period
                                : phase_since_.clock + kStandbyTimeout;
    case Phase::kMinimalRiskStop:
      return phase_since_.clock + kMinimalRiskStopTime;
    case Phase::kBraking:
      if (result_.exit_code == kExitInterrupted && now_ - phase_since_.wall >= kInterruptTime) {
        return 0;
      }
      return phase_since_.clock + kBrakingTime;
    case Phase::kGathering:
    case Phase::kFinished:
      break;
  }
  return kNever;
}

Nanoseconds LabRun::wake_up() const {
  if (phase_ == Phase::kGathering) {
    return phase_since_.wall + settings_.startup_timeout;
  }
  Nanoseconds time = wall_time_of(phase_end());
  if (!pending_replies().empty()) {
    time = std::min(time, last_progress_ + kAnswerTimeout);
  }
  time = std::min(time, next_overdue());
  if (phase_ == Phase::kBraking && result_.exit_code == kExitInterrupted) {
    time = std::min(time, phase_since_.wall + kInterruptTime);
  }
  return time;
}

std::uint64_t LabRun::steps_begun() const {
  if (!result_.first_step || clock() == kNever) {
    return 0;
  }
  const std::uint64_t step = step_at(clock(), settings_.period);
  return std::min(step - std::min(step, *result_.first_step), settings_.steps);
}

void LabRun::fail(int exit_code, const std::string& reason) {
  if (result_.exit_code == kExitGood) {
    result_.exit_code = exit_code;
    result_.reason = reason;
  }
}

std::string LabRun::waiting_for() const {
  const std::vector<std::string> absent = attendance_.absent();
  std::vector<std::string> waiting;
  for (const std::string& what : not_ready()) {
    if (std::find(absent.begin(), absent.end(), what) == absent.end()) {
      waiting.push_back(what);
    }
  }
  const std::vector<std::string> unreached = attendance_.unreached_timers();
  if (absent.empty() && waiting.empty() && !unreached.empty()) {
    waiting.push_back(fmt::format("triggers, not yet matched by {}", fmt::join(unreached, ", ")));
  }
  std::vector<std::string> parts;
  if (!absent.empty()) parts.push_back(fmt::format("missing: {}", fmt::join(absent, ", ")));
  if (!waiting.empty()) parts.push_back(fmt::format("not ready: {}", fmt::join(waiting, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string LabRun::standby_line() const {
  std::vector<std::string> names;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    names.push_back(controller_name(id) + (reports_.last(id) ? "" : " (silent)"));
  }
  return fmt::format(
      "no vehicle left standby within {} s: {}; check that every vehicle's state is valid",
      kStandbyTimeout / kNanosecondsPerSecond, fmt::join(names, ", "));
}

}  // namespace hlc::lab_control
