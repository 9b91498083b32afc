#include "planner/plot/problem_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/geometry/footprint.hpp"
#include "planner/plot/svg_plot.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::plot {
namespace {

constexpr char kReferenceColour[] = "#2ca02c";
constexpr char kBoundaryColour[] = "#000000";
constexpr char kFootprintColour[] = "#9a9a9a";
constexpr char kPlanColour[] = "#222222";

PlotLine outline(const ConvexPolygon& area_m, const std::string& colour, double width_px,
                 Stroke stroke) {
  std::vector<Eigen::Vector2d> points(area_m.vertices_m.begin(), area_m.vertices_m.end());
  points.push_back(points.front());
  return {.points = std::move(points), .colour = colour, .width_px = width_px, .stroke = stroke};
}

std::string colour_of(std::size_t step, const search::HorizonProblem& problem) {
  const std::size_t last = std::max<std::size_t>(problem.horizon_steps() - 1, 1);
  return red_to_blue(static_cast<double>(step) / static_cast<double>(last));
}

void add_surroundings(const search::HorizonProblem& problem, PlotPanel& panel) {
  for (const Segment& segment : problem.boundary_m) {
    panel.lines.push_back({.points = {segment.from_m, segment.to_m}, .colour = kBoundaryColour});
  }
  for (std::size_t j = 0; j < problem.obstacles_m.size(); ++j) {
    for (const ConvexPolygon& area_m : problem.obstacles_m[j]) {
      if (area_m.empty()) continue;
      panel.lines.push_back(outline(area_m, colour_of(j, problem), 1.0, Stroke::kDashed));
    }
  }
  for (const Point& point_m : problem.reference_m) {
    panel.marks.push_back({.at = point_m, .colour = kReferenceColour, .mark = Mark::kRing});
  }
}

void add_plan(const Footprint& footprint, const search::HorizonProblem& problem,
              const search::SearchResult& result, PlotPanel& panel) {
  Pose from = problem.start;
  panel.marks.push_back({.at = from.position_m(), .colour = kPlanColour, .mark = Mark::kCross});
  panel.lines.push_back(
      outline(footprint_area(footprint, from, 0.0), kFootprintColour, 1.0, Stroke::kSolid));
  for (std::size_t j = 0; j < result.maneuvers.size(); ++j) {
    panel.lines.push_back(outline(transformed(result.maneuvers[j]->swept_area_m, from),
                                  colour_of(j, problem), 1.2, Stroke::kSolid));
    from = result.poses[j];
    panel.lines.push_back(
        outline(footprint_area(footprint, from, 0.0), kFootprintColour, 1.0, Stroke::kSolid));
    panel.marks.push_back(
        {.at = from.position_m(), .colour = kPlanColour, .mark = Mark::kDot, .radius_px = 2.5});
  }
}

/// Result: of one vehicle or of several.
template <class Result>
PlotPanel panel_for(const Result& result) {
  PlotPanel panel;
  panel.title =
      result.status == search::SearchStatus::kFallback
          ? fmt::format("no plan ({})", search::to_string(result.reason))
          : fmt::format("plan: {}, cost {:.4g} m²", search::to_string(result.status), result.cost);
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.equal_scale = true;
  return panel;
}

/// @param problem  one of those that are drawn
std::string picture(const std::string& title, const search::HorizonProblem& problem,
                    PlotPanel panel) {
  panel.legend_corner = Corner::kEmptiest;
  const std::string first = colour_of(0, problem);
  const std::string last = colour_of(problem.horizon_steps() - 1, problem);
  panel.legend = {
      {.text = "start", .colour = kPlanColour, .mark = Mark::kCross},
      {.text = "planned position after each step", .colour = kPlanColour, .radius_px = 2.5},
      {.text = "reference point of each step", .colour = kReferenceColour, .mark = Mark::kRing},
      {.text = "footprint of the vehicle", .colour = kFootprintColour, .radius_px = 0.0},
      {.text = "swept area (dashed: obstacle), step 1", .colour = first, .radius_px = 0.0},
      {.text = fmt::format("the same, step {}", problem.horizon_steps()),
       .colour = last,
       .radius_px = 0.0},
      {.text = "boundary", .colour = kBoundaryColour, .radius_px = 0.0}};
  return svg_of(title, {panel}, 1, {.width_px = 900.0, .height_px = 700.0});
}

}  // namespace

std::string problem_plot(const scenario::ProblemFile& file, const search::SearchResult& result) {
  PlotPanel panel = panel_for(result);
  add_surroundings(file.problem, panel);
  add_plan(file.subgraph->automaton().vehicle.footprint, file.problem, result, panel);
  return picture(fmt::format("Planning problem: horizon {}, subgraph {}",
                             file.problem.horizon_steps(), file.subgraph->spec().name),
                 file.problem, std::move(panel));
}

std::string joint_problem_plot(const scenario::JointProblemFile& file,
                               const joint_search::JointSearchResult& result) {
  PlotPanel panel = panel_for(result);
  for (const search::HorizonProblem& problem : file.problems) add_surroundings(problem, panel);
  for (std::size_t i = 0; i < file.problems.size(); ++i) {
    const search::SearchResult none;
    const Footprint& footprint = file.subgraph->automaton().vehicle.footprint;
    add_plan(footprint, file.problems[i], result.plans.empty() ? none : result.plans[i], panel);
    const Pose behind{-footprint.length_m, 0.0, 0.0};
    panel.texts.push_back({.at = compose(file.problems[i].start, behind).position_m(),
                           .text = std::to_string(i + 1)});
  }
  return picture(fmt::format("Joint planning problem: {} vehicles, horizon {}, subgraph {}",
                             file.problems.size(), file.problems.front().horizon_steps(),
                             file.subgraph->spec().name),
                 file.problems.front(), std::move(panel));
}

}  // namespace hlc::plot
