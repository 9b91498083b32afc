#pragma once

#include <filesystem>
#include <string_view>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::record {

/// Heading of a vehicle's record, one row per tick: the true state at the tick, the inputs
/// commanded then (they act 80 ms later), and the command that they come from.
inline constexpr std::string_view kDriveHeading =
    "t_ns,x_m,y_m,yaw_rad,speed_mps,throttle,steering,command_create_ns";

/// vehicle_<id>.csv in the run folder.
[[nodiscard]] std::filesystem::path drive_file(const std::filesystem::path& run_folder,
                                               std::uint8_t vehicle_id);

/// @throws std::runtime_error naming file, line, column, value and bound; times must increase
[[nodiscard]] result::Drive read_drive(const std::filesystem::path& file);

/// The drives of these vehicles, without those whose file is missing. @throws as read_drive
[[nodiscard]] result::Drives read_drives(const std::filesystem::path& run_folder,
                                         const std::vector<std::uint8_t>& vehicle_ids);

}  // namespace hlc::record
