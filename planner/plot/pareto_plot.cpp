#include "planner/plot/pareto_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "planner/plot/svg_plot.hpp"

namespace hlc::plot {
namespace {

using Eigen::Vector2d;

std::string colour_of(std::size_t point, const maneuver_design::ParetoFront& front) {
  const std::size_t last = std::max<std::size_t>(front.points.size() - 1, 1);
  return red_to_blue(static_cast<double>(point) / static_cast<double>(last));
}

std::string label_of(const std::string& criterion) {
  if (criterion == "J1") return "J1: -integral of squared distance [m² s]";
  if (criterion == "J2") return "J2: integral of squared inputs [m²/s³ + rad²/s]";
  return criterion;
}

/// One line per maneuver.
PlotPanel lines_of(
    const maneuver_design::ParetoFront& front,
    const std::function<std::vector<Vector2d>(const maneuver_design::ManeuverSolution&)>& points) {
  PlotPanel panel;
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    panel.lines.push_back({points(front.points[i].solution), colour_of(i, front)});
  }
  return panel;
}

PlotPanel over_time(const maneuver_design::ParetoFront& front, const std::string& title,
                    const std::string& label, double (*value)(const vehicle::State&)) {
  PlotPanel panel = lines_of(front, [value](const maneuver_design::ManeuverSolution& solution) {
    std::vector<Vector2d> points;
    for (std::size_t k = 0; k < solution.states.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(solution.states.size() - 1);
      points.emplace_back(share * solution.duration_s, value(solution.states[k]));
    }
    return points;
  });
  panel.title = title;
  panel.x_label = "time [s]";
  panel.y_label = label;
  return panel;
}

/// Steps: an input is constant on each interval.
PlotPanel input_over_time(const maneuver_design::ParetoFront& front, const std::string& title,
                          const std::string& label, double vehicle::Input::*value) {
  PlotPanel panel = lines_of(front, [value](const maneuver_design::ManeuverSolution& solution) {
    std::vector<Vector2d> points;
    const double interval_s =
        solution.duration_s / static_cast<double>(std::max<std::size_t>(solution.inputs.size(), 1));
    for (std::size_t k = 0; k < solution.inputs.size(); ++k) {
      const double begin_s = interval_s * static_cast<double>(k);
      points.emplace_back(begin_s, solution.inputs[k].*value);
      points.emplace_back(begin_s + interval_s, solution.inputs[k].*value);
    }
    return points;
  });
  panel.title = title;
  panel.x_label = "time [s]";
  panel.y_label = label;
  return panel;
}

PlotPanel front_panel(const maneuver_design::ParetoFront& front,
                      const maneuver_design::ParetoFront& weighted_sums,
                      const ParetoDescription& description) {
  PlotPanel panel;
  panel.title = "Pareto front";
  panel.x_label = label_of(description.criteria[1]);
  panel.y_label = label_of(description.criteria[0]);
  const auto at = [](const maneuver_design::ParetoPoint& point) {
    return Vector2d(point.objectives(1), point.objectives(0));
  };
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    panel.marks.push_back({at(front.points[i]), colour_of(i, front)});
  }
  for (const maneuver_design::ParetoPoint& point : weighted_sums.points) {
    panel.marks.push_back({at(point), "#666666", Mark::kCross, 2.5});
  }
  const std::size_t knee = maneuver_design::knee_point(front.objectives());
  panel.marks.push_back({at(front.points[knee]), "#000000", Mark::kRing, 7.0});
  panel.legend = {
      {"optimum of " + description.criteria[1], colour_of(0, front)},
      {"optimum of " + description.criteria[0], colour_of(front.points.size() - 1, front)},
      {"knee", "#000000", Mark::kRing, 5.0},
      {"weighted sums", "#666666", Mark::kCross, 2.5}};
  return panel;
}

}  // namespace

std::string pareto_plot(const maneuver_design::ParetoFront& front,
                        const maneuver_design::ParetoFront& weighted_sums,
                        const ParetoDescription& description) {
  PlotPanel positions = lines_of(front, [](const maneuver_design::ManeuverSolution& solution) {
    std::vector<Vector2d> points;
    for (const vehicle::State& state : solution.states) points.push_back(state.pose.position_m());
    return points;
  });
  positions.title = "Positions";
  positions.x_label = "s_x [m]";
  positions.y_label = "s_y [m]";
  positions.equal_scale = true;
  const auto& range = description.free_duration;
  const std::string duration = range ? fmt::format("{:g} ... {:g}", range->min_s, range->max_s)
                                     : fmt::format("{:g}", description.duration_s);
  const std::string title = fmt::format(
      "Pareto-optimal maneuvers from ({:g} m/s, {:g} rad) to ({:g} m/s, {:g} rad) in {} s",
      description.from.speed_mps, description.from.steering_rad, description.to.speed_mps,
      description.to.steering_rad, duration);
  return svg_of(title,
                {front_panel(front, weighted_sums, description), positions,
                 over_time(front, "Orientations", "psi [rad]",
                           [](const vehicle::State& state) { return state.pose.heading_rad; }),
                 input_over_time(front, "Inputs: acceleration", "u_v [m/s²]",
                                 &vehicle::Input::acceleration_mps2),
                 input_over_time(front, "Inputs: steering rate", "u_delta [rad/s]",
                                 &vehicle::Input::steering_rate_radps),
                 over_time(front, "Speeds", "v [m/s]",
                           [](const vehicle::State& state) { return state.speed_mps; })},
                3);
}

}  // namespace hlc::plot
