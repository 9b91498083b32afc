// Reads a run folder, writes steps.csv, timing.csv, summary.json, the run's configuration and
// run.html, prints the table.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/mcap/merge.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/log_files.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/record/step_files.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/result/summary_table.hpp"
#include "hlc_bridge/view/run_page.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_options.hpp"

namespace {

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

/// What stands out in a run, for its page: the faults of the drive and of the records.
std::string faults_of(const Verdict& verdict, const std::vector<std::string>& incomplete) {
  std::string faults = verdict.fault;
  for (const std::string& line : incomplete) faults += (faults.empty() ? "" : "; ") + line;
  return faults;
}

std::filesystem::path page_file(const std::filesystem::path& run) { return run / "run.html"; }

/// The result does not depend on the page: a failure is one line. @return whether it is written
bool write_page(const std::filesystem::path& run, const hlc::scenario::Scenario& scenario,
                hlc::view::FinishedRun page) {
  try {
    if (scenario.map_file) page.map = hlc::road::read_lanelet_map(*scenario.map_file);
    page.log = hlc::record::read_logs(run / "logs", page.facts);
    page.time = page.facts.simulated_time ? "logical time" : "real time";
    page.revision = hlc::program_revision();
    hlc::write_file(page_file(run), hlc::view::run_page(page));
    return true;
  } catch (const std::exception& error) {
    std::cerr << "summarize: no run.html: " << error.what() << '\n';
    return false;
  }
}

/// The page of an earlier summary may show another result. @throws
/// std::filesystem::filesystem_error
void remove_old_page(const std::filesystem::path& run) {
  if (std::filesystem::is_regular_file(page_file(run))) std::filesystem::remove(page_file(run));
}

/// run.mcap of the parts that the processes recorded, if they did. They stay if one was cut off:
/// its process may still publish. The result does not depend on it.
/// @return whether there is nothing to write, or it is written
bool write_messages(const std::filesystem::path& run) {
  const std::filesystem::path folder = run / "messages";
  try {
    std::vector<std::filesystem::path> parts;
    if (std::filesystem::is_directory(folder)) {
      for (const auto& entry : std::filesystem::directory_iterator(folder)) parts.push_back(entry);
    }
    if (parts.empty()) return true;
    std::ranges::sort(parts);
    const hlc::mcap::Merged merged = hlc::mcap::merge(parts, {}, run / "run.mcap");
    if (merged.cut_off.empty()) std::filesystem::remove_all(folder);
    for (const std::filesystem::path& part : merged.cut_off) {
      std::cerr << "summarize: " << part.string()
                << ": ends early: its process was killed, or still publishes\n";
    }
    return true;
  } catch (const std::exception& error) {
    std::cerr << "summarize: no run.mcap: " << error.what() << '\n';
    return false;
  }
}

struct Choices {
  std::filesystem::path run;
  hlc::record::RunChoices given;
  bool page{true};
};

/// Returns the exit code.
int summarize_run(const Choices& choices) {
  const std::filesystem::path& run = choices.run;
  hlc::record::RunFolder read = hlc::record::read_run_folder(run, choices.given);
  for (const std::string& line : read.incomplete) {
    std::cerr << "summarize: " << run.string() << ": " << line << '\n';
  }

  hlc::result::RunSummary summary =
      hlc::result::summarize(read.description, read.facts, read.rows, read.drives);
  summary.revision = hlc::program_revision();
  summary.host = hlc::record::this_host();
  remove_old_page(run);
  hlc::write_file(run / "steps.csv", hlc::record::steps_csv(read.rows));
  hlc::write_file(run / "timing.csv", hlc::record::timing_csv(read.rows));
  hlc::write_file(run / "summary.json", hlc::record::summary_json(summary));
  hlc::record::keep_configuration(run, hlc::scenario::files_of(read.scenario));
  Verdict verdict = verdict_on(summary);
  bool has_page = false;
  if (choices.page) {
    hlc::view::FinishedRun page;
    page.description = std::move(read.description);
    page.facts = std::move(read.facts);
    page.rows = std::move(read.rows);
    page.drives = std::move(read.drives);
    page.fault = faults_of(verdict, read.incomplete);
    has_page = write_page(run, read.scenario, std::move(page));
    if (!has_page && verdict.exit_code == hlc::kExitGood) verdict.exit_code = hlc::kExitBadInput;
  }
  if (!write_messages(run) && verdict.exit_code == hlc::kExitGood) {
    verdict.exit_code = hlc::kExitBadInput;
  }
  std::cout << hlc::result::summary_table(summary) << "\nrun folder: " << run.string() << '\n';
  if (has_page) std::cout << "the run as a page: " << page_file(run).string() << '\n';
  if (!verdict.fault.empty()) std::cerr << "summarize: " << verdict.fault << '\n';
  return verdict.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Result of a run: table, summary.json, steps.csv, timing.csv, run.html.",
               "summarize"};
  Choices choices;
  app.add_option("--run", choices.run, "run folder")->required();
  hlc::apps::declare_scenario_flags(app, choices.given.scenario);
  app.get_option("--scenario")
      ->required(false)
      ->description(
          "scenario file (YAML); this and the following are for a run without "
          "configuration/flags.yaml; of other runs they must be the run's own");
  app.add_option("--page", choices.page, "false: no run.html")->capture_default_str();
  app.add_option("--noise_seed", choices.given.noise_seed,
                 "of the run's measurement noise; default: no noise")
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  app.footer(
      "Exit codes: 0 success, 2 invalid input or an output that cannot be written, 5 driven, but a "
      "vehicle left its plan or touched another one, 6 driven, but a vehicle was stuck at the "
      "end.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, hlc::kExitBadInput)) {
    return *code;
  }
  if (app.count("--profile") == 0) choices.given.scenario.profile.clear();
  return hlc::apps::exit_code_of(
      "summarize", [&] { return summarize_run(choices); }, hlc::kExitBadInput);
}
