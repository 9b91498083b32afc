// Writes a run folder as a CommonRoad 2020a file: map, planning problems, planned and driven motion
// every 10 ms.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/commonroad_file.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/common/text_file.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

/// Time between two states; the maneuvers' inputs are constant in between.
constexpr hlc::Nanoseconds kInterval = 10'000'000;

hlc::record::ExportedVehicle exported(hlc::VehicleId id,
                                      std::span<const hlc::result::StepRecord> rows,
                                      const hlc::result::Drives& drives,
                                      const hlc::result::RunFacts& facts,
                                      const hlc::automaton::UniversalAutomaton& automaton) {
  std::vector<const hlc::result::StepRecord*> own;
  for (const hlc::result::StepRecord& row : rows) {
    if (row.record.report.vehicle == id) own.push_back(&row);
  }
  const std::string name = fmt::format("vehicle {}", id.value);
  if (own.size() < 2) throw std::runtime_error(name + ": fewer than two steps were reported");
  const bool is_whole = hlc::is_driven_to_end(facts.exit_code);
  if (is_whole && own.size() < facts.steps) {
    throw std::runtime_error(fmt::format("reports.csv: {} steps of {}, must be the {} of run.json",
                                         own.size(), name, facts.steps));
  }
  hlc::record::ExportedVehicle vehicle{
      .id = id,
      .planned = hlc::result::planned_motion(own, facts.period, kInterval, automaton),
      .driven = {}};
  const auto drive = drives.find(id.value);
  if (drive == drives.end()) throw std::runtime_error(name + ": no record of what it drove");
  vehicle.driven = hlc::result::driven_motion(drive->second, *facts.first_step * facts.period,
                                              kInterval, vehicle.planned.size());
  if (vehicle.driven.size() < 2) throw std::runtime_error(name + ": drove less than a step");
  const std::size_t per_step = facts.period / kInterval;
  if (is_whole && vehicle.driven.size() + per_step < vehicle.planned.size()) {
    throw std::runtime_error(fmt::format(
        "{}: the record of what it drove ends {} steps before its plan; the run must be "
        "complete",
        name, (vehicle.planned.size() - vehicle.driven.size()) / per_step));
  }
  return vehicle;
}

std::string export_run(const std::filesystem::path& run,
                       const hlc::scenario::ScenarioChoices& choices) {
  const hlc::result::RunFacts facts = hlc::record::read_facts(run / "run.json");
  const std::vector<hlc::ReportRecord> reports = hlc::record::read_reports(run / "reports.csv");
  if (!facts.first_step) throw std::runtime_error("run.json: first_step is null: no vehicle drove");
  if (facts.period == 0 || facts.period % kInterval != 0) {
    throw std::runtime_error(
        fmt::format("run.json: period_ns = {}, must be a multiple of {}", facts.period, kInterval));
  }
  const hlc::scenario::Scenario scenario =
      hlc::scenario::read_scenario(choices.file.empty() ? hlc::record::kept_choices(run) : choices);
  hlc::result::RunDescription description = hlc::result::describe(scenario, std::nullopt);
  hlc::result::check_run(facts, description);
  hlc::record::add_obstacles(hlc::record::kept_forks(run), description);
  const hlc::result::Drives drives = hlc::record::read_drives(run, facts.vehicle_ids);
  const std::vector<hlc::result::StepRecord> rows =
      hlc::result::step_records(reports, drives, facts);
  std::vector<hlc::record::ExportedVehicle> vehicles;
  for (const std::uint8_t id : facts.vehicle_ids) {
    vehicles.push_back(
        exported(hlc::VehicleId{id}, rows, drives, facts, scenario.subgraph->automaton()));
  }
  std::vector<hlc::ConvexPolygon> obstacles_m;
  std::ranges::transform(description.obstacles, std::back_inserter(obstacles_m),
                         &hlc::result::Obstacle::area_m);
  const hlc::road::LaneletMap map = scenario.map_file
                                        ? hlc::road::read_lanelet_map(*scenario.map_file)
                                        : hlc::record::open_ground(vehicles, obstacles_m);
  return hlc::record::commonroad_xml(map, scenario.subgraph->automaton().vehicle, vehicles,
                                     obstacles_m, 1e-9 * static_cast<double>(kInterval));
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Writes a run as a CommonRoad 2020a file: the map, a planning problem per vehicle, planned "
      "and driven motion every 10 ms.",
      "export_commonroad"};
  std::filesystem::path run;
  hlc::scenario::ScenarioChoices choices;
  hlc::apps::OutputFile out{.flag = "--out", .file = {}};
  hlc::apps::declare_run(app, run);
  hlc::apps::declare_output(app, out, "CommonRoad file (XML)")->required();
  hlc::apps::declare_scenario_flags(app, choices);
  app.get_option("--scenario")
      ->required(false)
      ->description(
          "file (YAML), or the name of one of launch_scripts/scenarios; default: this and the "
          "following from the run folder");
  for (CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (name != "--help" && name != "--run" && name != "--out" && name != "--scenario") {
      option->needs("--scenario");
    }
  }
  hlc::apps::declare_help_end(
      app, {.examples = {
                "export_commonroad runs/my_run --out run.xml",
                "export_commonroad --run runs/by_hand --scenario paper_red_alone --out run.xml"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  const auto write = [&] {
    hlc::apps::check_output_files({out}, {run / "run.json", run / "reports.csv"});
    hlc::write_file(*out.file, export_run(run, choices));
  };
  return hlc::apps::exit_code_of("export_commonroad", write);
}
