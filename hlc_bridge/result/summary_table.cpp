#include "hlc_bridge/result/summary_table.hpp"

#include <algorithm>
#include <cstdio>

namespace hlc::result {
namespace {

constexpr double kMillimetresPerMetre = 1e3;
constexpr double kMillisecondsPerSecond = 1e3;

template <class... Arguments>
std::string print(const char* format, Arguments... arguments) {
  char text[512];
  std::snprintf(text, sizeof(text), format, arguments...);
  return text;
}

std::string mean_std(const std::optional<Statistics>& value, double factor, const char* format) {
  return value ? print(format, value->mean * factor, value->std * factor) : "-";
}

std::string mean_max(const std::optional<Statistics>& value, double factor, const char* format) {
  return value ? print(format, value->mean * factor, value->max * factor) : "-";
}

std::string largest(const std::optional<Statistics>& value, double factor, const char* format) {
  return value ? print(format, value->max * factor) : "-";
}

std::string percentile_99(const std::optional<Statistics>& value, double factor,
                          const char* format) {
  return value ? print(format, value->p99 * factor) : "-";
}

std::string row(const VehicleSummary& vehicle) {
  return print("%3u  %-8s %14s %6s %9s %9s %13s %6s %6s %12s %6zu %6zu\n", vehicle.id.value,
               vehicle.name.c_str(),
               mean_std(vehicle.reference_error_m, kMillimetresPerMetre, "%.1f (%.1f)").c_str(),
               vehicle.lap_s ? print("%.2f", *vehicle.lap_s).c_str() : "-",
               largest(vehicle.generated, 1.0, "%.0f").c_str(),
               largest(vehicle.expanded, 1.0, "%.0f").c_str(),
               mean_std(vehicle.planning_s, kMillisecondsPerSecond, "%.2f (%.2f)").c_str(),
               percentile_99(vehicle.planning_s, kMillisecondsPerSecond, "%.2f").c_str(),
               largest(vehicle.planning_s, kMillisecondsPerSecond, "%.2f").c_str(),
               mean_max(vehicle.tracking_error_m, kMillimetresPerMetre, "%.1f / %.1f").c_str(),
               vehicle.fallback_steps, vehicle.deadline_misses);
}

}  // namespace

std::string summary_table(const RunSummary& summary) {
  const RunDescription& run = summary.description;
  std::string text = print(
      "%s: %zu steps of %g s, horizon %zu, subgraph %s%s, profile %s, map %s, %s\n\n",
      run.scenario.c_str(), summary.steps, run.step_s, run.horizon_steps, run.subgraph.c_str(),
      run.policy == policy::kNoPolicy ? "" : (", policy " + run.policy).c_str(),
      run.profile.c_str(), run.map.c_str(),
      run.noise_seed ? ("noise seed " + std::to_string(*run.noise_seed)).c_str() : "no noise");
  text += print("%3s  %-8s %14s %6s %19s %27s %12s %13s\n", "", "", "reference", "lap",
                "vertices, max", "planning time", "tracking", "steps");
  text +=
      print("%3s  %-8s %14s %6s %9s %9s %13s %6s %6s %12s %6s %6s\n", "id", "vehicle", "error [mm]",
            "[s]", "generated", "expanded", "[ms]", "p99", "max", "error [mm]", "fallb.", "late");
  for (const VehicleSummary& vehicle : summary.vehicles) {
    text += row(vehicle);
  }
  text += "\nall vehicles\n";
  text += print("  generated vertices, largest sum in one step  %zu\n",
                summary.generated_vertices_sum_max);
  text +=
      print("  smallest distance of driven footprints       %s\n",
            summary.min_footprint_distance_m
                ? print("%.1f mm", *summary.min_footprint_distance_m * kMillimetresPerMetre).c_str()
                : "-");
  text += print("  collisions                                   %zu\n", summary.collisions);
  std::size_t undrivable = 0;
  for (const VehicleSummary& vehicle : summary.vehicles) undrivable += vehicle.undrivable_steps;
  if (undrivable > 0) {
    text += print("  commands not sent: beyond the lab's limits   %zu\n", undrivable);
  }
  double budget_share = 0.0;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    budget_share = std::max(budget_share, vehicle.budget_share.value_or(0.0));
  }
  if (budget_share > 0.0) {
    text += print("  plans cut off by the search's budget         up to %.1f %% of a vehicle's\n",
                  100.0 * budget_share);
  }
  text += print("  wall time, real-time factor                  %.2f s, %.1f\n", summary.wall_s,
                summary.realtime_factor);
  text += print("  planned and driven poses, SHA-256  %s\n", summary.trace_sha256.c_str());
  text += print("  program, host                                %s, %s, %u cores, %s\n",
                summary.revision.c_str(), summary.host.cpu.c_str(), summary.host.cores,
                summary.host.kernel.c_str());
  text +=
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
  return text;
}

}  // namespace hlc::result
