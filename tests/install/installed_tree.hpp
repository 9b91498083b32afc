#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

/// What an installation is held to, whether it comes from `cmake --install` or from a package.
namespace hlc::test {

/// Names of all programs of the target `programs`.
[[nodiscard]] std::vector<std::string> installed_programs();

/// The command that an installation has for a program: show_scenario is hlc-show-scenario.
[[nodiscard]] std::string command_of(const std::string& program);

/// Runs one in a folder, with its flags.
[[nodiscard]] Outcome run_in(const std::filesystem::path& folder,
                             const std::filesystem::path& prefix, const std::string& command);

/// Fails the test unless bin has a command for every program and script that prints its version,
/// and nothing else.
void expect_every_command(const std::filesystem::path& prefix);

/// Fails the test unless the first scenario can be driven by processes from any folder, in which
/// the run then lies.
void expect_it_drives(const std::filesystem::path& prefix);

/// Of the plan around a parked car, by plan_problem of the build tree [m^2].
[[nodiscard]] double built_cost_m2();

}  // namespace hlc::test
