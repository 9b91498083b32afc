// Reads a run folder, writes steps.csv, timing.csv, summary.json, the run's configuration, run.html
// and run.mcap, prints the table.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hlc_bridge/apps/finished_run.hpp"
#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/mcap/merge.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/record/step_files.hpp"
#include "hlc_bridge/record/summary_file.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/result/summary_table.hpp"
#include "hlc_bridge/view/foxglove_channels.hpp"
#include "hlc_bridge/view/run_page.hpp"
#include "planner/apps/fitted_table.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/common/program_version.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_options.hpp"

namespace {

/// The page of an earlier summary may show another result.
void remove_old_page(const std::filesystem::path& run) {
  const std::filesystem::path page = hlc::apps::page_file(run);
  std::error_code error;
  if (std::filesystem::is_regular_file(page)) std::filesystem::remove(page, error);
  if (error) throw std::runtime_error(page.string() + ": cannot be replaced: " + error.message());
}

/// The parts of run.mcap that the processes recorded; none: they did not.
std::vector<std::filesystem::path> recorded_parts(const std::filesystem::path& run) {
  std::vector<std::filesystem::path> parts;
  if (!std::filesystem::is_directory(run / "messages")) return parts;
  for (const auto& entry : std::filesystem::directory_iterator(run / "messages")) {
    parts.push_back(entry);
  }
  std::ranges::sort(parts);
  return parts;
}

/// The parts stay if one of them was cut off: its process may still publish.
void write_messages(const std::filesystem::path& run,
                    const std::vector<std::filesystem::path>& parts,
                    const hlc::view::FinishedRun& finished) {
  const auto scene_from = [&finished](std::optional<hlc::Nanoseconds> recorded_from) {
    return hlc::view::foxglove_channels(finished, recorded_from);
  };
  const hlc::mcap::Merged merged = hlc::mcap::merge(parts, scene_from, run / "run.mcap");
  if (merged.cut_off.empty()) std::filesystem::remove_all(run / "messages");
  for (const std::filesystem::path& part : merged.cut_off) {
    std::cerr << "summarize: " << part.string()
              << ": ends early: its process was killed, or still publishes\n";
  }
}

struct Choices {
  std::filesystem::path run;
  hlc::record::RunChoices given;
  bool page{true};
};

/// What of the run folder shows the run.
struct Shown {
  bool page{};
  bool messages{};
};

/// Writes what is asked for, and notes what it has written.
void show(const Choices& choices, hlc::record::RunFolder read, std::string fault, Shown& shown) {
  const std::vector<std::filesystem::path> parts = recorded_parts(choices.run);
  if (!choices.page && parts.empty()) return;
  const hlc::view::FinishedRun finished =
      hlc::apps::finished_run(std::move(read), std::move(fault));
  if (choices.page) {
    hlc::write_file(hlc::apps::page_file(choices.run), hlc::view::run_page(finished));
    shown.page = true;
  }
  if (parts.empty()) return;
  write_messages(choices.run, parts, finished);
  shown.messages = true;
}

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
  hlc::apps::Verdict verdict = hlc::apps::verdict_on(summary);
  Shown shown;
  try {
    show(choices, std::move(read), verdict.fault, shown);
  } catch (const std::exception& error) {  // the result does not depend on it
    const char* const missing = choices.page && !shown.page ? "run.html" : "run.mcap";
    std::cerr << "summarize: no " << missing << ": " << error.what() << '\n';
    if (verdict.exit_code == hlc::kExitGood) verdict.exit_code = hlc::kExitBadInput;
  }
  std::cout << hlc::apps::fitted_table(hlc::result::summary_table(summary))
            << "\nrun folder: " << run.string() << '\n';
  if (shown.page) std::cout << "the run as a page: " << hlc::apps::page_file(run).string() << '\n';
  if (shown.messages) std::cout << "its messages: " << (run / "run.mcap").string() << '\n';
  if (!verdict.fault.empty()) std::cerr << "summarize: " << verdict.fault << '\n';
  return verdict.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Result of a run: table, summary.json, steps.csv, timing.csv, run.html, run.mcap.",
      "summarize"};
  Choices choices;
  hlc::apps::declare_run(app, choices.run);
  hlc::apps::declare_scenario_flags(app, choices.given.scenario);
  app.get_option("--scenario")
      ->required(false)
      ->description(
          "file (YAML), or the name of one of launch_scripts/scenarios; this and the following are "
          "for a run without configuration/flags.yaml (default: from there), with it they must be "
          "the run's own");
  app.add_option("--page", choices.page, "false: no run.html")->capture_default_str();
  app.add_option("--noise_seed", choices.given.noise_seed,
                 "of the run's measurement noise; default: no noise")
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  hlc::apps::declare_help_end(
      app, {.examples = {"summarize runs/my_run",
                         "summarize --run runs/by_hand --scenario paper_red_alone --page false"},
            .exit_codes = "0 success, 2 invalid input or an output that cannot be written, 5 "
                          "driven, but a vehicle left its plan or touched another one, 6 driven, "
                          "but a vehicle was stuck at the end"});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) {
    return *code;
  }
  if (app.count("--profile") == 0) choices.given.scenario.profile.clear();
  return hlc::apps::exit_code_of("summarize", [&] { return summarize_run(choices); });
}
