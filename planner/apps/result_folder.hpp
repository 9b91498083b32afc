#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hlc::apps {

/// Where rows come from.
struct EvaluationOrigin {
  std::string command;
  std::string revision;
  std::string compiler;
  std::string processor;
};

/// Name of the program and its arguments, separated by blanks.
[[nodiscard]] std::string command_line(int argc, const char* const* argv);

/// Of this program on this machine.
[[nodiscard]] EvaluationOrigin origin_of(const std::string& command);

/// campaign.json: {"kind": ..., "origin": {...}, KIND: content}.
[[nodiscard]] std::string campaign_json(const std::string& kind, const EvaluationOrigin& origin,
                                        const nlohmann::ordered_json& content);

/// Makes the page report.md of the folder, by report/report.sh beside this program. Its messages go
/// to this program's output and errors. If it is not made, stderr has a line that begins with the
/// program's name, and the rows stay.
/// @param folder  with campaign.json and its rows
[[nodiscard]] bool make_report(const std::string& program, const std::filesystem::path& folder);

/// Exit code of programs: all but the report is there.
inline constexpr int kExitNoReport = 3;

}  // namespace hlc::apps
