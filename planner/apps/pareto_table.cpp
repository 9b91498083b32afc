#include "planner/apps/pareto_table.hpp"

#include <algorithm>

#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

double highest_speed_mps(const ManeuverSolution& solution) {
  double highest = 0.0;
  for (const State& state : solution.states) highest = std::max(highest, state.speed_mps);
  return highest;
}

}  // namespace

std::string pareto_table(const ParetoFront& front, const ParetoDescription& description) {
  std::string out;
  for (const std::string& criterion : description.criteria) out += criterion + ",";
  out += "dx,dy,dpsi,status,";
  if (description.free_duration) out += "duration,";
  out += "v_max,dominated,knee,first_order_residual\n";
  const std::size_t knee = front.points.empty() ? 0 : knee_point(front.objectives());
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    const ParetoPoint& point = front.points[i];
    const Pose end = point.solution.states.back().pose;
    for (const double value : point.objectives) out += shortest_text(value) + ",";
    out += shortest_text(end.x_m) + "," + shortest_text(end.y_m) + "," +
           shortest_text(end.heading_rad) + ",";
    out += point.solution.status == ManeuverStatus::kOptimal ? "optimal," : "not_converged,";
    if (description.free_duration) out += shortest_text(point.solution.duration_s) + ",";
    out += shortest_text(highest_speed_mps(point.solution)) + "," +
           (point.is_dominated ? "1," : "0,") + (i == knee ? "1," : "0,") +
           shortest_text(point.solution.first_order_residual) + "\n";
  }
  return out;
}

}  // namespace hlc
