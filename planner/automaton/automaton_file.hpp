#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc::automaton {

/// The content of an automaton file, with its origin.
struct AutomatonFile {
  std::string configuration_file;    ///< name of the configuration, without its folder
  std::string configuration_sha256;  ///< of the whole configuration (see built_automaton.hpp)
  /// Intervals of constant input chosen instead of the configuration's, if any.
  std::optional<std::size_t> chosen_intervals{};
  std::size_t horizon_steps{};  ///< for which its subgraphs were checked
  std::vector<std::string> labels;
  std::vector<SubgraphSpec> subgraphs;
  std::shared_ptr<const UniversalAutomaton> automaton;
};

/// Version of the format. A file of another version is refused.
inline constexpr std::size_t kAutomatonSchema = 1;

/// The file's text: YAML, with these keys.
///
///     automaton_schema   kAutomatonSchema
///     sha256             of all other lines of the file, in order
///     configuration      {file, sha256, intervals (if others were chosen), horizon_steps}
///     vehicle, limits    as in a configuration; step_s
///     labels             list of names
///     trims              list of {speed_mps, steering_rad, unit_costs: {criterion: per second}}
///     subgraphs          list, see subgraph_yaml.hpp
///     maneuvers          list of {from, to, label, displacement: [x, y, heading],
///                        criteria: {criterion: value}, and tables, one row per line:
///                        inputs (u_v, u_delta), states (x, y, psi, v, delta),
///                        swept_area_m, lane_area_m (x, y)}
///
/// All numbers in m, s, rad, written so that they read back to the same bits. The same content
/// gives the same text.
[[nodiscard]] std::string to_text(const AutomatonFile& file);

/// Writes the text to a temporary file and renames it, so that there is never a half-written file.
/// @throws std::runtime_error naming the file if it cannot be written
void write_automaton_file(const AutomatonFile& file, const std::filesystem::path& path);

/// True if the file has the key `automaton_schema`, which a configuration does not have. Also false
/// if it cannot be read: reading it as a configuration then reports the reason.
[[nodiscard]] bool is_automaton_file(const std::filesystem::path& path);

/// Reads a file and checks it: version, hash, each maneuver (validate in maneuver_check.hpp), and
/// that it holds what its subgraphs need. Whether it is up to date with its configuration is
/// checked in built_automaton.hpp.
///
/// @throws std::invalid_argument with one line: file, line, error, and, if the file was edited or
/// is of another version, the command that rebuilds it
[[nodiscard]] AutomatonFile read_automaton_file(const std::filesystem::path& path);

/// The command that rebuilds the file.
[[nodiscard]] std::string rebuild_command(const AutomatonFile& file,
                                          const std::filesystem::path& path,
                                          const std::filesystem::path& configuration_path);

}  // namespace hlc::automaton
