// Makes a scenario of a CommonRoad file's planning problems.

#include <iostream>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/commonroad_import.hpp"

namespace {

using hlc::scenario::CommonRoadImport;

void run(CommonRoadImport import, const hlc::apps::OutputFile& out) {
  hlc::apps::check_output_files({out}, {import.file, import.like});
  import.out = *out.file;
  const auto [text, scenario] = hlc::scenario::scenario_from_commonroad(import);
  hlc::write_file(*out.file, text);
  for (const hlc::scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    std::cout << fmt::format("vehicle {}: {}, {:.1f} m to its goal\n", vehicle.id.value,
                             vehicle.name, vehicle.path.length_m() - vehicle.start_s_m);
  }
  std::cout << fmt::format("{} steps of {} s, to the earliest end of the goals' times\n",
                           scenario.steps, scenario.subgraph->automaton().step_s);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Makes a scenario of the planning problems of a CommonRoad file, for all programs that take "
      "one. What the scenario cannot honour is refused by its name.",
      "import_commonroad"};
  CommonRoadImport import;
  hlc::apps::OutputFile out{"--out", {}};
  app.add_option("--commonroad", import.file,
                 "CommonRoad XML, 2020a or 2018b, with planning problems; the scenario names it as "
                 "its map")
      ->required()
      ->type_name("FILE");
  hlc::apps::declare_scenario(app, "--like", import.like,
                              ", whose vehicle drives: automaton, subgraph, speed and rules")
      ->required();
  app.add_option("--from_standstill", import.from_standstill,
                 "true: vehicles that move in their initial states begin standing there; false: "
                 "these are refused")
      ->capture_default_str();
  hlc::apps::declare_output(app, out, "file to write (YAML)")->required();
  hlc::apps::declare_help_end(
      app, {.examples = {
                "import_commonroad --commonroad problem.xml --like passenger_cars_in_town --out "
                "problem.yaml",
                "import_commonroad --commonroad problem.xml --like passenger_cars_in_town "
                "--from_standstill true --out problem.yaml"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("import_commonroad", [&] { run(import, out); });
}
