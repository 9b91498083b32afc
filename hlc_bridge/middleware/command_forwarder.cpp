#include "hlc_bridge/middleware/command_forwarder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::middleware {

std::uint8_t vehicle_of(const VehicleCommand& command) {
  return std::visit([](const auto& any) { return any.vehicle_id; }, command);
}

CommandForwarder::CommandForwarder(std::vector<std::uint8_t> vehicle_ids)
    : vehicle_ids_{std::move(vehicle_ids)} {
  for (const std::uint8_t id : vehicle_ids_) newest_answers_[id] = 0;
}

CommandVerdict CommandForwarder::check(const VehicleCommand& command, Nanoseconds t_now,
                                       Nanoseconds newest_list) const {
  if (const auto* trajectory = std::get_if<TrajectoryCommand>(&command)) {
    return check_command(*trajectory, t_now, newest_list, vehicle_ids_);
  }
  return std::visit(
      [&](const auto& any) {
        return check_header(any.vehicle_id, any.create_stamp, t_now, newest_list, vehicle_ids_);
      },
      command);
}

void CommandForwarder::receive(VehicleCommand command, Nanoseconds t_now, Nanoseconds newest_list,
                               bool is_withheld, MiddlewareActions& actions) {
  const std::uint8_t vehicle_id = vehicle_of(command);
  const CommandVerdict verdict = check(command, t_now, newest_list);
  for (const CommandFault fault : verdict.faults) {
    if (!logged_faults_.insert(fault).second) continue;
    actions.emplace_back(machine::warning(fmt::format("command of {}: {}{} (logged once)",
                                                      controller_name(vehicle_id), to_string(fault),
                                                      verdict.forward ? "" : "; not forwarded")));
  }
  if (const auto answer = newest_answers_.find(vehicle_id); answer != newest_answers_.end()) {
    const auto create_stamp = std::visit([](const auto& any) { return any.create_stamp; }, command);
    answer->second = std::max(answer->second, create_stamp);
  }
  if (verdict.forward && !is_withheld) actions.emplace_back(std::move(command));
}

std::vector<std::uint8_t> CommandForwarder::unanswered(Nanoseconds list) const {
  std::vector<std::uint8_t> vehicle_ids;
  for (const auto& [id, answer] : newest_answers_) {
    if (answer < list) vehicle_ids.push_back(id);
  }
  return vehicle_ids;
}

void CommandForwarder::count_missed_answers(Nanoseconds list, MiddlewareActions& actions) {
  for (const std::uint8_t id : unanswered(list)) {
    if (missed_answers_++ > 0) continue;
    actions.emplace_back(machine::warning(
        fmt::format("no answer of {} to a state list in time; its log may state why (logged once)",
                    controller_name(id))));
  }
}

}  // namespace hlc::middleware
