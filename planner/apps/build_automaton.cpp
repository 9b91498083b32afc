// Builds the universal automaton of a configuration and writes it to a file.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "planner/apps/automaton_plot.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/maneuver_table.hpp"
#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/automaton/atomic_write.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/built_automaton.hpp"

namespace {

namespace fs = std::filesystem;

struct Choices {
  fs::path configuration;
  fs::path out;
  std::optional<fs::path> table;
  std::optional<fs::path> plot;
  std::optional<std::size_t> intervals;
  std::size_t jobs{};
};

/// Nothing is computed for a file that cannot be written.
void check_outputs(const Choices& choices) {
  const auto check = [&](const char* flag, const std::optional<fs::path>& file) {
    if (!file) return;
    const fs::path folder = file->has_parent_path() ? file->parent_path() : fs::path(".");
    if (!fs::is_directory(folder)) {
      throw std::invalid_argument(std::string(flag) + " = " + file->string() +
                                  ", allowed a file in a folder that exists");
    }
    std::error_code error;
    if (fs::is_directory(*file) || fs::equivalent(*file, choices.configuration, error)) {
      throw std::invalid_argument(std::string(flag) + " = " + file->string() +
                                  ", allowed a file other than the configuration");
    }
  };
  check("--out", choices.out);
  check("--table", choices.table);
  check("--plot", choices.plot);
}

hlc::UniversalAutomaton built(const hlc::AutomatonConfiguration& configuration, std::size_t jobs) {
  const std::vector<hlc::DesignTask> tasks = hlc::design_tasks(configuration);
  std::vector<hlc::Maneuver> designed(tasks.size());
  const hlc::ProgressLine progress("maneuver", tasks.size());
  hlc::run_parallel(
      tasks.size(), jobs,
      [&](std::size_t i) { designed[i] = hlc::design(configuration, tasks[i]); },
      [&](std::size_t done) { progress.show(done); });
  return hlc::assembled(configuration, std::move(designed));
}

void run(const Choices& choices) {
  if (hlc::is_automaton_file(choices.configuration)) {
    throw std::invalid_argument(choices.configuration.string() +
                                ": a built automaton, allowed a configuration");
  }
  const hlc::AutomatonConfiguration configuration =
      hlc::read_automaton_configuration(choices.configuration);
  check_outputs(choices);
  hlc::AutomatonConfiguration to_build = configuration;
  to_build.intervals = choices.intervals.value_or(configuration.intervals);
  const auto begin = std::chrono::steady_clock::now();
  const hlc::AutomatonFile file =
      hlc::file_of(configuration, built(to_build, choices.jobs), choices.intervals);
  for (const hlc::SubgraphSpec& subgraph : file.subgraphs) {
    try {  // a speed limit may have taken maneuvers away
      hlc::check_driving(hlc::Subgraph(file.automaton, subgraph), file.horizon_steps);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(choices.configuration.string() + ": " + error.what());
    }
  }
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  hlc::write_automaton_file(file, choices.out);
  if (choices.table) hlc::write_atomically(hlc::maneuver_table(*file.automaton), *choices.table);
  if (choices.plot) hlc::write_atomically(hlc::automaton_plot(file), *choices.plot);
  std::printf("%s: %zu trims, %zu maneuvers, labels", choices.out.c_str(),
              configuration.trims.size(),
              file.automaton->maneuvers.size() - configuration.trims.size());
  for (const std::string& label : file.labels) std::printf(" %s", label.c_str());
  std::printf(", built in %.2f s\n", wall_s);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Builds the automaton of a configuration: designs all maneuvers, writes a file.",
               "build_automaton"};
  Choices choices;
  choices.jobs = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("CONFIG", choices.configuration, "configuration (YAML)")->required();
  app.add_option("--out", choices.out, "automaton file to write (YAML)")->required();
  app.add_option("--table", choices.table, "write a table of all maneuvers (CSV)");
  app.add_option("--plot", choices.plot, "draw trims and maneuvers (SVG)");
  app.add_option("--intervals", choices.intervals,
                 "intervals of constant input, instead of the configuration's")
      ->check(CLI::Range(10, 1000));
  app.add_option("--jobs", choices.jobs, "maneuvers designed at a time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.footer("Exit codes: 0 good, 1 a file cannot be written, 2 bad input.");
  if (const auto code = hlc::parse_flags(app, argc, argv)) return *code;
  return hlc::exit_code_of("build_automaton", [&choices] { run(choices); });
}
