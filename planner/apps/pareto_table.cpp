#include "planner/apps/pareto_table.hpp"

#include <algorithm>

#include "planner/common/csv.hpp"

namespace hlc::apps {
namespace {

double highest_speed_mps(const maneuver_design::ManeuverSolution& solution) {
  double highest = 0.0;
  for (const vehicle::State& state : solution.states) highest = std::max(highest, state.speed_mps);
  return highest;
}

}  // namespace

std::string pareto_table(const maneuver_design::ParetoFront& front,
                         const plot::ParetoDescription& description) {
  CsvLine heading;
  for (const std::string& criterion : description.criteria) heading.add(criterion);
  heading.add("dx", "dy", "dpsi", "status");
  if (description.free_duration) heading.add("duration");
  heading.add("v_max", "dominated", "knee", "first_order_residual");
  std::string out = heading.text();
  const std::size_t knee =
      front.points.empty() ? 0 : maneuver_design::knee_point(front.objectives());
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    const maneuver_design::ParetoPoint& point = front.points[i];
    const Pose end = point.solution.states.back().pose;
    CsvLine line;
    for (const double value : point.objectives) line.add(value);
    line.add(end.x_m, end.y_m, end.heading_rad,
             point.solution.status == maneuver_design::ManeuverStatus::kOptimal ? "optimal"
                                                                                : "not_converged");
    if (description.free_duration) line.add(point.solution.duration_s);
    line.add(highest_speed_mps(point.solution), point.is_dominated, i == knee,
             point.solution.first_order_residual);
    out += line.text();
  }
  return out;
}

}  // namespace hlc::apps
