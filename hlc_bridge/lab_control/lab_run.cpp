#include "hlc_bridge/lab_control/lab_run.hpp"

#include <algorithm>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += (line.empty() ? "" : ", ") + word;
  }
  return line;
}

std::string seconds(Nanoseconds time) {
  return std::to_string(time / kNanosecondsPerSecond) + " s";
}

std::string deaths_line(const std::vector<Death>& deaths) {
  std::vector<std::string> names;
  for (const Death& death : deaths) {
    names.push_back(death.process);
  }
  return "died: " + join(names);
}

}  // namespace

LabRun::LabRun(LabRunSettings settings) : settings_{std::move(settings)} {
  for (const std::uint8_t id : settings_.vehicle_ids) {
    for (const std::string& name : {vehicle_name(id), middleware_name(id), controller_name(id)}) {
      processes_.push_back(name);
    }
  }
}

void LabRun::presence(const std::set<std::string>& alive, const std::set<std::string>& lost) {
  alive_ = alive;
  lost_ = lost;
}

void LabRun::report(const ReportRecord& record) {
  const auto& ids = settings_.vehicle_ids;
  const std::uint8_t id = record.report.vehicle.value;
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
    return;
  }
  const std::uint64_t step = record.report.step.value;
  std::uint64_t& last_step = last_reports_.try_emplace(id, step).first->second;
  last_step = std::max(last_step, step);
  just_received_.insert(id);
  note_progress();
  if (record.report.status != StepStatus::kStandby) {
    driving_.insert(id);
    result_.first_step = std::min(result_.first_step.value_or(step), step);
  }
}

std::optional<std::uint64_t> LabRun::last_report(std::uint8_t vehicle_id) const {
  const auto found = last_reports_.find(vehicle_id);
  return found == last_reports_.end() ? std::nullopt : std::optional{found->second};
}

Nanoseconds LabRun::last_received(std::uint8_t vehicle_id) const {
  const auto found = last_received_.find(vehicle_id);
  return found == last_received_.end() ? 0 : found->second;
}

void LabRun::interrupt() {
  end_asked_ = true;
  fail(kExitInterrupted, "interrupted");
}

void LabRun::stop_requested(std::uint8_t vehicle_id) {
  end_asked_ = true;
  fail(kExitDied, controller_name(vehicle_id) + " requested the stop");
}

LabRunActions LabRun::advance(Nanoseconds now) {
  LabRunActions actions;
  if (finished()) {
    return actions;
  }
  now_ = std::max(now_, now);
  for (const std::uint8_t id : std::exchange(just_received_, {})) {
    last_received_[id] = now_;
  }
  if (!started_ || progress_) {
    last_progress_ = now_;
    progress_ = false;
  }
  if (!started_) {
    started_ = true;
    gathering_since_ = now_;
  }
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
    phase_ = Phase::kFinished;
    if (result_.reason.empty() && !result_.deaths.empty()) {
      result_.reason = deaths_line(result_.deaths);
    }
    return actions;
  }
  go_on(actions);
  return actions;
}

void LabRun::gather(LabRunActions& actions) {
  for (const std::string& process : processes_) {
    if (lost_.count(process) != 0) {
      drop(process);
    }
  }
  const bool too_late = now_ - gathering_since_ >= settings_.startup_timeout;
  if (!end_asked_ && unreached_timers().empty() && not_ready().empty()) {
    phase_ = Phase::kRunning;
    began_ = now_;
    began_clock_ = clock();
    last_progress_ = now_;
    actions.run_state = RunPhase::kRunning;
  } else if (end_asked_ || too_late) {
    fail(kExitMissing, "after " + seconds(settings_.startup_timeout) + ": " + waiting_for());
    actions.triggers.push_back(kStopSymbol);
    phase_ = Phase::kFinished;
  }
}

std::vector<std::string> LabRun::unreached_timers() const {
  std::vector<std::string> names;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    for (const std::string& name : {vehicle_name(id), middleware_name(id)}) {
      if (trigger_readers_.count(name) == 0) {
        names.push_back(name);
      }
    }
  }
  return names;
}

bool LabRun::is_back(const std::string& process) const {
  if (alive_.count(process) == 0 || lost_.count(process) != 0) return false;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    if (process == controller_name(id)) return last_received(id) > died_at_.at(process);
  }
  return true;
}

void LabRun::update_returns(LabRunActions& actions) {
  if (settings_.on_death != OnDeath::kContinue || phase_ != Phase::kRunning) {
    return;
  }
  const std::set<std::string> gone = dropped_;
  for (const std::string& process : gone) {
    if (is_back(process)) {
      dropped_.erase(process);
      on_return(process);
      actions.returns.push_back(process);
    }
  }
}

