#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::lab_control {

/// Reports of the controllers of a run: the last step of each, its time, and which vehicles drive.
class ReportedSteps {
 public:
  explicit ReportedSteps(std::vector<std::uint8_t> vehicle_ids);

  /// False, without effect, if the report's vehicle is not part of the run.
  bool add(const ReportRecord& record);
  /// The reports added since the last call were received at `now` (wall time).
  void stamp(Nanoseconds now);

  /// Step up to which the controller has reported; nothing before its first report.
  [[nodiscard]] std::optional<std::uint64_t> last(std::uint8_t vehicle_id) const;
  /// Wall time of the controller's last report; 0 before the first.
  [[nodiscard]] Nanoseconds last_received(std::uint8_t vehicle_id) const;
  /// First step that any controller reported as not standby.
  [[nodiscard]] std::optional<std::uint64_t> first_step() const { return first_step_; }
  [[nodiscard]] bool has_left_standby(std::uint8_t vehicle_id) const {
    return driving_.contains(vehicle_id);
  }
  /// Vehicles that have not left standby.
  [[nodiscard]] std::vector<std::uint8_t> on_standby() const;

 private:
  std::vector<std::uint8_t> vehicle_ids_;
  std::map<std::uint8_t, std::uint64_t> last_;         ///< step, by vehicle
  std::map<std::uint8_t, Nanoseconds> last_received_;  ///< wall, by vehicle
  std::set<std::uint8_t> just_received_;               ///< since the last stamp
  std::set<std::uint8_t> driving_;
  std::optional<std::uint64_t> first_step_;
};

}  // namespace hlc::lab_control
