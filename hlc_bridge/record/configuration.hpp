#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::record {

/// Copies the configuration files of a run into `<run_folder>/configuration/<folder>/<file>`, where
/// <folder> is the name of the file's own folder: relative paths such as `../maps/lab_like.xml`
/// stay valid, so the run can be repeated from its folder.
/// @throws std::runtime_error naming the file
void keep_configuration(const std::filesystem::path& run_folder,
                        const std::vector<std::filesystem::path>& files);

/// Where the copy of a file is.
[[nodiscard]] std::filesystem::path kept_copy(const std::filesystem::path& run_folder,
                                              const std::filesystem::path& file);

/// The same as a path from the copy of another file: `../<folder>/<file>`.
[[nodiscard]] std::filesystem::path path_between_kept(const std::filesystem::path& file);

/// `configuration/flags.yaml`: the choices of a run besides the files; run_lab.sh writes the same
/// keys and its own.
[[nodiscard]] std::string flags_yaml(const scenario::ScenarioChoices& choices);

/// What flags.yaml has as `priorities` where they were a function in Python.
inline constexpr char kRuleInPython[] = "python";

/// The choices of a run from its flags.yaml, with the copies in its own folder; a file that was not
/// copied yet is that which was driven.
/// @throws std::invalid_argument naming file, line, key, value and bound, or the folder, if its
/// priorities are kRuleInPython
[[nodiscard]] scenario::ScenarioChoices kept_choices(const std::filesystem::path& run_folder);

/// The choices that the result of a run depends on.
struct RunChoices {
  scenario::ScenarioChoices scenario;       ///< an empty profile: not given
  std::optional<std::uint64_t> noise_seed;  ///< of the measurement noise; none: not given
};

/// The choices of the run, from its flags.yaml; without that file, as after a start by hand, those
/// that are given, and the default profile.
/// @param given  by the user; a scenario or map is the run's if it has the same name and text
/// @throws std::invalid_argument as kept_choices, or naming a given flag, its value and the run's,
/// if they differ
[[nodiscard]] RunChoices choices_of_run(const std::filesystem::path& run_folder,
                                        const RunChoices& given);

/// What was changed in a run from a step on.
struct KeptFork {
  std::uint64_t from{};          ///< step of the experiment, from 0
  std::vector<std::string> set;  ///< the texts of the changes
};

/// Of a run folder: a list `forks` of {from, set}; the file is there only if there are any.
[[nodiscard]] std::filesystem::path forks_file(const std::filesystem::path& run_folder);

/// In their order in the file. @throws std::invalid_argument naming file, line, key, value and
/// bound
[[nodiscard]] std::vector<KeptFork> kept_forks(const std::filesystem::path& run_folder);

/// "a fork: from step 40 on priorities=2; from step 60 on speed=3:0.4"; empty without forks.
[[nodiscard]] std::string forks_text(std::span<const KeptFork> forks);

/// Adds to the description the obstacles of the changes `obstacle=X,Y,LENGTH,WIDTH[,HEADING]`.
void add_obstacles(std::span<const KeptFork> forks, result::RunDescription& description);

/// Whether one of them takes the vehicle out of the run (`without=VEHICLE`).
[[nodiscard]] bool takes_out(std::span<const KeptFork> forks, std::uint8_t vehicle);

/// Of vehicles that follow another route from a fork on, the description has no route then: no
/// numbers along the one of the scenario would mean anything.
void omit_changed_routes(std::span<const KeptFork> forks, result::RunDescription& description);

/// The text of such a file. @pre not empty
[[nodiscard]] std::string forks_yaml(const std::vector<KeptFork>& forks);

}  // namespace hlc::record
