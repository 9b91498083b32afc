#include "vehicle_sim/apps/fork_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "vehicle_sim/apps/run_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

constexpr char kForks[] = "forks";

fs::path flags_file(const fs::path& folder) { return folder / "configuration" / "flags.yaml"; }

std::vector<closed_loop::Fork> forks_of(const Node& flags, const scenario::Scenario& scenario) {
  std::vector<closed_loop::Fork> forks;
  for (const Node& one : flags.optional_list(kForks)) {
    closed_loop::Fork fork{.from = one.required<std::size_t>("from"), .changes = {}};
    for (const Node& text : one.list("set")) {
      fork.changes.push_back(closed_loop::change_from_text(text.as<std::string>(), scenario));
    }
    forks.push_back(std::move(fork));
  }
  return forks;
}

std::string fork_yaml(std::uint64_t from, const std::vector<std::string>& set) {
  std::string texts;
  for (const std::string& text : set) texts += (texts.empty() ? "" : ", ") + quoted_yaml(text);
  return fmt::format("  - from: {}\n    set: [{}]\n", from, texts);
}

}  // namespace

closed_loop::ExperimentOptions options_of_run(const record::RunFolder& run) {
  if (!run.facts.simulated_time) {
    throw std::invalid_argument(run.folder.string() +
                                ": driven in real time, must be a run in logical time");
  }
  const Node flags = Node::read_yaml(flags_file(run.folder));
  closed_loop::ExperimentOptions options{.steps = run.facts.steps,
                                         .noise_seed = run.choices.noise_seed};
  options.gains = scaled(options.gains, flags.optional<double>("gains_scale", 1.0, at_least(0.0)));
  if (flags.is_value("stamps")) {
    const auto stamps = flags.required<std::string>("stamps", one_of({"exact", "lab"}));
    options.stamps =
        stamps == "lab" ? simulated_vehicle::Stamps::kLab : simulated_vehicle::Stamps::kExact;
  }
  options.forks = forks_of(flags, run.scenario);
  closed_loop::check_forks(options.forks, run.scenario, options.steps);
  return options;
}

fs::path fork_folder(const record::RunFolder& run, std::uint64_t from, const fs::path& out) {
  fs::path folder = out;
  if (folder.empty()) {
    const fs::path name = fs::absolute(run.folder / "").lexically_normal().parent_path();
    folder = name.parent_path() / fmt::format("{}_from_{}", name.filename().string(), from);
  }
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder) && fs::is_empty(folder, error))) {
    throw std::invalid_argument(fmt::format("--out = {}, must be new or empty", folder.string()));
  }
  return folder;
}

void write_fork(const fs::path& folder, const record::RunFolder& run, std::uint64_t from,
                const std::vector<std::string>& set, const closed_loop::Experiment& experiment) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    fs::copy(run.folder / "configuration", folder / "configuration", fs::copy_options::recursive,
             error);
  }
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  std::string flags = read_file(flags_file(run.folder));
  const bool has_forks = Node::parse_yaml(flags, flags_file(run.folder).string()).has(kForks);
  if (!has_forks) flags += fmt::format("{}:\n", kForks);
  write_file(flags_file(folder), flags + fork_yaml(from, set));
  write_records(folder, experiment);
}

}  // namespace hlc::apps
