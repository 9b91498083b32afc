#include "tests/simulation/observed_run.hpp"

#include <algorithm>

#include "tests/support/folders.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kLook = 100 * kNanosecondsPerMillisecond;

}  // namespace

const scenario::Scenario& scenario_of(const std::string& name) {
  static std::map<std::string, scenario::Scenario> scenarios;
  auto found = scenarios.find(name);
  if (found == scenarios.end()) {
    const std::string file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml";
    found = scenarios.emplace(name, scenario::read_scenario({.file = file})).first;
  }
  return found->second;
}

ObservedRun::ObservedRun(const scenario::Scenario& scenario, const LabSettings& settings)
    : scenario_(&scenario), monitor_(scenario, 0, no_trace_), lab_(scenario, settings, *this) {
  monitor_.attach(lab_);
  lab_.on_change = [this](const ProcessSlot& slot) {
    monitor_.changed(slot);
    if (slot.exit_code) exit_codes_[slot.name] = *slot.exit_code;
  };
  lab_.pose_of = [this](std::uint8_t vehicle) { return monitor_.pose_of(vehicle); };
  lab_.set_alarm(kLook, 0);
}

bool ObservedRun::comes_to(const std::function<bool()>& condition, Nanoseconds patience) {
  const Nanoseconds end = lab_.now() + patience;
  while (!condition()) {
    if (lab_.now() >= end) return false;
    if (!lab_.step()) continue;
    monitor_.check_ticks();
    lab_.set_alarm(lab_.now() + kLook, 0);
  }
  return true;
}

void ObservedRun::kill(const std::string& process) {
  ProcessSlot& slot = lab_.slot(process);
  lab_.kill(slot);
  monitor_.killed(slot);
}

bool ObservedRun::has_logged(const std::string& process, const std::string& text) const {
  const auto lines = log_.find(process);
  return lines != log_.end() && std::ranges::any_of(lines->second, [&](const Line& line) {
           return line.line.text.find(text) != std::string::npos;
         });
}

std::string ObservedRun::violations() {
  std::string text;
  for (const Violation& violation : monitor_.result().violations) {
    text += violation.check + ": " + violation.text + "\n";
  }
  return text;
}

void ObservedRun::on_log(NodeId node, const machine::LogLine& line) {
  monitor_.on_log(node, line);
  log_[lab_.name(node)].push_back({.tick = tick_, .line = line});
}

void ObservedRun::on_driven(std::uint8_t vehicle, Nanoseconds time,
                            const result::DrivenSample& sample) {
  monitor_.on_driven(vehicle, time, sample);
  drives_[vehicle].push_back(sample);
  on_tick(vehicle, sample.t);
  tick_ = std::max(tick_, sample.t);
}

void ObservedRun::on_report(const ReportRecord& record, const coordination::Plan* in_force) {
  monitor_.on_report(record, in_force);
  reports_.push_back(record);
}

void ObservedRun::on_received(const TrajectoryCommand& command) {
  monitor_.on_received(command);
  commands_.insert_or_assign({command.vehicle_id, command.create_stamp}, command);
}

void ObservedRun::on_stop_symbol(std::uint8_t vehicle) {
  monitor_.on_stop_symbol(vehicle);
  if (!stopped_at_) stopped_at_ = tick_;
}

}  // namespace hlc::closed_loop
