// Drives a campaign of whole runs within one process and writes their rows; tables, statistics and
// figures are made from these by vehicle_sim/report.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hlc_bridge/record/program.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/scenario_name.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/apps/drive_campaign.hpp"
#include "vehicle_sim/apps/drive_sweep.hpp"
#include "vehicle_sim/apps/evaluation_files.hpp"
#include "vehicle_sim/apps/evaluation_results.hpp"
#include "vehicle_sim/apps/evaluation_series.hpp"
#include "vehicle_sim/apps/merged_rows.hpp"
#include "vehicle_sim/apps/missing_runs.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

namespace {

using Clock = std::chrono::steady_clock;

struct Choices {
  hlc::campaign::CampaignPlan plan;
  std::vector<std::string> scenarios{"paper_three_cars", "paper_red_alone"};
  std::filesystem::path scenario_folder;
  hlc::apps::DriveChoices drive;
  std::string shard;                          ///< "2/20"; empty: all runs
  std::vector<std::filesystem::path> merged;  ///< not empty: no run is driven
  std::filesystem::path out;
  bool writes_series{};
  bool makes_report{};
  bool is_sweep{false};  ///< otherwise a campaign
  std::filesystem::path sweep;
};

constexpr std::uint64_t kLargestSeed = 1'000'000'000'000;
constexpr std::uint64_t kMostShards = 100'000;

/// A file, or the name of one in the folder of scenarios.
std::filesystem::path scenario_file(const Choices& choices, const std::string& name) {
  if (std::filesystem::exists(name) && std::filesystem::is_regular_file(name)) return name;
  const std::filesystem::path file = choices.scenario_folder / (name + ".yaml");
  if (std::filesystem::exists(file)) return file;
  throw std::invalid_argument("--scenario = " + name + ", must be a file or the name of one in " +
                              choices.scenario_folder.string());
}

std::filesystem::path series_folder(const Choices& choices) { return choices.out / "series"; }

/// All input of the campaign. A file that cannot be read is invalid input.
hlc::campaign::Campaign read(Choices& choices) {
  for (const std::string& name : choices.scenarios) {
    choices.plan.scenarios.push_back(scenario_file(choices, name));
  }
  // Tables and figures identify scenarios by their names.
  std::vector<std::string> names;
  for (const auto& file : choices.plan.scenarios) names.push_back(file.stem().string());
  hlc::apps::check_each_once("--scenario", names);
  hlc::apps::check_each_once("--profile", choices.plan.profiles);
  hlc::apps::check_each_once("--subgraphs", choices.plan.subgraphs);
  hlc::apps::check_each_once("--policies", choices.plan.policies);
  if (std::ranges::find(choices.plan.policies, "") != choices.plan.policies.end()) {
    throw std::invalid_argument("--policies: an empty name, must be a policy of the scenario");
  }
  const std::filesystem::path folder = series_folder(choices);
  if (choices.writes_series && std::filesystem::exists(folder) &&
      !std::filesystem::is_directory(folder)) {
    throw std::invalid_argument("--out = " + choices.out.string() +
                                ": series must be a folder or absent");
  }
  try {
    return hlc::campaign::Campaign(choices.plan);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

hlc::campaign::Sweep read_sweep(const Choices& choices) {
  try {
    return hlc::campaign::Sweep(hlc::campaign::read_sweep(choices.sweep));
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

int run_sweep(const Choices& choices, const std::string& command) {
  hlc::campaign::Sweep sweep = read_sweep(choices);
  hlc::apps::SweepFiles files(choices.out, sweep);
  const Clock::time_point begin = Clock::now();
  const std::size_t failed = hlc::apps::drive_sweep(sweep, choices.drive.jobs, files);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  files.finish(hlc::apps::origin_of(command));
  std::printf("%zu runs, %zu do not count, %.1f s; %s\n", sweep.runs().size(), failed, wall_s,
              (choices.out / "runs.csv").c_str());
  return failed == 0 ? 0 : 1;
}

/// Prints the outcome of the rows. @return the exit code
int conclude(const hlc::apps::RunLog& rows, double wall_s, const char* results) {
  const std::vector<hlc::campaign::RunFigures> figures = hlc::apps::figures_of_rows(rows);
  const auto stuck = std::ranges::count_if(
      figures, [](const hlc::campaign::RunFigures& run) { return run.stuck_vehicles > 0; });
  const std::size_t failed = hlc::apps::num_failed(figures);
  std::printf("%zu runs, %zu failed, %td with a car stuck at the end, %.1f s; %s\n", figures.size(),
              failed, stuck, wall_s, (rows.folder() / results).c_str());
  return failed == 0 ? 0 : 1;
}

int merge(const Choices& choices, const std::string& command) {
  const Clock::time_point begin = Clock::now();
  const hlc::apps::RunRows merged = hlc::apps::merge_rows(choices.merged);
  hlc::apps::RunLog rows(choices.out, merged.heading);
  if (rows.size() > 0) {
    throw std::invalid_argument("--out = " + choices.out.string() +
                                ": has rows already, must be a new folder");
  }
  for (const auto& [run, row] : merged.rows) rows.append(run, row);
  hlc::apps::write_results(rows, hlc::apps::origin_of(command));
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return conclude(rows, wall_s, "runs.csv");
}

int run(Choices choices, const std::string& command) {
  const hlc::apps::Interruption interruption(
      "evaluate", "finished runs are kept, and the same command goes on with the others");
  if (choices.is_sweep) return run_sweep(choices, command);
  if (!choices.merged.empty()) return merge(choices, command);
  const hlc::campaign::Campaign campaign = read(choices);
  hlc::apps::EvaluationFiles files(choices.out, campaign);
  const Clock::time_point begin = Clock::now();
  hlc::apps::drive_campaign(campaign, choices.drive, files);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  if (!choices.shard.empty()) return conclude(files.rows(), wall_s, "runs.jsonl");
  hlc::apps::write_results(files.rows(), hlc::apps::origin_of(command));
  const int code = conclude(files.rows(), wall_s, "runs.csv");
  if (choices.writes_series) {
    hlc::apps::write_series(campaign, choices.drive.jobs, series_folder(choices));
  }
  return code;
}

void declare_campaign(CLI::App& app, Choices& choices) {
  choices.plan.profiles = {"default"};
  choices.scenario_folder = hlc::apps::shipped_scenarios();
  app.add_option("--scenario", choices.scenarios,
                 "scenario files (YAML), or names of files in --scenario_folder")
      ->delimiter(',')
      ->type_name("SCENARIO")
      ->capture_default_str();
  app.add_option("--scenario_folder", choices.scenario_folder,
                 "folder of the scenarios (default: scenarios beside the program)")
      ->type_name("DIR");
  hlc::apps::declare_profile_flag(app, choices.plan.profiles)->delimiter(',');
  app.add_option("--subgraphs", choices.plan.subgraphs,
                 "fixed ones of the automaton, as A,B,C,D, driven without a policy; default: the "
                 "scenario's own")
      ->delimiter(',');
  app.add_option("--policies", choices.plan.policies,
                 "of the scenario: drives it also on its own subgraph with each of these policies; "
                 "default: no policy drives, not even the scenario's own")
      ->delimiter(',');
  app.add_option("--starts", choices.plan.starts,
                 "number of starts: the scenario's own, then random ones on the routes, or other "
                 "draws of the cars")
      ->check(hlc::apps::whole(1, 100'000))
      ->capture_default_str();
  app.add_option("--seed", choices.plan.seed, "of the random starts, and of cars drawn for them")
      ->check(hlc::apps::whole(0, kLargestSeed))
      ->capture_default_str();
  app.add_option("--steps", choices.plan.steps, "instead of the scenarios'")
      ->check(hlc::apps::whole(1, 100'000));
  app.add_option("--map", choices.plan.map_file, "CommonRoad XML instead of the scenarios'")
      ->type_name("FILE");
  app.add_option("--cars", choices.plan.cars,
                 "number of cars (scenarios on a circle, or that draw their cars), instead of the "
                 "scenarios'")
      ->check(hlc::apps::whole(1, hlc::kMaxVehicleId));
  app.add_option("--routes", choices.plan.routes,
                 "random: every car takes random turns forever, instead of the scenarios' routes")
      ->check(hlc::apps::among({hlc::scenario::kRandomRoutes}));
  app.add_option("--noise_seed", choices.plan.noise_seed,
                 "measurement noise of the simulated cars; default: none")
      ->check(hlc::apps::whole(0, kLargestSeed));
}

void declare_output(CLI::App& app, Choices& choices) {
  choices.drive.jobs = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("--jobs", choices.drive.jobs, "runs at a time")
      ->check(hlc::apps::whole(1, 256))
      ->capture_default_str();
  app.add_flag("--keep_runs", choices.drive.keep_runs,
               "also keep the run folder of each run, OUT/runs/<number>, as run_lab.sh leaves it, "
               "for export_commonroad and summarize");
  app.add_flag("--series", choices.writes_series,
               "also writes what figures are drawn from, OUT/series (vehicle_sim/report), also "
               "later for runs already driven");
  app.add_option("--out", choices.out,
                 "folder for runs.csv (a row per run), cars.csv (a row per run and car), "
                 "campaign.json; an interrupted campaign goes on")
      ->required()
      ->type_name("DIR");
  app.add_flag("--report", choices.makes_report,
               "also makes the page OUT/report.md from the rows: tables, statistics, figures "
               "(vehicle_sim/report; its Python packages are installed once, into "
               "build/report_environment)");
}

/// "2/20": the second of 20. Nothing if the text is none.
std::optional<hlc::apps::Shard> shard_of(const std::string& text) {
  const auto numbers = hlc::apps::two_whole_numbers(text, '/', kMostShards);
  if (!numbers || numbers->first > numbers->second) return std::nullopt;
  return hlc::apps::Shard{.index = numbers->first, .count = numbers->second};
}

/// `option` is alone with these and --help.
void exclude_all_but(CLI::App& app, CLI::Option* option, const std::vector<std::string>& names) {
  for (CLI::Option* other : app.get_options()) {
    const std::string name = other->get_name();
    if (name == "--help" || other == option || std::ranges::find(names, name) != names.end())
      continue;
    option->excludes(other);
  }
}

void declare_shards(CLI::App& app, Choices& choices) {
  const std::string allowed = fmt::format("I/N, 1 <= I <= N <= {}", kMostShards);
  app.add_option("--shard", choices.shard,
                 "drives only the I-th of N shares of the runs, I from 1, and writes runs.jsonl "
                 "alone: for job arrays, each with an --out of its own; default: all")
      ->check(hlc::apps::allowing(
          [](const std::string& text) { return shard_of(text).has_value(); }, allowed, allowed))
      ->excludes(app.get_option("--series"))
      ->excludes(app.get_option("--report"));
  CLI::Option* merge =
      app.add_option("--merge", choices.merged,
                     "the runs.jsonl of all shards of a campaign, as runs/*/runs.jsonl: drives "
                     "nothing, writes to --out what one call for all runs would have written; "
                     "default: none");
  merge->type_name("FILE");
  exclude_all_but(app, merge, {"--out", "--report"});
}

/// The option that replaces all the others that select the runs.
CLI::Option* declare(CLI::App& app, Choices& choices) {
  declare_campaign(app, choices);
  declare_output(app, choices);
  declare_shards(app, choices);
  CLI::Option* sweep = app.add_option(
      "--sweep", choices.sweep,
      "a file with the settings and their values (launch_scripts/sweeps/README.md): drives "
      "every combination instead of a campaign; default: none");
  sweep->type_name("FILE");
  exclude_all_but(app, sweep, {"--jobs", "--out", "--report"});
  hlc::apps::declare_help_end(
      app,
      {.examples =
           {"evaluate --subgraphs A,B,C,D --profile 2022 --starts 4 --out runs/table_2 --report",
            "evaluate --scenario town --cars 20 --starts 20 --shard 1/4 --out runs/town/1"},
       .exit_codes =
           "0 all runs driven, 1 some failed (reasons in runs.csv), 2 invalid input or an output "
           "that cannot be written; existing stays, 3 all but the report, 130 interrupted"});
  return sweep;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Simulates many runs and writes their rows; with --report, compares them with the paper's "
      "Table 2.",
      "evaluate"};
  Choices choices;
  CLI::Option* sweep = declare(app, choices);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  choices.is_sweep = sweep->count() > 0;
  choices.writes_series = choices.writes_series || choices.makes_report;
  choices.drive.shard = shard_of(choices.shard).value_or(hlc::apps::Shard{});
  // A failed run is recorded; any other error concerns an output.
  const int code = hlc::apps::exit_code_of(
      "evaluate", [&] { return run(choices, hlc::apps::command_line(argc, argv)); });
  if (code > 1 || !choices.makes_report) return code;
  return hlc::apps::make_report("evaluate", choices.out) ? code : hlc::apps::kExitNoReport;
}
