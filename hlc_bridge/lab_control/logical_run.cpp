#include "hlc_bridge/lab_control/logical_run.hpp"

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {
namespace {

std::vector<std::string> timer_names(const LabRunSettings& settings) {
  std::vector<std::string> names;
  for (const std::uint8_t id : settings.vehicle_ids) {
    names.push_back(vehicle_name(id));
    names.push_back(middleware_name(id));
  }
  for (const std::uint8_t id : settings.guest_ids) names.push_back(vehicle_name(id));
  return names;
}

}  // namespace

LogicalRun::LogicalRun(LabRunSettings run_settings)
    : LabRun{std::move(run_settings)}, ticks_{timer_names(settings())} {
  for (const std::uint8_t id : settings().vehicle_ids) {
    controllers_.insert(controller_name(id));
  }
}

void LogicalRun::ready(const ReadyStatus& status) {
  for (const std::string& timer : process_names(status.source_id)) {
    if (timer != status.source_id) shared_by_[timer] = status.source_id;
    if (ticks_.waits_for_released(timer, status.next_start)) {
      send_again_ = true;
    } else if (ticks_.request(timer, status.next_start)) {
      note_progress();
    }
  }
}

std::vector<std::string> LogicalRun::not_ready() const { return ticks_.unanswered(); }

std::vector<std::string> LogicalRun::unreported_before(Nanoseconds tick) const {
  std::vector<std::string> names;
  const std::optional<Nanoseconds> list = last_list_before(tick, settings().period);
  if (!list) {
    return names;
  }
  const std::uint64_t step = step_at(*list, settings().period);
  for (const std::uint8_t id : settings().vehicle_ids) {
    const std::optional<std::uint64_t> reported = reports().last(id);
    if (controllers_.count(controller_name(id)) != 0 && (!reported || *reported < step)) {
      names.push_back(controller_name(id));
    }
  }
  return names;
}

std::optional<Nanoseconds> LogicalRun::next_tick() const {
  const std::optional<Nanoseconds> tick = ticks_.releasable();
  return tick && unreported_before(*tick).empty() ? tick : std::nullopt;
}

void LogicalRun::go_on(LabRunActions& actions) {
  if (next_tick()) {
    actions.triggers.push_back(ticks_.release());
  } else if (send_again_) {
    actions.triggers.push_back(ticks_.released().value());
  }
  send_again_ = false;
}

Nanoseconds LogicalRun::clock() const {
  if (ticks_.empty()) {
    return kNever;
  }
  const Nanoseconds tick = next_tick().value_or(ticks_.released().value_or(0));
  return tick == 0 ? 0 : tick - 1;
}

std::vector<std::string> LogicalRun::pending_replies() const {
  std::vector<std::string> names = ticks_.unanswered();
  if (const std::optional<Nanoseconds> tick = ticks_.releasable()) {
    names = unreported_before(*tick);
  }
  return names;
}

std::size_t LogicalRun::num_messages(const std::vector<std::string>& processes) const {
  std::set<std::string> senders;
  for (const std::string& process : processes) {
    const auto shared = shared_by_.find(process);
    senders.insert(shared == shared_by_.end() ? process : shared->second);
  }
  return senders.size();
}

void LogicalRun::drop(const std::string& process) {
  if (phase() == Phase::kGathering) {
    ticks_.forget(process);
    return;
  }
  ticks_.drop(process);
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (process == controller_name(id) || process == middleware_name(id)) {
      controllers_.erase(controller_name(id));
    }
  }
}

}  // namespace hlc::lab_control
