#include "hlc_bridge/record/run_folder.hpp"

#include <stdexcept>
#include <utility>

#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/incomplete_files.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/result/run_description.hpp"

namespace hlc::record {
namespace {

namespace fs = std::filesystem;

void check_is_there(const fs::path& folder, const fs::path& file) {
  if (fs::exists(folder / file)) return;
  throw std::invalid_argument(folder.string() + ": no run folder, " + file.string() +
                              " is missing");
}

}  // namespace

RunFolder read_run_folder(const fs::path& folder, const RunChoices& given) {
  check_is_there(folder, "run.json");
  check_is_there(folder, "reports.csv");
  RunFolder run{.folder = folder};
  const std::vector<ReportRecord> reports = read_reports(folder / "reports.csv");
  run.facts = read_facts(folder / "run.json");
  if (!run.facts.first_step) {
    run.facts.first_step = result::first_step_of(reports);  // the lab control did not end it
  }
  run.choices = choices_of_run(folder, given);
  run.scenario = scenario::read_scenario(run.choices.scenario);
  run.description = result::describe(run.scenario, run.choices.noise_seed);
  const std::vector<KeptFork> forks = kept_forks(folder);
  omit_changed_routes(forks, run.description);
  add_obstacles(forks, run.description);
  try {
    result::check_run(run.facts, run.description);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(folder.string() + ": " + error.what());
  }
  std::vector<std::uint8_t> ids = run.facts.vehicle_ids;
  for (const result::VehicleDescription& guest : run.description.guests) {
    ids.push_back(guest.id.value);
  }
  run.drives = read_drives(folder, ids);
  run.rows = result::step_records(reports, run.drives, run.facts);
  result::RunFacts of_the_rest = run.facts;
  std::erase_if(of_the_rest.vehicle_ids, [&](std::uint8_t id) { return takes_out(forks, id); });
  run.incomplete = incomplete_files(of_the_rest, run.rows, run.drives);
  return run;
}

RunFolder read_run_folder(const fs::path& folder) {
  check_is_there(folder, "run.json");
  check_is_there(folder, fs::path("configuration") / "flags.yaml");
  return read_run_folder(folder, RunChoices{.scenario = {.profile = {}}, .noise_seed = {}});
}

std::uint64_t recorded_steps(const RunFolder& run) {
  if (run.rows.empty()) return 0;
  const std::uint64_t last = run.rows.back().step;
  if (last == 0 || last + 1 == run.facts.steps) return last + 1;
  const std::size_t before_last = result::rows_before(run.rows, last).size();
  const std::size_t one_before = before_last - result::rows_before(run.rows, last - 1).size();
  return run.rows.size() - before_last < one_before ? last : last + 1;
}

}  // namespace hlc::record
