#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "planner/automaton/automaton_file.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"

namespace hlc::maneuver_design {

/// SHA-256 over the configuration's content, its defaults included: comments, spelling and the
/// file's name make no difference, any value does.
[[nodiscard]] std::string configuration_sha256(const AutomatonConfiguration& configuration);

/// The content of an automaton file: the automaton and its origin.
/// @param configuration     as read
/// @param chosen_intervals  of constant input, if the automaton was built with others than the
/// configuration's
[[nodiscard]] automaton::AutomatonFile file_of(
    const AutomatonConfiguration& configuration, automaton::UniversalAutomaton automaton,
    std::optional<std::size_t> chosen_intervals = std::nullopt);

/// Compares a file with the configuration `configuration_path`, read again.
/// @throws std::invalid_argument with one line that names both files and the command that rebuilds
/// the file, if the configuration differs; or as read_automaton_configuration
void check_is_current(const automaton::AutomatonFile& file, const std::filesystem::path& path,
                      const std::filesystem::path& configuration_path);

/// Reads an automaton file (read_automaton_file) and refuses it if it is stale: if its
/// configuration exists in the same folder, under its name, and differs now. Without a
/// configuration, or if a built automaton has that name, the file is accepted as it is.
[[nodiscard]] automaton::AutomatonFile read_current_automaton_file(
    const std::filesystem::path& path);

/// The configuration of an automaton, for designing more of its maneuvers: `path` itself, or, if
/// that is a built automaton, the file in the same folder with the name of its configuration, with
/// the intervals of the build.
/// @throws std::invalid_argument with one line if there is none, if the file is stale, or as
/// read_automaton_file and read_automaton_configuration
[[nodiscard]] AutomatonConfiguration read_configuration_of(const std::filesystem::path& path);

}  // namespace hlc::maneuver_design
