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

void write_configuration(const fs::path& folder, const DrivenRun& run) {
  if (!run.changed_text.empty()) {
    write_file(record::kept_copy(folder, run.scenario.file), run.changed_text);
  }
  if (!run.forks.empty()) write_file(record::forks_file(folder), record::forks_yaml(run.forks));
}

record::RunFolder content_of(const fs::path& folder, const DrivenRun& run) {
  record::RunFolder content{.folder = folder,
                            .scenario = run.scenario,
                            .description = result::describe(run.scenario, run.noise_seed),
                            .facts = run.experiment.facts,
                            .drives = run.experiment.drives,
                            .rows = run.rows};
  record::omit_changed_routes(run.forks, content.description);
  record::add_obstacles(run.forks, content.description);
  return content;
}

}  // namespace

void make_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder) && fs::is_empty(folder, error) && !error) return;
  throw std::invalid_argument(
      fmt::format("out = {}, must be a new or empty folder", folder.string()));
}

void write_run(const fs::path& folder, const DrivenRun& run) {
  run_folder::write_run_folder(folder, run.scenario, run.noise_seed, run.experiment);
  write_configuration(folder, run);
  record::RunFolder content = content_of(folder, run);
  result::RunSummary summary =
      result::summarize(content.description, content.facts, content.rows, content.drives);
  summary.revision = program_revision();
  summary.host = record::this_host();
  write_file(folder / "steps.csv", record::steps_csv(run.rows));
  write_file(folder / "timing.csv", record::timing_csv(run.rows));
  write_file(folder / "summary.json", record::summary_json(summary));
  apps::write_page(std::move(content));
}

}  // namespace hlc::python
