#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "planner/automaton/automaton_file.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"

namespace hlc {

/// SHA-256 over all that the configuration says, its defaults included: comments, spelling and the
/// file's name make no difference, any value does.
[[nodiscard]] std::string configuration_sha256(const AutomatonConfiguration& configuration);

/// What is written to a file: the automaton and what it was built from.
/// @param configuration     as it was read
/// @param chosen_intervals  of constant input, if the automaton was built with others than it says
[[nodiscard]] AutomatonFile file_of(const AutomatonConfiguration& configuration,
                                    UniversalAutomaton automaton,
                                    std::optional<std::size_t> chosen_intervals = std::nullopt);

/// Compares a file with the configuration `configuration_path`, read again.
/// @throws std::invalid_argument with one line that names both files and the command that builds
/// the file anew, if the configuration says something else; or as read_automaton_configuration
void check_is_current(const AutomatonFile& file, const std::filesystem::path& path,
                      const std::filesystem::path& configuration_path);

/// Reads an automaton file (read_automaton_file) and refuses it if it is stale: if the
/// configuration that it was built from lies beside it, under its name, and says something else
/// now. Without it, or if a built automaton bears that name, the file stands for itself.
[[nodiscard]] AutomatonFile read_current_automaton_file(const std::filesystem::path& path);

/// The configuration of which an automaton is, for designing more of its maneuvers: `path` itself,
/// or, if that is a built automaton, what lies beside it under the name of its configuration, with
/// the intervals with which it was built.
/// @throws std::invalid_argument with one line if there is none, if the file is stale, or as
/// read_automaton_file and read_automaton_configuration
[[nodiscard]] AutomatonConfiguration read_configuration_of(const std::filesystem::path& path);

}  // namespace hlc
