#include "hlc_bridge/lab_control/lab_control_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"

namespace hlc::lab_control {
namespace {

static_assert(machine::Machine<LabControlMachine>);

constexpr double kSecondsPerNanosecond = 1e-9;

}  // namespace

void LabControlMachine::on(Event event) {
  std::visit([this](auto& what) { take(std::move(what)); }, event);
}

void LabControlMachine::take(ReportRecord record) {
  run_->report(record);
  replies_.emplace_back(std::move(record));
}

void LabControlMachine::take(const ParameterRequest& request) {
  const LabRunSettings& settings = run_->settings();
  if (request.name == kPeriodParameter) {
    replies_.emplace_back(Parameter{request.name, settings.period / kNanosecondsPerMillisecond});
  } else if (request.name == kActiveIdsParameter) {
    const std::vector<std::uint8_t> ids = settings.all_ids();
    replies_.emplace_back(
        Parameter{request.name, std::vector<std::int32_t>(ids.begin(), ids.end())});
  }
}

void LabControlMachine::take(LabControlPresence presence) {
  run_->presence(presence.participants.alive, presence.participants.lost);
  num_trigger_readers_ = presence.trigger_readers.count;
  run_->trigger_readers(std::move(presence.trigger_readers.names));
}

std::vector<LabControlMachine::Action> LabControlMachine::advance(const Instant& now) {
  Actions actions = std::exchange(replies_, {});
  if (!run_->finished()) append(run_->advance(run_->time_of(now)), now.wall, actions);
  if (run_->finished()) {
    leave(now.wall);
  } else {
    show_progress(now.wall, actions);
  }
  return actions;
}

void LabControlMachine::append(const LabRunActions& todo, Nanoseconds wall, Actions& actions) {
  for (const Death& death : todo.deaths) {
    const std::string line = death.process + " died: " + death.sign;
    actions.emplace_back(machine::error(line));
    actions.emplace_back(Log{.id = kLabControlName, .content = line, .level = 1});
  }
  for (const std::string& process : todo.returns) {
    actions.emplace_back(machine::info(process + " is back"));
  }
  for (const std::string& line : todo.stuck) actions.emplace_back(machine::warning(line));
  for (const std::string& line : todo.arrived) actions.emplace_back(machine::info(line));
  if (todo.run_state) {
    actions.emplace_back(RunState{.phase = *todo.run_state, .start = run_->start()});
  }
  for (const Nanoseconds trigger : todo.triggers) {
    if (!began_) began_ = wall;
    actions.emplace_back(SystemTrigger{.next_start = trigger});
  }
}

void LabControlMachine::show_progress(Nanoseconds wall, Actions& actions) {
  if (!progress_.is_due(wall)) return;
  if (run_->phase() == LabRun::Phase::kGathering) {
    actions.emplace_back(ProgressText{"waiting: " + run_->waiting_for()});
    return;
  }
  const LabRunSettings& settings = run_->settings();
  const std::uint64_t steps = run_->steps_begun();
  const double driven_s =
      static_cast<double>(steps) * static_cast<double>(settings.period) * kSecondsPerNanosecond;
  const double wall_s = static_cast<double>(wall - began_.value_or(wall)) * kSecondsPerNanosecond;
  actions.emplace_back(ProgressText{fmt::format("step {} of {}, {:.1f} s driven in {:.1f} s", steps,
                                                settings.steps, driven_s, wall_s)});
}

void LabControlMachine::leave(Nanoseconds wall) {
  if (!leaves_at_) {
    const bool in_a_hurry = run_->result().exit_code == kExitInterrupted;
    leaves_at_ = wall + (in_a_hurry ? kHurriedLeaveTime : kLeaveTime);
  }
  if (num_trigger_readers_ == 0 || wall >= *leaves_at_) exit_code_ = run_->result().exit_code;
}

WakeUp LabControlMachine::wake_up() const {
  if (exit_code_) return {};
  if (leaves_at_) return {.wall = leaves_at_};
  const Nanoseconds time = run_->wake_up();
  WakeUp wake = time == LabRun::kNever ? WakeUp{} : run_->wake_up_at(time);
  wake.wall = machine::earlier(wake.wall, progress_.next());
  return wake;
}

std::size_t LabControlMachine::awaited() const {
  return leaves_at_ ? machine::kOnlyUrgent : std::max<std::size_t>(run_->pending_answers(), 1);
}

}  // namespace hlc::lab_control
