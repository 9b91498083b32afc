// Checks a scenario, prints its vehicles and starts (with --print_starts in a form for scripts) and
// draws it.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/plot/drawing.hpp"
#include "planner/plot/scenario_data.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

/// Of vehicles that have one of their own, and sections of their routes.
void print_speeds(const hlc::scenario::Scenario& scenario) {
  for (const hlc::scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    if (vehicle.reference_speed_mps) {
      std::printf("speed      %s, %g m/s\n", vehicle.name.c_str(), *vehicle.reference_speed_mps);
    }
    for (const hlc::road::SpeedSection& section : vehicle.speed_sections) {
      std::printf("section    %s, %.3f ... %.3f m, %g m/s\n", vehicle.name.c_str(),
                  section.from_s_m, section.to_s_m, section.speed_mps);
    }
  }
}

void print_table(const hlc::scenario::Scenario& scenario) {
  std::printf("scenario   %s, %zu steps of %g s, horizon %zu steps\n", scenario.name.c_str(),
              scenario.steps, scenario.subgraph->automaton().step_s, scenario.horizon_steps);
  std::printf("map        %s\n",
              scenario.map_file ? scenario.map_file->c_str() : "none (no lanes)");
  std::printf("automaton  %s, subgraph %s\n", scenario.automaton_file.c_str(),
              scenario.subgraph->spec().name.c_str());
  std::printf("lab        %s\n",
              scenario.lab_file ? scenario.lab_file->c_str() : "none (no limits)");
  std::printf("profile    %s\n", scenario.profile.name.c_str());
  if (!scenario.policies.empty()) {
    std::string names = hlc::policy::kNoPolicy;
    for (const auto& [name, settings] : scenario.policies) names += ", " + name;
    std::printf("policy     %s (of %s)\n", scenario.policy.c_str(), names.c_str());
    const bool is_reference =
        scenario.reconfiguration.zones_limit == hlc::policy::ZonesLimit::kReference;
    for (const hlc::policy::SpeedZone& zone : scenario.reconfiguration.zones) {
      std::printf("zone       %g m/s%s, x %g ... %g m, y %g ... %g m\n", zone.max_speed_mps,
                  is_reference ? " of the reference" : "", zone.min_x_m, zone.max_x_m, zone.min_y_m,
                  zone.max_y_m);
    }
  }
  for (const hlc::scenario::ScenarioObstacle& one : scenario.obstacles) {
    const hlc::Box box = hlc::bounding_box(one.area_m);
    std::printf("obstacle   %s, x %.3f ... %.3f m, y %.3f ... %.3f m\n", one.name.c_str(),
                box.min_m.x(), box.max_m.x(), box.min_m.y(), box.max_m.y());
  }
  print_speeds(scenario);
  std::printf("%4s  %-10s %9s %9s %9s %11s\n", "id", "name", "path [m]", "start [m]", "x [m]",
              "y [m]");
  for (const hlc::scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    std::printf("%4d  %-10s %9.3f %9.3f %9.3f %11.3f\n", vehicle.id.value, vehicle.name.c_str(),
                vehicle.path.length_m(), vehicle.start_s_m, vehicle.start.x_m, vehicle.start.y_m);
  }
  for (const hlc::scenario::ScenarioGuest& one : scenario.guests) {
    std::printf("%4d  %-10s %9s %9s %9.3f %11.3f   guest, at most %g m/s\n",
                one.guest.vehicle.value, one.name.c_str(), "-", "-", one.start.x_m, one.start.y_m,
                one.guest.limits.speed_mps);
  }
}

/// One line per vehicle: id, start pose of the vehicle (yaw) for `vehicle_sim --pose`, and its
/// `--stamps`.
void print_starts(const hlc::scenario::Scenario& scenario) {
  const char* stamps = hlc::scenario::has_early_stamps(scenario) ? "lab" : "exact";
  for (const hlc::scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    const hlc::Pose pose = hlc::scenario::measured_start(scenario, vehicle);
    std::printf("%d %.17g,%.17g,%.17g %s\n", vehicle.id.value, pose.x_m, pose.y_m, pose.heading_rad,
                stamps);
  }
}

/// What to print instead of the table.
struct Parts {
  bool starts{};
  bool steps{};
  bool period{};
  bool guests{};
};

/// Ids of all guests, then of those that are driven by hand, as flags take them; "-" for none.
std::string guest_ids(const hlc::scenario::Scenario& scenario) {
  std::vector<unsigned> all;
  std::vector<unsigned> by_hand;
  for (const hlc::scenario::ScenarioGuest& one : scenario.guests) {
    all.push_back(one.guest.vehicle.value);
    if (one.drive == hlc::scenario::GuestDrive::kByHand) by_hand.push_back(all.back());
  }
  const auto text_of = [](const std::vector<unsigned>& ids) {
    return ids.empty() ? "-" : fmt::format("{}", fmt::join(ids, ","));
  };
  return text_of(all) + " " + text_of(by_hand);
}

void print(const hlc::scenario::Scenario& scenario, const Parts& parts) {
  if (parts.starts) print_starts(scenario);
  if (parts.steps) std::printf("%zu\n", scenario.steps);
  if (parts.period) std::printf("%g\n", 1e3 * scenario.subgraph->automaton().step_s);
  if (parts.guests) std::printf("%s\n", guest_ids(scenario).c_str());
  if (!parts.starts && !parts.steps && !parts.period && !parts.guests) print_table(scenario);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{"Checks a scenario file and describes a run of it.", "show_scenario"};
  hlc::scenario::ScenarioChoices choices;
  Parts parts;
  hlc::apps::OutputFile plot{"--plot", {}};
  hlc::apps::declare_scenario_flags(app, choices);
  app.add_option("--steps", choices.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  app.add_flag("--print_starts", parts.starts,
               "print only `id x,y,yaw stamps` per vehicle (the next one may follow)");
  app.add_flag("--print_steps", parts.steps, "print only the number of steps");
  app.add_flag("--print_period", parts.period, "print only the duration of a step [ms]");
  app.add_flag(
      "--print_guests", parts.guests,
      "print only the ids of all guests and of those driven by hand, as 29,30 30; - for none");
  hlc::apps::declare_output(app, plot,
                            "draw lanes, reference paths and cars at the start (SVG, PDF); with "
                            "--print_starts also their poses: a sheet to place them by");
  hlc::apps::declare_help_end(
      app, {.examples = {"show_scenario --scenario paper_three_cars",
                         "show_scenario --scenario lab_cars --cars 10 --seed 3 --plot start.svg"},
            .exit_codes =
                "0 success, 2 invalid input or an output that cannot be written, 3 not drawn"});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, {{"--starts", "--print_starts"}})) {
    return *code;
  }
  const auto run = [&] {
    std::vector<std::filesystem::path> inputs{choices.file};
    if (choices.map_file) inputs.push_back(*choices.map_file);
    hlc::apps::check_output_files({plot}, inputs);
    const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
    hlc::apps::check_output_files({plot}, hlc::scenario::files_of(scenario));
    print(scenario, parts);
    if (!plot.file) return 0;
    return hlc::plot::draw(parts.starts ? "sheet" : "scenario", hlc::plot::scenario_data(scenario),
                           *plot.file);
  };
  return hlc::apps::exit_code_of("show_scenario", run);
}
