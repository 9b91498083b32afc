#include "vehicle_sim/apps/fork_folder.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>

#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/result/first_difference.hpp"
#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/run_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostSteps = 100'000;

fs::path flags_file(const fs::path& folder) { return folder / "configuration" / "flags.yaml"; }

std::vector<closed_loop::Fork> forks_of(const record::RunFolder& run) {
  std::vector<closed_loop::Fork> forks;
  for (const record::KeptFork& kept : record::kept_forks(run.folder)) {
    closed_loop::Fork& fork = forks.emplace_back();
    fork.from = kept.from;
    for (const std::string& text : kept.set) {
      fork.changes.push_back(closed_loop::change_from_text(text, run.scenario));
    }
  }
  closed_loop::check_forks(forks, run.scenario, run.facts.steps);
  return forks;
}

/// Whether a folder can be made there: tried, as permissions do not show it everywhere (/proc).
bool can_be_created(const fs::path& folder) {
  std::error_code error;
  if (fs::create_directories(folder, error)) fs::remove(folder, error);
  return !error;
}

}  // namespace

closed_loop::ExperimentOptions options_of_run(const record::RunFolder& run) {
  if (!run.facts.simulated_time) {
    throw std::invalid_argument(run.folder.string() +
                                ": driven in real time, must be a run in logical time");
  }
  if (run.facts.steps == 0 || run.facts.steps > kMostSteps) {
    throw std::invalid_argument(fmt::format("{}: steps = {}, must be in 1 ... {}",
                                            (run.folder / "run.json").string(), run.facts.steps,
                                            kMostSteps));
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
  try {
    options.forks = forks_of(run);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(
        fmt::format("{}: forks: {}", flags_file(run.folder).string(), error.what()));
  }
  return options;
}

void check_same_until(std::uint64_t step, const record::RunFolder& run,
                      std::span<const result::StepRecord> rows) {
  const auto is_later = [step](const result::StepRecord& row) { return row.step >= step; };
  std::vector<result::StepRecord> recorded = run.rows;
  std::vector<result::StepRecord> driven(rows.begin(), rows.end());
  std::erase_if(recorded, is_later);
  std::erase_if(driven, is_later);
  const auto difference = result::first_difference(recorded, driven);
  if (!difference) return;
  throw std::invalid_argument(fmt::format(
      "{}: driven again it differs from its record from step {} on, vehicle {}: {}",
      run.folder.string(), difference->step, difference->vehicle.value, difference->text));
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
  if (!can_be_created(folder)) {
    throw std::invalid_argument(
        fmt::format("--out = {}, must be a folder that can be created", folder.string()));
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
  write_file(flags_file(folder), record::flags_with({.from = from, .set = set}, run.folder));
  write_records(folder, experiment);
}

}  // namespace hlc::apps
