#include "vehicle_sim/python/module/run_files.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>

#include "hlc_bridge/apps/finished_run.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/record/step_files.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace hlc::python {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) return;
    throw std::invalid_argument(
        fmt::format("out = {}, must be a new or empty folder", folder.string()));
  }
  fs::create_directories(folder, error);
  if (!error) return;
  throw std::invalid_argument(fmt::format("out = {}, must be a folder that can be made ({})",
                                          folder.string(), error.message()));
}

void write_configuration(const fs::path& folder, const RunConfiguration& run) {
  run_folder::write_configuration(folder, run.scenario, run.noise_seed);
  if (!run.changed_text.empty()) {
    write_file(record::kept_copy(folder, run.scenario.file), run.changed_text);
  }
  if (!run.forks.empty()) write_file(record::forks_file(folder), record::forks_yaml(run.forks));
}

/// What was in it is this program's.
void empty_folder(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    fs::remove_all(entry.path(), error);
  }
}

record::RunFolder content_of(const fs::path& folder, const RunConfiguration& run,
                             const closed_loop::Experiment& experiment,
                             const std::vector<result::StepRecord>& rows) {
  record::RunFolder content{.folder = folder,
                            .scenario = run.scenario,
                            .description = result::describe(run.scenario, run.noise_seed),
                            .facts = experiment.facts,
                            .drives = experiment.drives,
                            .rows = rows};
  record::omit_changed_routes(run.forks, content.description);
  record::add_obstacles(run.forks, content.description);
  return content;
}

}  // namespace

RunFolderWriter::RunFolderWriter(fs::path folder, const RunConfiguration& run)
    : folder_(std::move(folder)) {
  make_folder(folder_);
  try {
    write_configuration(folder_, run);
  } catch (...) {
    empty_folder(folder_);
    throw;
  }
}

RunFolderWriter::~RunFolderWriter() {
  if (!is_complete_) empty_folder(folder_);
}

void RunFolderWriter::complete(const RunConfiguration& run,
                               const closed_loop::Experiment& experiment,
                               const std::vector<result::StepRecord>& rows) {
  record::RunFolder content = content_of(folder_, run, experiment, rows);
  result::RunSummary summary =
      result::summarize(content.description, content.facts, content.rows, content.drives);
  summary.revision = program_revision();
  summary.host = record::this_host();
  write_file(folder_ / "steps.csv", record::steps_csv(rows));
  write_file(folder_ / "timing.csv", record::timing_csv(rows));
  write_file(folder_ / "summary.json", record::summary_json(summary));
  apps::write_page(std::move(content));
  run_folder::write_records(folder_, experiment);
  is_complete_ = true;
}

}  // namespace hlc::python
