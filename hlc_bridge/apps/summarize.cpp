// Reads a run folder, writes steps.csv, timing.csv, summary.json, the run's configuration and
// run.html, prints the table.
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
#include "hlc_bridge/record/log_files.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/record/step_files.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/result/summary_table.hpp"
#include "hlc_bridge/view/run_page.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/road/lanelet_map.hpp"
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

/// What a run that was driven gets from its result: the exit code, and why it is not 0.
struct Verdict {
  int exit_code{hlc::kExitGood};
  std::string fault;
};

Verdict verdict_on(const hlc::result::RunSummary& summary) {
  if (std::string fault = hlc::result::driving_fault(summary); !fault.empty()) {
    return {hlc::kExitDrivenBadly, std::move(fault)};
  }
  const auto stuck = hlc::result::stuck_vehicles(summary);
  if (stuck.empty()) return {};
  return {hlc::kExitStuck, "stuck at the end: vehicles " + hlc::record::ids_to_text(stuck)};
}

/// run.html. The result does not depend on it: a failure is one line.
void write_page(const std::filesystem::path& run, const hlc::scenario::Scenario& scenario,
                hlc::view::FinishedRun page) {
  try {
    if (scenario.map_file) page.map = hlc::road::read_lanelet_map(*scenario.map_file);
    page.log = hlc::record::read_logs(run / "logs", page.facts);
    page.time = page.facts.simulated_time ? "logical time" : "real time";
    page.revision = hlc::program_revision();
    hlc::write_file(run / "run.html", hlc::view::run_page(page));
  } catch (const std::exception& error) {
    std::cerr << "summarize: no run.html: " << error.what() << '\n';
  }
}

struct Choices {
  std::filesystem::path run;
  hlc::scenario::ScenarioChoices scenario;
  std::optional<std::uint64_t> noise_seed;
  bool page{true};
};

/// Returns the exit code.
int summarize_run(const Choices& choices) {
  const std::filesystem::path& run = choices.run;
  const std::vector<hlc::ReportRecord> reports = hlc::record::read_reports(run / "reports.csv");
  hlc::result::RunFacts facts = hlc::record::read_facts(run / "run.json");
  if (!facts.first_step) {
    facts.first_step = hlc::result::first_step_of(reports);  // the lab control did not end the run
  }
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices.scenario);
  const hlc::result::RunDescription description =
      hlc::result::describe(scenario, choices.noise_seed);
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
  const Verdict verdict = verdict_on(summary);
  if (choices.page) {
    hlc::view::FinishedRun page;
    page.description = description;
    page.facts = facts;
    page.rows = rows;
    page.drives = drives;
    page.fault = verdict.fault;
    write_page(run, scenario, std::move(page));
  }
  std::cout << hlc::result::summary_table(summary) << "\nrun folder: " << run.string() << '\n';
  if (!verdict.fault.empty()) std::cerr << "summarize: " << verdict.fault << '\n';
  return verdict.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Result of a run: table, summary.json, steps.csv, timing.csv, run.html.",
               "summarize"};
  Choices choices;
  app.add_option("--run", choices.run, "run folder")->required();
  hlc::apps::declare_scenario_flags(app, choices.scenario);
  app.add_option("--page", choices.page, "false: no run.html")->capture_default_str();
  app.add_option("--noise_seed", choices.noise_seed,
                 "of the run's measurement noise; default: no noise")
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  app.footer(
      "Exit codes: 0 success, 2 invalid input or an output that cannot be written, 5 driven, but a "
      "vehicle left its plan or touched another one, 6 driven, but a vehicle was stuck at the "
      "end.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, hlc::kExitBadInput)) {
    return *code;
  }
  return hlc::apps::exit_code_of(
      "summarize", [&] { return summarize_run(choices); }, hlc::kExitBadInput);
}
