#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "hlc_bridge/core/messages.hpp"
#include "hlc_bridge/core/run_record.hpp"

namespace hlc::test {

/// The commands that were sent, by vehicle and create_stamp.
using Commands = std::map<std::pair<std::uint8_t, Nanoseconds>, TrajectoryCommand>;

/// One line: vehicle, create_stamp, then t, x, y, vx, vy of every point. At once handed to the
/// system. @throws std::runtime_error
void append(const TrajectoryCommand& command, std::FILE& file);

/// Of two commands with the same stamps (the second copy) the first. A last line without an end
/// is left out.
[[nodiscard]] Commands read_commands(const std::filesystem::path& file);

}  // namespace hlc::test
