#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "hlc_bridge/middleware/command_check.hpp"
#include "hlc_bridge/middleware/middleware_messages.hpp"

namespace hlc::middleware {

/// Forwards the controllers' commands to their vehicles, and records who has answered which list.
class CommandForwarder {
 public:
  /// @param vehicle_ids  of the controllers; at least one, each once
  explicit CommandForwarder(std::vector<std::uint8_t> vehicle_ids);

  /// Forwards the command if a vehicle can drive it (check_command); it counts as an answer in any
  /// case. A fault of each kind is logged once.
  /// @param t_now        time of the run
  /// @param newest_list  t_now of the last published list; 0 before the first one
  /// @param is_withheld  commands are not forwarded now
  void receive(VehicleCommand command, Nanoseconds t_now, Nanoseconds newest_list, bool is_withheld,
               MiddlewareActions& actions);

  /// Vehicles whose controllers have not answered the list of this time or a later one.
  [[nodiscard]] std::vector<std::uint8_t> unanswered(Nanoseconds list) const;

  /// Counts the controllers that have not answered `list` at the end of its period, and logs the
  /// first time.
  void count_missed_answers(Nanoseconds list, MiddlewareActions& actions);
  [[nodiscard]] std::uint64_t missed_answers() const { return missed_answers_; }

 private:
  [[nodiscard]] CommandVerdict check(const VehicleCommand& command, Nanoseconds t_now,
                                     Nanoseconds newest_list) const;

  std::vector<std::uint8_t> vehicle_ids_;
  std::map<std::uint8_t, Nanoseconds> newest_answers_;  ///< largest create_stamps, by vehicle
  std::set<CommandFault> logged_faults_;
  std::uint64_t missed_answers_{};
};

[[nodiscard]] std::uint8_t vehicle_of(const VehicleCommand& command);

}  // namespace hlc::middleware
