#include "hlc_bridge/result/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"

namespace hlc::result {
namespace {

constexpr std::size_t kHashDigits = 16;

using Cells = std::vector<std::string>;

std::string fixed(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

/// Way along the recorded positions from t(k0) to the run's end, and the time of it.
struct DrivenWay {
  double length_m{};
  double duration_s{};
};

std::optional<DrivenWay> driven_way(const ComparedRun& run, VehicleId vehicle) {
  const auto drive = run.drives.find(vehicle.value);
  if (drive == run.drives.end() || !run.facts.first_step) return std::nullopt;
  const Nanoseconds begin = *run.facts.first_step * run.facts.period;
  const Nanoseconds end = begin + run.facts.steps * run.facts.period;
  const DrivenSample* last = nullptr;
  DrivenWay way;
  for (const DrivenSample& sample : drive->second) {
    if (sample.t < begin || sample.t > end) continue;
    if (last != nullptr) {
      way.length_m += (sample.pose.position_m() - last->pose.position_m()).norm();
      way.duration_s += 1e-9 * static_cast<double>(sample.t - last->t);
    }
    last = &sample;
  }
  if (way.duration_s <= 0.0) return std::nullopt;
  return way;
}

Cells vehicle_cells(const ComparedRun& run, const VehicleSummary& vehicle) {
  const std::optional<DrivenWay> way = driven_way(run, vehicle.id);
  const auto& tracking = vehicle.tracking_error_m;
  return {fixed(vehicle.lap_s, 2),
          way ? fixed(way->length_m, 3) : "-",
          way ? fixed(way->length_m / way->duration_s, 3) : "-",
          tracking ? fmt::format("{:.1f} / {:.1f}", tracking->mean * kMillimetresPerMetre,
                                 tracking->max * kMillimetresPerMetre)
                   : "-",
          vehicle.generated ? fixed(vehicle.generated->mean, 0) : "-",
          fmt::to_string(vehicle.fallback_steps),
          vehicle.wait ? fixed(vehicle.wait->duration_s, 1) : "-"};
}

/// The vehicles of either run, those of the first run first.
std::vector<std::pair<const VehicleSummary*, const VehicleSummary*>> vehicles_of(
    const RunSummary& a, const RunSummary& b) {
  std::vector<std::pair<const VehicleSummary*, const VehicleSummary*>> vehicles;
  for (const VehicleSummary& vehicle : a.vehicles) {
    const auto other = std::ranges::find(b.vehicles, vehicle.id, &VehicleSummary::id);
    vehicles.emplace_back(&vehicle, other == b.vehicles.end() ? nullptr : &*other);
  }
  for (const VehicleSummary& vehicle : b.vehicles) {
    const auto other = std::ranges::find(a.vehicles, vehicle.id, &VehicleSummary::id);
    if (other == a.vehicles.end()) vehicles.emplace_back(nullptr, &vehicle);
  }
  return vehicles;
}

std::string size_text(const ComparedRun& run) {
  const std::size_t vehicles = run.facts.vehicle_ids.size();
  return fmt::format("{} steps, {} vehicle{}", run.summary.steps, vehicles,
                     vehicles == 1 ? "" : "s");
}

std::string run_line(const char* which, const ComparedRun& run) {
  return fmt::format("{}: {} ({}, profile {}, subgraph {}, {})", which, run.name,
                     run.summary.description.scenario, run.summary.description.profile,
                     run.summary.description.subgraph, size_text(run));
}

std::string result_line(const RunComparison& comparison) {
  const RunSummary& summary = comparison.a.summary;
  if (!comparison.other_difference.empty()) {
    return "the runs differ, though not in their steps: " + comparison.other_difference;
  }
  if (!comparison.first) {
    return fmt::format("the runs are equal: {}, trace_sha256 {}", size_text(comparison.a),
                       summary.trace_sha256);
  }
  return "the runs differ at " + text_of(*comparison.first, summary.description.step_s);
}

std::string other_difference(const ComparedRun& a, const ComparedRun& b) {
  if (is_driven_to_end(a.facts.exit_code) != is_driven_to_end(b.facts.exit_code)) {
    const std::string& reason = a.facts.reason.empty() ? b.facts.reason : a.facts.reason;
    return fmt::format("exit code {} and {}{}{}", a.facts.exit_code, b.facts.exit_code,
                       reason.empty() ? "" : ": ", reason);
  }
  if (a.summary.trace_sha256 != b.summary.trace_sha256) {
    return "what the vehicles drove between two of them";
  }
  return {};
}

std::string ids_text(const std::vector<VehicleId>& ids) {
  std::string text;
  for (const VehicleId id : ids) text += fmt::format("{}{}", text.empty() ? "" : " ", id.value);
  return text.empty() ? "-" : text;
}

/// The values of run_table, in its order.
Cells run_cells(const ComparedRun& run) {
  const RunSummary& summary = run.summary;
  std::size_t fallbacks = 0;
  for (const VehicleSummary& vehicle : summary.vehicles) fallbacks += vehicle.fallback_steps;
  std::optional<double> closest_mm;
  if (summary.min_footprint_distance_m) {
    closest_mm = *summary.min_footprint_distance_m * kMillimetresPerMetre;
  }
  return {fmt::to_string(summary.steps),
          fmt::to_string(run.facts.exit_code),
          fmt::to_string(summary.collisions),
          fixed(closest_mm, 1),
          fmt::to_string(fallbacks),
          fixed(longest_wait_s(summary), 1),
          ids_text(stuck_vehicles(summary)),
          fmt::to_string(summary.generated_vertices_sum_max),
          summary.trace_sha256.substr(0, kHashDigits),
          fixed(summary.wall_s, 2),
          fixed(summary.realtime_factor, 1)};
}

/// The first column to the left, the others to the right.
std::string table_text(const ComparisonTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& cell : table.heading) widths.push_back(cell.size());
  for (const Cells& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  const auto line = [&](const Cells& row) {
    std::string text = fmt::format("{:<{}}", row.front(), widths.front());
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    return text + "\n";
  };
  std::string text = line(table.heading);
  for (const Cells& row : table.rows) text += line(row);
  if (!table.legend.empty()) text += "\n";
  for (const std::string& meaning : table.legend) text += meaning + "\n";
  return text;
}

}  // namespace

RunComparison compare(ComparedRun a, ComparedRun b, std::vector<std::string> started) {
  if (a.rows.empty() && b.rows.empty()) {
    throw std::invalid_argument(
        fmt::format("{} and {}: no vehicle started, must have steps to compare", a.name, b.name));
  }
  std::optional<Difference> first = first_difference(a.rows, b.rows);
  WayDifference ways = way_difference(a.rows, b.rows);
  std::string other = first ? "" : other_difference(a, b);
  return {std::move(a),     std::move(b),    std::move(started),
          std::move(first), std::move(ways), std::move(other)};
}

std::vector<std::string> comparison_lines(const RunComparison& comparison) {
  std::vector<std::string> lines{run_line("first run", comparison.a),
                                 run_line("second run", comparison.b)};
  for (const std::string& line : comparison.started) {
    lines.push_back("started differently: " + line);
  }
  for (const ComparedRun* run : {&comparison.a, &comparison.b}) {
    for (const std::string& line : run->incomplete) lines.push_back(run->name + ": " + line);
  }
  if (comparison.first) {
    lines.push_back(text_of(comparison.ways, comparison.a.summary.description.step_s));
  }
  lines.push_back(result_line(comparison));
  return lines;
}

ComparisonTable vehicle_table(const RunComparison& comparison) {
  ComparisonTable table{
      .heading = {"vehicle", "run", "lap [s]", "way [m]", "speed [m/s]", "tracking [mm]",
                  "vertices", "fallbacks", "wait [s]"},
      .rows = {},
      .legend = {"lap: until the planned path completes one lap; -: not completed",
                 "speed: mean along the driven way",
                 "tracking: from planned to driven position, mean / maximum",
                 "vertices: generated per plan, mean",
                 "wait: the longest for other vehicles; -: never waited"}};
  const auto add = [&](const VehicleSummary& vehicle, const char* run, const Cells& cells) {
    Cells row{fmt::format("{} {}", vehicle.id.value, vehicle.name), run};
    row.insert(row.end(), cells.begin(), cells.end());
    table.rows.push_back(std::move(row));
  };
  for (const auto& [a, b] : vehicles_of(comparison.a.summary, comparison.b.summary)) {
    const Cells first = a != nullptr ? vehicle_cells(comparison.a, *a) : Cells{};
    const Cells second = b != nullptr ? vehicle_cells(comparison.b, *b) : Cells{};
    if (a != nullptr && b != nullptr && a->name == b->name && first == second) {
      add(*a, "both", first);
      continue;
    }
    if (a != nullptr) add(*a, "first", first);
    if (b != nullptr) add(*b, "second", second);
  }
  return table;
}

ComparisonTable run_table(const RunComparison& comparison) {
  const Cells names{"steps",
                    "exit code",
                    "collisions",
                    "smallest distance of driven footprints [mm]",
                    "fallbacks of all vehicles",
                    "longest wait [s]",
                    "stuck at the end",
                    "generated vertices, largest sum in one step",
                    "trace_sha256, first digits",
                    "wall time [s]",
                    "real-time factor"};
  ComparisonTable table{.heading = {"", "first run", "second run"}, .rows = {}, .legend = {}};
  const Cells first = run_cells(comparison.a);
  const Cells second = run_cells(comparison.b);
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.rows.push_back({names[i], first[i], second[i]});
  }
  return table;
}

std::string comparison_text(const RunComparison& comparison) {
  std::string text;
  for (const std::string& line : comparison_lines(comparison)) text += line + "\n";
  return text + "\n" + table_text(vehicle_table(comparison)) + "\n" +
         table_text(run_table(comparison));
}

}  // namespace hlc::result
