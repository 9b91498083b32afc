#pragma once

#include <string>

#include "hlc_bridge/machine/log_line.hpp"

namespace hlc::process {

/// Logs a machine's line (spdlog's default logger).
/// @param process  prefix of the line; empty: none, since the logger has it
void log(const std::string& process, const machine::LogLine& line);

}  // namespace hlc::process
