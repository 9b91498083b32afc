#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/result/run_record.hpp"

namespace hlc::test {

/// The commands that were sent, by vehicle and create_stamp.
using Commands = std::map<std::pair<std::uint8_t, Nanoseconds>, TrajectoryCommand>;

/// One line: vehicle, create_stamp, valid_after_stamp, then t, x, y, vx, vy of every point. At once
/// handed to the system. @throws std::runtime_error
void append(const TrajectoryCommand& command, std::FILE& file);

/// Of two commands with the same create_stamp (the second is the copy, hlc_bridge/hlc/command.hpp)
/// the second. A last line without an end is left out.
[[nodiscard]] Commands read_commands(const std::filesystem::path& file);

/// The copy of the vehicle's newest command was recorded, too: without it the vehicle does not
/// drive the whole plan.
[[nodiscard]] bool is_newest_sent_whole(const Commands& commands, std::uint8_t vehicle);

}  // namespace hlc::test