void LabRun::update_deaths(LabRunActions& actions) {
  for (const std::string& process : processes_) {
    if (lost_.count(process) != 0) {
      mark_dead(process, "participant left or lease expired", actions);
    }
  }
  for (const Death& death : overdue()) {
    mark_dead(death.process, death.sign, actions);
  }
  const std::vector<std::string> pending = pending_replies();
  if (!pending.empty() && now_ - last_progress_ >= kAnswerTimeout) {
    for (const std::string& process : pending) {
      mark_dead(process, "answer overdue", actions);
    }
    last_progress_ = now_;
  }
}

void LabRun::mark_dead(const std::string& process, const std::string& sign,
                       LabRunActions& actions) {
  if (!dropped_.insert(process).second) {
    return;
  }
  drop(process);
  const bool is_expected_exit = phase_ == Phase::kBraking && lost_.count(process) != 0;
  if (is_expected_exit) {
    return;
  }
  actions.deaths.push_back({process, sign});
  record_death({process, sign});
  died_at_[process] = now_;
  if (settings_.on_death == OnDeath::kContinue) {
    return;
  }
  fail(kExitDied, "");
  if (phase_ == Phase::kRunning) {
    phase_ = Phase::kMinimalRiskStop;
    minimal_risk_stop_since_ = clock() == kNever ? 0 : clock();
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
  if (end_asked_) {
    stop(actions);
  } else if (clock() >= phase_end()) {
    if (phase_ == Phase::kRunning && !result_.first_step) {
      fail(kExitMissing, standby_line());
    }
    if (phase_ == Phase::kRunning && driving_.size() < settings_.vehicle_ids.size()) {
      fail(kExitMissing, "still on standby at the end: " + join(on_standby()) + "; see its log");
    }
    if (settings_.on_death == OnDeath::kContinue && !dropped_.empty()) {
      fail(kExitDied, "died and not back: " + join({dropped_.begin(), dropped_.end()}));
    }
    stop(actions);
  }
}

void LabRun::stop(LabRunActions& actions) {
  result_.wall = last_progress_ - began_;
  result_.clock = clock() == kNever ? 0 : clock() - began_clock_;
  braking_since_ = clock() == kNever ? 0 : clock();
  braking_since_wall_ = now_;
  phase_ = Phase::kBraking;
  actions.triggers.push_back(kStopSymbol);
  for (const std::uint8_t id : settings_.vehicle_ids) {
    for (const std::string& process : {middleware_name(id), controller_name(id)}) {
      dropped_.insert(process);
      drop(process);
    }
  }
}

Nanoseconds LabRun::phase_end() const {
  switch (phase_) {
    case Phase::kRunning:
      return result_.first_step ? (*result_.first_step + settings_.steps + 1) * settings_.period
                                : began_clock_ + kStandbyTimeout;
    case Phase::kMinimalRiskStop:
      return minimal_risk_stop_since_ + kMinimalRiskStopTime;
    case Phase::kBraking:
      if (result_.exit_code == kExitInterrupted && now_ - braking_since_wall_ >= kInterruptTime) {
        return 0;
      }
      return braking_since_ + kBrakingTime;
    case Phase::kGathering:
    case Phase::kFinished:
      break;
  }
  return kNever;
}

Nanoseconds LabRun::wake_up() const {
  if (phase_ == Phase::kGathering) {
    return gathering_since_ + settings_.startup_timeout;
  }
  Nanoseconds time = wall_time_of(phase_end());
  if (!pending_replies().empty()) {
    time = std::min(time, last_progress_ + kAnswerTimeout);
  }
  time = std::min(time, next_overdue());
  if (phase_ == Phase::kBraking && result_.exit_code == kExitInterrupted) {
    time = std::min(time, braking_since_wall_ + kInterruptTime);
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
  std::vector<std::string> absent;
  for (const std::string& process : processes_) {
    if (alive_.count(process) == 0 || lost_.count(process) != 0) {
      absent.push_back(process);
    }
  }
  std::vector<std::string> waiting;
  for (const std::string& what : not_ready()) {
    if (std::find(absent.begin(), absent.end(), what) == absent.end()) {
      waiting.push_back(what);
    }
  }
  const std::vector<std::string> unreached = unreached_timers();
  if (absent.empty() && waiting.empty() && !unreached.empty()) {
    waiting.push_back("triggers, not yet matched by " + join(unreached));
  }
  std::string line;
  if (!absent.empty()) {
    line += "missing: " + join(absent);
  }
  if (!waiting.empty()) {
    line += (absent.empty() ? "" : "; ") + ("not ready: " + join(waiting));
  }
  return line;
}

std::vector<std::string> LabRun::on_standby() const {
  std::vector<std::string> names;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    if (!has_left_standby(id)) names.push_back(controller_name(id));
  }
  return names;
}

std::string LabRun::standby_line() const {
  std::vector<std::string> names;
  for (const std::uint8_t id : settings_.vehicle_ids) {
    names.push_back(controller_name(id) + (last_report(id) ? "" : " (silent)"));
  }
  return "no vehicle left standby within " + seconds(kStandbyTimeout) + ": " + join(names) +
         "; check that every vehicle's state is valid";
}

}  // namespace hlc
