#include "hlc_bridge/result/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "planner/coordination/priority.hpp"

namespace hlc::result {
namespace {

constexpr double kMillisecondsPerSecond = 1e3;

constexpr int kLapWidth = 6;
constexpr int kArrivedWidth = 18;
constexpr std::string_view kRow =
    "{:>3}  {:<8} {:>14} {:>{}} {:>9} {:>9} {:>13} {:>6} {:>6} {:>12} {:>6} {:>6}\n";

std::string mean_std(const std::optional<Statistics>& value, double factor, int decimals) {
  if (!value) return "-";
  return fmt::format("{:.{}f} ({:.{}f})", value->mean * factor, decimals, value->std * factor,
                     decimals);
}

std::string in_decimals(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

/// Width of the column of laps, where vehicles that arrived have no lap.
int lap_width(const RunSummary& summary) {
  const auto has_arrived = [](const VehicleSummary& one) { return one.arrived_s.has_value(); };
  return std::ranges::any_of(summary.vehicles, has_arrived) ? kArrivedWidth : kLapWidth;
}

std::string lap(const VehicleSummary& vehicle) {
  if (vehicle.arrived_s) return fmt::format("arrived at {:.1f} s", *vehicle.arrived_s);
  return vehicle.lap_s ? in_decimals(*vehicle.lap_s, 2) : "-";
}

std::string row(const VehicleSummary& vehicle, int lap_width) {
  const auto& tracking = vehicle.tracking_error_m;
  const auto& planning = vehicle.planning_s;
  const auto largest = [](const std::optional<Statistics>& value) {
    return value ? in_decimals(value->max, 0) : "-";
  };
  return fmt::format(kRow, vehicle.id.value, vehicle.name,
                     mean_std(vehicle.reference_error_m, kMillimetresPerMetre, 1), lap(vehicle),
                     lap_width, largest(vehicle.generated), largest(vehicle.expanded),
                     mean_std(planning, kMillisecondsPerSecond, 2),
                     planning ? in_decimals(planning->p99 * kMillisecondsPerSecond, 2) : "-",
                     planning ? in_decimals(planning->max * kMillisecondsPerSecond, 2) : "-",
                     tracking
                         ? fmt::format("{:.1f} / {:.1f}", tracking->mean * kMillimetresPerMetre,
                                       tracking->max * kMillimetresPerMetre)
                         : "-",
                     vehicle.fallback_steps, vehicle.deadline_misses);
}

/// As many as fit into a line.
std::string joined(const std::vector<VehicleId>& ids, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, ids.size()); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : " ", ids[i].value);
  }
  return text + (ids.size() > most ? " ..." : "");
}

/// A line for each vehicle that waited, the longest wait first.
std::string waiting_lines(const RunSummary& summary) {
  std::vector<const VehicleSummary*> waited;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.wait) waited.push_back(&vehicle);
  }
  std::ranges::stable_sort(waited, [](const VehicleSummary* a, const VehicleSummary* b) {
    return a->wait->duration_s > b->wait->duration_s;
  });
  std::string text;
  for (const VehicleSummary* vehicle : waited) {
    text += fmt::format(
        "  {:<43}  {:.1f} s, vehicle {} for {}, from {:.1f} s on\n",
        text.empty() ? "longest wait for others, of every vehicle" : "", vehicle->wait->duration_s,
        vehicle->id.value, joined(vehicle->wait->vehicles, 8),
        static_cast<double>(vehicle->wait->since_step) * summary.description.step_s);
  }
  if (const std::vector<VehicleId> stuck = stuck_vehicles(summary); !stuck.empty()) {
    text += fmt::format("  stuck at the end: vehicles                   {}\n", joined(stuck, 20));
  }
  return text;
}

/// What is to be known of the plans, if anything is.
std::string planning_lines(const RunSummary& summary) {
  std::string text;
  std::size_t undrivable = 0;
  for (const VehicleSummary& vehicle : summary.vehicles) undrivable += vehicle.undrivable_steps;
  if (undrivable > 0) {
    text += fmt::format("  commands not sent: beyond the lab's limits   {}\n", undrivable);
  }
  double budget_share = 0.0;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    budget_share = std::max(budget_share, vehicle.budget_share.value_or(0.0));
  }
  if (budget_share > 0.0) {
    text += fmt::format(
        "  plans cut off by the search's budget         up to {:.1f} % of a vehicle's\n",
        100.0 * budget_share);
  }
  if (summary.joint_gap) {
    text += fmt::format("  new plans of coupled vehicles, together      {}\n",
                        coordination::text_of(*summary.joint_gap));
  }
  return text;
}

