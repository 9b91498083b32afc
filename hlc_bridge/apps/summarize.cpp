// Reads a run folder, writes steps.csv, timing.csv, summary.json and the run's configuration,
// prints the table.
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/record/step_files.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/result/summary_table.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_options.hpp"

namespace {

hlc::result::Drives drives_of(const std::filesystem::path& run,
                              const hlc::result::RunFacts& facts) {
  const hlc::result::Drives drives = hlc::record::read_drives(run, facts.vehicle_ids);
  for (const std::uint8_t id : facts.vehicle_ids) {
    if (drives.contains(id)) continue;
    std::cerr << "summarize: " << hlc::record::drive_file(run, id).string()
              << " is missing; the result of vehicle " << id + 0 << " has no driven values\n";
  }
  return drives;
}

/// Returns the exit code.
int summarize_run(const std::filesystem::path& run, const hlc::scenario::ScenarioChoices& choices,
                  std::optional<std::uint64_t> noise_seed) {
  const std::vector<hlc::ReportRecord> reports = hlc::record::read_reports(run / "reports.csv");
  hlc::result::RunFacts facts = hlc::record::read_facts(run / "run.json");
  if (!facts.first_step) {
    facts.first_step = hlc::result::first_step_of(reports);  // the lab control did not end the run
  }
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
  const hlc::result::RunDescription description = hlc::result::describe(scenario, noise_seed);
  hlc::result::check_run(facts, description);
  const hlc::result::Drives drives = drives_of(run, facts);
  const std::vector<hlc::result::StepRecord> rows =
      hlc::result::step_records(reports, drives, facts);

  hlc::result::RunSummary summary = hlc::result::summarize(description, facts, rows, drives);
  summary.revision = hlc::program_revision();
  summary.host = hlc::record::this_host();
  hlc::write_file(run / "steps.csv", hlc::record::steps_csv(rows));
  hlc::write_file(run / "timing.csv", hlc::record::timing_csv(rows));
  hlc::write_file(run / "summary.json", hlc::record::summary_json(summary));
  hlc::record::keep_configuration(run, hlc::scenario::files_of(scenario));
  std::cout << hlc::result::summary_table(summary) << "\nrun folder: " << run.string() << '\n';
  if (const std::string fault = hlc::result::driving_fault(summary); !fault.empty()) {
    std::cerr << "summarize: " << fault << '\n';
    return hlc::kExitDrivenBadly;
  }
  const auto stuck = hlc::result::stuck_vehicles(summary);
  if (stuck.empty()) return hlc::kExitGood;
  std::cerr << "summarize: stuck at the end: vehicles " << hlc::record::ids_to_text(stuck) << '\n';
  return hlc::kExitStuck;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Result of a run: table, summary.json, steps.csv, timing.csv.", "summarize"};
  std::filesystem::path run;
  hlc::scenario::ScenarioChoices choices;
  std::optional<std::uint64_t> noise_seed;
  app.add_option("--run", run, "run folder")->required();
  hlc::apps::declare_scenario_flags(app, choices);
  app.add_option("--noise_seed", noise_seed, "of the run's measurement noise; default: no noise")
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  app.footer(
      "Exit codes: 0 success, 2 invalid input or an output that cannot be written, 5 driven, but a "
      "vehicle left its plan or touched another one, 6 driven, but a vehicle was stuck at the "
      "end.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, hlc::kExitBadInput)) {
    return *code;
  }
  return hlc::apps::exit_code_of(
      "summarize", [&] { return summarize_run(run, choices, noise_seed); }, hlc::kExitBadInput);
}
