#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hlc::plot {

/// Exit code of a program whose drawing was not made.
inline constexpr int kExitNotDrawn = 3;

/// Draws by Python: report/draw.sh beside the program. The drawing's data go through a temporary
/// file.
/// @param kind  of the drawing: automaton, pareto, problem, scenario, sheet (a scenario with poses)
/// @param out   SVG, PDF or PNG by its extension, otherwise SVG
/// @return 0, or kExitNotDrawn after one line on stderr
[[nodiscard]] int draw(const std::string& kind, const nlohmann::ordered_json& data,
                       const std::filesystem::path& out);

}  // namespace hlc::plot
