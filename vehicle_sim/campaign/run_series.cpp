#include "vehicle_sim/campaign/run_series.hpp"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "hlc_bridge/result/encounters.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "planner/common/csv.hpp"
#include "planner/coordination/waiting.hpp"
#include "planner/policy/speed_zones.hpp"
#include "planner/road/lap.hpp"

namespace hlc::campaign {
namespace {

const char* truth(bool value) { return value ? "true" : "false"; }

bool has_searched(const coordination::Report& report) {
  return report.status == coordination::StepStatus::kPlanned ||
         report.status == coordination::StepStatus::kFallback;
}

double seconds_after(Nanoseconds t, Nanoseconds from) {
  return 1e-9 * (static_cast<double>(t) - static_cast<double>(from));
}

class SeriesWriter {
 public:
  SeriesWriter(const DrivenRun& run, std::size_t number, const RunFigures& heading,
               SeriesExtent extent)
      : run_(run), number_(number), heading_(heading), is_whole_(extent == SeriesExtent::kWhole) {
    const result::RunFacts& facts = run.experiment.facts;
    from_ = facts.first_step.value_or(0) * facts.period;
    to_ = from_ + facts.steps * facts.period;
    rows_ = result::step_records(run.experiment.reports, run.experiment.drives, facts);
  }

  [[nodiscard]] RunSeries write() {
    for (const scenario::ScenarioVehicle& vehicle : run_.scenario.vehicles) {
      add_steps(vehicle);
      add_drive(vehicle);
      if (!is_whole_) break;
    }
    if (is_whole_) add_distances();
    return std::move(series_);
  }

 private:
  void add_steps(const scenario::ScenarioVehicle& vehicle) {
    std::vector<const result::StepRecord*> own;
    std::vector<Point> planned_m;
    for (const result::StepRecord& row : rows_) {
      if (row.record.report.vehicle != vehicle.id) continue;
      own.push_back(&row);
      planned_m.push_back(row.record.report.planned_pose.position_m());
    }
    if (own.empty()) return;
    const road::Progress progress = road::progress_along(vehicle.path, planned_m);
    for (std::size_t i = 0; i < own.size(); ++i) {
      add_step(*own[i], vehicle, progress.s_m[i], progress.distance_m[i]);
    }
  }

  void add_step(const result::StepRecord& row, const scenario::ScenarioVehicle& vehicle, double s_m,
                double error_m) {
    const coordination::Report& report = row.record.report;
    const double step_s = run_.scenario.subgraph->automaton().step_s;
    std::optional<double> planning_ms;
    if (is_whole_ && has_searched(report) && row.record.planning_ns > 0) {
      planning_ms = 1e-6 * static_cast<double>(row.record.planning_ns);
    }
    CsvLine line(number_, heading_.scenario, heading_.profile, heading_.subgraph, heading_.policy,
                 heading_.start, vehicle.id.value, vehicle.name, row.step);
    line.add(fmt::format("{:.3f}", step_s * static_cast<double>(row.step)), report.subgraph,
             report.generated, report.expanded, truth(has_searched(report)), planning_ms, s_m,
             1e3 * error_m, truth(coordination::is_stuck(report, step_s)));
    series_.steps += line.text();
  }

  void add_drive(const scenario::ScenarioVehicle& vehicle) {
    std::size_t tick = 0;
    auto out = std::back_inserter(series_.drives);
    for (const result::DrivenSample& sample : run_.experiment.drives.at(vehicle.id.value)) {
      if (sample.t < from_ || sample.t > to_) continue;
      if (tick++ % (is_whole_ ? 1 : kSparse) != 0) continue;
      const std::optional<double> limit_mps =
          policy::limit_at(run_.scenario.reconfiguration.zones, sample.pose.position_m());
      // A tenth of a millimetre is far below what a figure resolves, and the file half as large.
      fmt::format_to(out, "{},{},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", number_,
                     vehicle.id.value, seconds_after(sample.t, from_), sample.pose.x_m,
                     sample.pose.y_m, sample.pose.heading_rad, sample.speed_mps,
                     limit_mps ? fmt::to_string(*limit_mps) : "");
    }
  }

  void add_distances() {
    const std::vector<result::VehicleDescription> vehicles =
        result::describe(run_.scenario, std::nullopt).vehicles;
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      for (std::size_t j = i + 1; j < vehicles.size(); ++j) add_pair(vehicles[i], vehicles[j]);
    }
  }

  void add_pair(const result::VehicleDescription& a, const result::VehicleDescription& b) {
    const double kept_m = 2.0 * run_.scenario.subgraph->automaton().vehicle.safety_margin_m;
    const result::Drives& drives = run_.experiment.drives;
    const std::string pair = csv_field(a.name + " and " + b.name);
    auto out = std::back_inserter(series_.distances);
    for (const result::TimedDistance& one : result::footprint_distances(
             a, drives.at(a.id.value), b, drives.at(b.id.value), from_, to_)) {
      if (one.distance_m >= kNear_m) continue;
      fmt::format_to(out, "{},{},{},{},{:.3f},{:.4f},{}\n", number_, a.id.value, b.id.value, pair,
                     seconds_after(one.t, from_), one.distance_m, kept_m);
    }
  }

  const DrivenRun& run_;
  std::size_t number_;
  const RunFigures& heading_;
  bool is_whole_;
  Nanoseconds from_{};
  Nanoseconds to_{};
  std::vector<result::StepRecord> rows_;
  RunSeries series_;
};

}  // namespace

RunSeries series_of(const DrivenRun& run, std::size_t number, const RunFigures& heading,
                    SeriesExtent extent) {
  return SeriesWriter(run, number, heading, extent).write();
}

}  // namespace hlc::campaign