std::string legend(const RunSummary& summary) {
  std::string text =
      "\nMeans are followed by standard deviations in parentheses, or by \"/\" and the maximum.\n"
      "reference error  planned positions to the centre of the lane\n"
      "lap              from the first plan's begin until the planned path completes one lap; -: "
      "not "
      "completed\n"
      "vertices         of the search tree, with its root and those never expanded\n"
      "p99              99 of 100 plans took no longer\n"
      "tracking error   driven to planned position at the same instant, every 20 ms\n"
      "fallb.           steps in which the previous plan stayed in force\n"
      "late             steps in which a deadline was missed (real time)\n";
  if (lap_width(summary) == kArrivedWidth) {
    text += "arrived          stands at the end of its route, or in its goal, from then on\n";
  }
  if (summary.joint_gap) {
    text +=
        "joint optimum    least cost that the new plans of coupled vehicles could have together in "
        "a "
        "step\n";
  }
  if (longest_wait_s(summary) > 0.0) {
    text += fmt::format(
        "wait             the vehicle stands, though without the others it would drive; stuck: for "
        "{:.0f} s\n",
        coordination::kStuckAfter_s);
  }
  return text;
}

std::string head_line(const RunSummary& summary) {
  const RunDescription& run = summary.description;
  return fmt::format(
      "{}: {} steps of {:g} s, horizon {}, subgraph {}{}{}{}, profile {}, {}, {}\n\n", run.scenario,
      summary.steps, run.step_s, run.horizon_steps, run.subgraph,
      run.policy == policy::kNoPolicy ? "" : ", policy " + run.policy,
      run.has_two_rounds ? ", two rounds" : "",
      run.priorities == coordination::kConstantPriorities.name ? ""
                                                               : ", priorities " + run.priorities,
      run.profile, run.map.empty() ? "no map" : "map " + run.map,
      run.noise_seed ? fmt::format("noise seed {}", *run.noise_seed) : "no noise");
}

}  // namespace

std::string summary_table(const RunSummary& summary) {
  std::string text = head_line(summary);
  const int laps = lap_width(summary);
  text +=
      fmt::format("{:>3}  {:<8} {:>14} {:>{}} {:>19} {:>27} {:>12} {:>13}\n", "", "", "reference",
                  "lap", laps, "vertices, max", "planning time", "tracking", "steps");
  text += fmt::format(kRow, "id", "vehicle", "error [mm]", "[s]", laps, "generated", "expanded",
                      "[ms]", "p99", "max", "error [mm]", "fallb.", "late");
  for (const VehicleSummary& vehicle : summary.vehicles) {
    text += row(vehicle, laps);
  }
  text += fmt::format(
      "\nall vehicles\n"
      "  generated vertices, largest sum in one step  {}\n"
      "  smallest distance of driven footprints       {}\n"
      "  collisions                                   {}\n",
      summary.generated_vertices_sum_max,
      summary.min_footprint_distance_m
          ? fmt::format("{:.1f} mm", *summary.min_footprint_distance_m * kMillimetresPerMetre)
          : "-",
      summary.collisions);
  if (const GuestEncounters& guests = summary.with_guests; guests.min_distance_m) {
    text += fmt::format(
        "  smallest distance to a guest                 {:.1f} mm{}\n",
        *guests.min_distance_m * kMillimetresPerMetre,
        guests.touched == 0
            ? ""
            : fmt::format("; guests drove into standing vehicles {} times", guests.touched));
  }
  if (summary.min_obstacle_distance_m) {
    text += fmt::format("  smallest distance to an obstacle             {:.1f} mm\n",
                        *summary.min_obstacle_distance_m * kMillimetresPerMetre);
  }
  text += planning_lines(summary);
  text += waiting_lines(summary);
  if (summary.response_s) {
    text += fmt::format(
        "  from state list to command                   mean {:.1f}, p99 {:.1f}, max {:.1f} ms\n",
        summary.response_s->mean * kMillisecondsPerSecond,
        summary.response_s->p99 * kMillisecondsPerSecond,
        summary.response_s->max * kMillisecondsPerSecond);
  }
  text += fmt::format(
      "  wall time, real-time factor                  {:.2f} s, {:.1f}\n"
      "  planned and driven poses, SHA-256  {}\n"
      "  program, host                                {}, {}, {} cores, {}\n",
      summary.wall_s, summary.realtime_factor, summary.trace_sha256, summary.revision,
      summary.host.cpu, summary.host.cores, summary.host.kernel);
  return text + legend(summary);
}

}  // namespace hlc::result
