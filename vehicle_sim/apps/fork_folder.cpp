#include "vehicle_sim/apps/fork_folder.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/result/first_difference.hpp"
#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostSteps = 100'000;

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

/// The topmost folder on the way to `folder` that does not exist; `folder` itself if it does.
fs::path first_new_on_the_way_to(const fs::path& folder) {
  fs::path first_new = fs::absolute(folder / "").lexically_normal().parent_path();
  while (!fs::exists(first_new.parent_path())) first_new = first_new.parent_path();
  return first_new;
}

/// Whether a folder can be made there: tried, as permissions do not show it everywhere (/proc).
bool can_be_created(const fs::path& folder) {
  const fs::path first_new = first_new_on_the_way_to(folder);
  std::error_code error;
  const bool is_new = !fs::exists(folder, error);
  fs::create_directories(folder, error);
  const bool is_created = !error;
  if (is_new) fs::remove_all(first_new, error);
  return is_created;
}

/// Without the permissions: copies of what may only be read can be removed again.
void copy_files(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
    const fs::path copy = to / entry.path().filename();
    if (entry.is_directory()) {
      copy_files(entry, copy);
    } else {
      write_file(copy, read_file(entry));
    }
  }
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
  const Node flags = Node::read_yaml(run.folder / "configuration" / "flags.yaml");
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
        fmt::format("{}: {}", record::forks_file(run.folder).string(), error.what()));
  }
  return options;
}

void check_same_until(std::uint64_t step, const record::RunFolder& run,
                      std::span<const result::StepRecord> rows) {
  const std::uint64_t until = std::min(step, record::recorded_steps(run));
  const auto difference = result::first_difference(result::rows_before(run.rows, until),
                                                   result::rows_before(rows, until));
  if (!difference) return;
  throw std::invalid_argument(fmt::format("{}: driven again it differs from its record from {}",
                                          run.folder.string(),
                                          result::text_of(*difference, run.description.step_s)));
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
  // Whole or not at all, also for a process that is killed: a name that is given when all is there.
  fs::path part = fs::absolute(folder / "").lexically_normal().parent_path();
  part += fmt::format(".{}.part", getpid());  // nobody else's: it is removed after a failure
  const fs::path first_new = first_new_on_the_way_to(part);
  if (fs::exists(part)) throw std::runtime_error(part.string() + ": is there already");
  try {
    copy_files(run.folder / "configuration", part / "configuration");
    std::vector<record::KeptFork> forks = record::kept_forks(run.folder);
    forks.push_back({.from = from, .set = set});
    write_file(record::forks_file(part), record::forks_yaml(forks));
    run_folder::write_records(part, experiment);
    fs::rename(part, folder);
  } catch (const std::exception&) {
    std::error_code error;
    fs::remove_all(first_new, error);
    throw;
  }
}

}  // namespace hlc::apps
