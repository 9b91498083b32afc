#include "hlc_bridge/apps/finished_run.hpp"

#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/explanation_file.hpp"
#include "hlc_bridge/record/log_files.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/waits.hpp"
#include "hlc_bridge/view/run_page.hpp"
#include "planner/common/text_file.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::apps {
namespace {

constexpr const char* kHowExplained =
    "explain RUN --vehicle_id VEHICLE --step STEP answers it (with --tree also what was searched); "
    "explain RUN --all fills this row where a car stands, waits or keeps its plan";
constexpr const char* kNotExplained =
    "only a run in logical time can be explained (run_lab.sh --simulated_time=true)";

}  // namespace

Verdict verdict_on(const result::RunSummary& summary) {
  if (std::string fault = result::driving_fault(summary); !fault.empty()) {
    return {kExitDrivenBadly, std::move(fault)};
  }
  const auto stuck = result::stuck_vehicles(summary);
  if (stuck.empty()) return {kExitGood, {}};
  return {kExitStuck, "stuck at the end: vehicles " + record::ids_to_text(stuck)};
}

std::filesystem::path page_file(const std::filesystem::path& run) { return run / "run.html"; }

view::FinishedRun finished_run(record::RunFolder read, std::string fault) {
  view::FinishedRun run;
  if (read.scenario.map_file) run.map = road::read_lanelet_map(*read.scenario.map_file);
  run.log = record::read_logs(read.folder / "logs", read.facts);
  run.explanations = record::read_explanations(read.folder, read.rows);
  run.fork = record::forks_text(record::kept_forks(read.folder));
  run.searches = record::read_search_pages(read.folder, read.rows);
  run.how_explained = read.facts.simulated_time ? kHowExplained : kNotExplained;
  run.time = read.facts.simulated_time ? "logical time" : "real time";
  run.description = std::move(read.description);
  run.facts = std::move(read.facts);
  run.rows = std::move(read.rows);
  run.drives = std::move(read.drives);
  run.revision = program_revision();
  run.fault = std::move(fault);
  run.show_guests();
  for (const std::string& line : read.incomplete)
    run.fault += (run.fault.empty() ? "" : "; ") + line;
  return run;
}

void write_page(record::RunFolder read) {
  std::string fault =
      verdict_on(result::summarize(read.description, read.facts, read.rows, read.drives)).fault;
  const std::filesystem::path file = page_file(read.folder);
  write_file(file, view::run_page(finished_run(std::move(read), std::move(fault))));
}

}  // namespace hlc::apps
