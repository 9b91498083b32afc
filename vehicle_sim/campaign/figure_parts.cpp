#include "vehicle_sim/campaign/figure_parts.hpp"

#include <algorithm>

namespace hlc::campaign {
namespace {

plot::Stroke stroke_of(std::size_t series) {
  return series % 2 == 1 ? plot::Stroke::kDashed : plot::Stroke::kSolid;
}

}  // namespace

const scenario::ScenarioVehicle& first_vehicle(const DrivenRun& run) {
  return run.scenario.vehicles.front();
}

std::string run_name(const DrivenRun& run) {
  const bool is_fixed = run.scenario.policy == policy::kNoPolicy;
  const std::string name = planned_on(run.scenario.subgraph->spec().name, run.scenario.policy);
  return is_fixed ? "subgraph " + name : name;
}

std::string figure_title(const std::string& what, std::span<const DrivenRun> runs) {
  const scenario::Scenario& scenario = runs.front().scenario;
  return what + " (" + scenario.name + ", profile " + scenario.profile.name + ")";
}

std::pair<Nanoseconds, Nanoseconds> times_of(const result::RunFacts& facts) {
  const Nanoseconds from = facts.first_step.value_or(0) * facts.period;
  return {from, from + facts.steps * facts.period};
}

double seconds_after(Nanoseconds t, Nanoseconds from) {
  return 1e-9 * (static_cast<double>(t) - static_cast<double>(from));
}

std::vector<result::StepRecord> steps_of(const DrivenRun& run) {
  return result::step_records(run.experiment.reports, run.experiment.drives, run.experiment.facts);
}

bool has_searched(const coordination::Report& report) {
  return report.status == coordination::StepStatus::kPlanned ||
         report.status == coordination::StepStatus::kFallback;
}

void add_series(std::size_t series, const std::string& name, PlotPoints points,
                plot::PlotPanel& panel) {
  panel.lines.push_back({.points = std::move(points),
                         .colour = plot::series_colour(series),
                         .width_px = 1.5,
                         .stroke = stroke_of(series)});
  panel.legend.push_back({.text = name,
                          .colour = plot::series_colour(series),
                          .radius_px = 0.0,
                          .stroke = stroke_of(series)});
}

std::vector<plot::PlotLegend> taken_legend(std::vector<plot::PlotPanel>& panels) {
  std::vector<plot::PlotLegend> legend;
  for (plot::PlotPanel& panel : panels) {
    for (const plot::PlotLegend& entry : panel.legend) {
      const auto same = [&](const plot::PlotLegend& other) { return other.text == entry.text; };
      if (std::ranges::none_of(legend, same)) legend.push_back(entry);
    }
    panel.legend.clear();
  }
  return legend;
}

void bring_dashed_to_front(plot::PlotPanel& panel) {
  std::ranges::stable_partition(
      panel.lines, [](const plot::PlotLine& line) { return line.stroke == plot::Stroke::kSolid; });
}

void share_range(std::vector<plot::PlotPanel>& panels, double x_max, double y_min, double y_max) {
  for (plot::PlotPanel& panel : panels)
    panel.range = Eigen::AlignedBox2d(Point(0.0, y_min), Point(x_max, y_max));
}

std::size_t columns_for(std::size_t panels) { return panels == 1 ? 1 : 2; }

}  // namespace hlc::campaign
