#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner/plot/svg_plot.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

/// Common parts of the figures of runs.
namespace hlc::campaign {

using PlotPoints = std::vector<Eigen::Vector2d>;

/// Colour of lines that are no series: bounds, marks.
inline constexpr char kMarkColour[] = "#444444";

/// One of several panels.
inline constexpr plot::PlotSize kSmallPanel{.width_px = 620.0, .height_px = 340.0};

/// The vehicle of highest priority.
[[nodiscard]] const scenario::ScenarioVehicle& first_vehicle(const DrivenRun& run);

/// "subgraph B", "policy zones"
[[nodiscard]] std::string run_name(const DrivenRun& run);

/// With scenario and profile.
[[nodiscard]] std::string figure_title(const std::string& what, std::span<const DrivenRun> runs);

/// From the first step to the end of the last one.
[[nodiscard]] std::pair<Nanoseconds, Nanoseconds> times_of(const result::RunFacts& facts);

[[nodiscard]] double seconds_after(Nanoseconds t, Nanoseconds from);

[[nodiscard]] std::vector<result::StepRecord> steps_of(const DrivenRun& run);

/// False before the start and after the end.
[[nodiscard]] bool has_searched(const coordination::Report& report);

/// A line with its entry in the legend. Every second series is dashed, so that two coinciding
/// series are both visible (see bring_dashed_to_front).
void add_series(std::size_t series, const std::string& name, PlotPoints points,
                plot::PlotPanel& panel);

/// Lines below dashed lines remain visible.
void bring_dashed_to_front(plot::PlotPanel& panel);

/// Moves the panels' legends into one for all, each text once.
[[nodiscard]] std::vector<plot::PlotLegend> taken_legend(std::vector<plot::PlotPanel>& panels);

/// The same ranges for all panels, from x = 0, so that they can be compared.
void share_range(std::vector<plot::PlotPanel>& panels, double x_max, double y_min, double y_max);

/// Two, or one for a single panel.
[[nodiscard]] std::size_t columns_for(std::size_t panels);

}  // namespace hlc::campaign
