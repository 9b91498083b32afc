// Planning and coordination without DDS and vehicle dynamics: all controllers of a scenario in one
// process, with vehicles that follow their plans perfectly. For a quick check of a scenario.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/coordination/joint_gap.hpp"
#include "planner/road/lap.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_engine.hpp"

namespace {

struct Choices {
  hlc::scenario::ScenarioChoices scenario;
  double lost{};                                                    ///< share of the messages
  std::size_t lost_steps{std::numeric_limits<std::size_t>::max()};  ///< none is lost later
  std::uint64_t loss_seed{1};
};

struct Tally {
  std::vector<hlc::Point> positions_m;  ///< planned, at the steps
  std::uint64_t generated_max{};
  std::uint64_t expanded_max{};
  int fallbacks{};
  int planned{};
  double driven_m{};  ///< by the plans
  double longest_wait_s{};
  hlc::coordination::Report last;
  int changed{};  ///< steps in which the others changed the plan
};

void add(Tally& tally, const hlc::coordination::Report& report, double step_s) {
  const hlc::Point position_m = report.planned_pose.position_m();
  if (!tally.positions_m.empty()) {
    tally.driven_m += (position_m - tally.positions_m.back()).norm();
  }
  tally.positions_m.push_back(position_m);
  tally.generated_max = std::max(tally.generated_max, report.generated);
  tally.expanded_max = std::max(tally.expanded_max, report.expanded);
  if (report.status == hlc::coordination::StepStatus::kFallback) ++tally.fallbacks;
  if (report.status == hlc::coordination::StepStatus::kPlanned) ++tally.planned;
  tally.longest_wait_s = std::max(tally.longest_wait_s, hlc::coordination::wait_s(report, step_s));
  tally.last = report;
}

std::string row_of(const Tally& tally, const hlc::scenario::ScenarioVehicle& vehicle,
                   double step_s) {
  const hlc::road::Progress progress = hlc::road::progress_along(vehicle.path, tally.positions_m);
  std::vector<double> times_s;
  double sum_m = 0.0;
  double max_m = 0.0;
  for (const double distance_m : progress.distance_m) {
    times_s.push_back(step_s * static_cast<double>(times_s.size()));
    sum_m += distance_m;
    max_m = std::max(max_m, distance_m);
  }
  const std::optional<double> lap_s =
      hlc::road::lap_s(vehicle.path, progress, times_s, hlc::road::kFirstStepDriven);
  const std::string lap = lap_s ? fmt::format("{:.2f}", *lap_s) : "-";
  return fmt::format("{:<10} {:>8} {:>12.1f} {:>11.1f} {:>14} {:>13} {:>10} {:>8} {:>9.1f}\n",
                     vehicle.name, lap, 1e3 * sum_m / static_cast<double>(times_s.size()),
                     1e3 * max_m, tally.generated_max, tally.expanded_max, tally.fallbacks,
                     tally.changed, tally.longest_wait_s);
}

/// True if the plan of this step would be different without the other vehicles.
/// @param standing_m  obstacles that are no vehicles
bool others_changed_the_plan(const hlc::controller::Controller& controller,
                             const std::vector<hlc::ConvexPolygon>& standing_m,
                             hlc::search::SearchEngine& alone,
                             const hlc::coordination::Report& report) {
  if (controller.problems().empty() || report.status != hlc::coordination::StepStatus::kPlanned)
    return false;
  hlc::search::HorizonProblem problem = controller.problems().back().problem;
  problem.obstacles_m.clear();
  if (!standing_m.empty()) problem.obstacles_m.assign(problem.horizon_steps(), standing_m);
  return alone.search(problem).cost < report.cost_m2 - 1e-9;
}

std::string line_of_all(const std::map<hlc::VehicleId, Tally>& tallies, std::size_t steps,
                        double step_s) {
  double driven_m = 0.0;
  double planned = 0.0;
  double longest_wait_s = 0.0;
  for (const auto& [id, tally] : tallies) {
    driven_m += tally.driven_m;
    planned += tally.planned;
    longest_wait_s = std::max(longest_wait_s, tally.longest_wait_s);
  }
  const auto car_steps = static_cast<double>(steps * tallies.size());
  return fmt::format("all: {:.3f} m/s, new plans in {:.1f} % of the steps, longest wait {:.1f} s\n",
                     driven_m / (step_s * (car_steps - static_cast<double>(tallies.size()))),
                     100.0 * planned / car_steps, longest_wait_s);
}

std::string result_of(const hlc::scenario::Scenario& scenario,
                      const std::map<hlc::VehicleId, Tally>& tallies,
                      const std::vector<hlc::coordination::JointGap>& gaps) {
  const double step_s = scenario.subgraph->automaton().step_s;
  std::string text = fmt::format("{:<10} {:>8} {:>12} {:>11} {:>14} {:>13} {:>10} {:>8} {:>9}\n",
                                 "vehicle", "lap [s]", "error [mm]", "max [mm]", "max generated",
                                 "max expanded", "fallbacks", "changed", "wait [s]");
  for (const auto& [id, tally] : tallies)
    text += row_of(tally, hlc::scenario::vehicle_of(scenario, id), step_s);
  text +=
      "\nchanged: steps in which the others changed the vehicle's plan; wait: the longest, of a "
      "vehicle that stood\nthough without the others it would have driven\n";
  for (const auto& [id, tally] : tallies) {
    if (!tally.last.arrived_since) continue;
    text += fmt::format("vehicle {} arrived at its goal after {:.1f} s\n", id.value,
                        step_s * static_cast<double>(tally.last.arrived_since->value - 1));
  }
  for (const auto& [id, tally] : tallies) {
    if (!hlc::coordination::is_stuck(tally.last, step_s)) continue;
    text += "stuck at the end: " + hlc::coordination::waiting_text(tally.last, step_s) + '\n';
  }
  text += line_of_all(tallies, scenario.steps, step_s);
  if (const auto figures = hlc::coordination::joint_gap_figures(gaps)) {
    text +=
        "new plans of coupled vehicles, together: " + hlc::coordination::text_of(*figures) + '\n';
  }
  return text;
}

void lose_messages(hlc::rollout::Rollout& rollout, const Choices& choices) {
  if (choices.lost == 0.0) return;
  rollout.lose([random = std::mt19937_64(choices.loss_seed), choices,
                lost = std::bernoulli_distribution(choices.lost)](
                   const hlc::controller::Delivery& delivery) mutable {
    return delivery.step.value <= choices.lost_steps && lost(random);
  });
}

std::vector<hlc::coordination::JointGap> gaps_of(
    const std::vector<hlc::coordination::Report>& reports) {
  std::vector<const hlc::coordination::Report*> pointers;
  for (const hlc::coordination::Report& report : reports) pointers.push_back(&report);
  return hlc::coordination::joint_gaps(pointers);
}

int run(const Choices& choices) {
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices.scenario);
  const double step_s = scenario.subgraph->automaton().step_s;
  std::map<hlc::VehicleId, Tally> tallies;
  hlc::rollout::Rollout rollout = hlc::rollout::make_rollout(scenario);
  lose_messages(rollout, choices);
  if (choices.lost > 0.0) rollout.exchange_in(scenario.rounds);  // otherwise the result is the same
  const hlc::automaton::ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  const auto alone =
      hlc::search::make_search_engine(*scenario.subgraph, reachable, scenario.search);
  std::vector<hlc::ConvexPolygon> standing_m;
  std::ranges::transform(scenario.obstacles, std::back_inserter(standing_m),
                         &hlc::scenario::ScenarioObstacle::area_m);
  std::vector<hlc::coordination::JointGap> gaps;
  std::chrono::steady_clock::duration wall{};
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<hlc::coordination::Report> reports = rollout.step();
    wall += std::chrono::steady_clock::now() - begin;
    for (std::size_t j = 0; j < reports.size(); ++j) {
      hlc::coordination::Report& report = reports[j];
      rollout.controllers()[j]->note_causes(report);
      rollout.controllers()[j]->note_bound(report);
      Tally& tally = tallies[report.vehicle];
      add(tally, report, step_s);
      if (others_changed_the_plan(*rollout.controllers()[j], standing_m, *alone, report))
        ++tally.changed;
    }
    std::ranges::copy(gaps_of(reports), std::back_inserter(gaps));
  }
  const double wall_ms = 1e3 * std::chrono::duration<double>(wall).count();

  fmt::print("{}", hlc::apps::fitted_table(result_of(scenario, tallies, gaps)));
  fmt::print("{} steps in {:.1f} ms\n", scenario.steps, wall_ms);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Plans a scenario with vehicles that follow perfectly, in one process.", "rollout"};
  Choices choices;
  hlc::apps::declare_scenario_flags(app, choices.scenario);
  app.add_option("--steps", choices.scenario.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  CLI::Option* const lost =
      app.add_option("--lost", choices.lost, "share of the messages between cars that are lost")
          ->check(hlc::apps::within(0.0, 1.0))
          ->capture_default_str();
  app.add_option("--lost_steps", choices.lost_steps, "no message is lost later; default: all steps")
      ->needs(lost)
      ->check(hlc::apps::whole(0, 100000));
  app.add_option("--loss_seed", choices.loss_seed, "of which messages are lost")
      ->needs(lost)
      ->check(hlc::apps::whole(0, 1'000'000'000'000))
      ->capture_default_str();
  hlc::apps::declare_help_end(
      app, {.examples = {"rollout --scenario paper_three_cars",
                         "rollout --scenario lab_cars --cars 10 --steps 100 --lost 0.05"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("rollout", [&choices] { return run(choices); });
}
