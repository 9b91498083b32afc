// Builds the universal automaton of a configuration and writes it to a file.
#include <fmt/format.h>

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

#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/maneuver_table.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/plot/automaton_data.hpp"
#include "planner/plot/drawing.hpp"

namespace {

namespace fs = std::filesystem;

struct Choices {
  fs::path configuration;
  hlc::apps::OutputFile out{"--out", {}};
  hlc::apps::OutputFile table{"--table", {}};
  hlc::apps::OutputFile plot{"--plot", {}};
  std::optional<std::size_t> intervals;
  std::size_t jobs{};
};

[[noreturn]] void fail(const std::string& place, const std::string& allowed,
                       const std::string& reason) {
  throw std::invalid_argument(place + ", must be " + allowed + "; " + reason);
}

hlc::automaton::UniversalAutomaton built(
    const hlc::maneuver_design::AutomatonConfiguration& configuration, std::size_t jobs) {
  const std::vector<hlc::maneuver_design::DesignTask> tasks =
      hlc::maneuver_design::design_tasks(configuration);
  std::vector<hlc::automaton::Maneuver> maneuvers(tasks.size());
  const hlc::apps::Interruption interruption(
      "build_automaton", "nothing is written yet: the same command begins from the start");
  const hlc::apps::ProgressLine progress("maneuver", tasks.size());
  hlc::apps::run_parallel(
      tasks.size(), jobs,
      [&](std::size_t i) { maneuvers[i] = hlc::maneuver_design::design(configuration, tasks[i]); },
      [&](std::size_t done) { progress.show(done); });
  return hlc::maneuver_design::assembled(configuration, std::move(maneuvers));
}

/// A speed limit may have removed maneuvers.
void check_subgraphs(const hlc::automaton::AutomatonFile& file,
                     const hlc::maneuver_design::ConfigurationPlaces& places) {
  for (std::size_t i = 0; i < file.subgraphs.size(); ++i) {
    try {
      hlc::automaton::check_driving(hlc::automaton::Subgraph(file.automaton, file.subgraphs[i]),
                                    file.horizon_steps);
    } catch (const std::invalid_argument& error) {
      const hlc::maneuver_design::ConfigurationPlaces::Subgraph& place = places.subgraphs[i];
      if (place.max_speed_mps.empty())
        fail(place.trims, "a set that the maneuvers connect", error.what());
      fail(place.max_speed_mps, "a limit that leaves every trim a way from and to standstill",
           error.what());
    }
  }
}

int run(const Choices& choices) {
  if (hlc::automaton::is_automaton_file(choices.configuration)) {
    throw std::invalid_argument(choices.configuration.string() +
                                ": a built automaton, must be a configuration");
  }
  const hlc::maneuver_design::AutomatonConfiguration configuration =
      hlc::maneuver_design::read_automaton_configuration(choices.configuration);
  hlc::apps::check_output_files({choices.out, choices.table, choices.plot},
                                {choices.configuration});
  hlc::maneuver_design::AutomatonConfiguration to_build = configuration;
  if (choices.intervals) {
    to_build.intervals = *choices.intervals;
    to_build.places.intervals = fmt::format("--intervals = {}", *choices.intervals);
  }
  const auto begin = std::chrono::steady_clock::now();
  const hlc::automaton::AutomatonFile file = hlc::maneuver_design::file_of(
      configuration, built(to_build, choices.jobs), choices.intervals);
  check_subgraphs(file, configuration.places);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  hlc::automaton::write_automaton_file(file, *choices.out.file);
  if (const auto& table = choices.table.file) {
    hlc::write_file(*table, hlc::apps::maneuver_table(*file.automaton));
  }
  std::printf("%s: %zu trims, %zu maneuvers, labels", choices.out.file->c_str(),
              configuration.trims.size(),
              file.automaton->maneuvers.size() - configuration.trims.size());
  for (const std::string& label : file.labels) std::printf(" %s", label.c_str());
  std::printf(", built in %.2f s\n", wall_s);
  const auto& plot = choices.plot.file;
  return plot ? hlc::plot::draw("automaton", hlc::plot::automaton_data(file), *plot) : 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Builds the automaton of a configuration: designs all maneuvers, writes a file.",
      "build_automaton"};
  Choices choices;
  choices.jobs = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("CONFIGURATION", choices.configuration, "automaton configuration (YAML)")
      ->required()
      ->type_name("FILE");
  hlc::apps::declare_output(app, choices.out, "automaton file to write (YAML)")->required();
  hlc::apps::declare_output(app, choices.table, "write a table of all maneuvers (CSV)");
  hlc::apps::declare_output(app, choices.plot, "draw trims and maneuvers (SVG, PDF)");
  app.add_option("--intervals", choices.intervals,
                 "intervals of constant input, instead of the configuration's")
      ->check(hlc::apps::whole(10, 1000));
  app.add_option("--jobs", choices.jobs, "maneuvers designed at a time")
      ->check(hlc::apps::whole(1, 256))
      ->capture_default_str();
  hlc::apps::declare_help_end(
      app,
      {.examples =
           {"build_automaton launch_scripts/automata/paper.yaml --out /tmp/paper_automaton.yaml",
            "build_automaton my_car.yaml --out my_automaton.yaml --table maneuvers.csv --plot "
            "maneuvers.svg"},
       .exit_codes = "0 success, 2 invalid input or an output that cannot be written, 3 all but "
                     "the drawing, 130 interrupted"});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("build_automaton", [&choices] { return run(choices); });
}
