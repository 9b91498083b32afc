#include "planner/scenario/lab_file.hpp"

#include <cmath>

#include "planner/common/node.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::scenario {

vehicle::LabLimits read_lab(const std::filesystem::path& file, double step_s) {
  const Node node = Node::read_yaml(file);
  vehicle::LabLimits lab;
  lab.curvature_min_per_m = node.required<double>("curvature_min_per_m", between(-1e4, 0.0));
  lab.curvature_max_per_m = node.required<double>("curvature_max_per_m", between(0.0, 1e4));
  lab.acceleration_max_mps2 = node.required<double>("acceleration_max_mps2", above(0.0, 1e4));
  lab.velocity_mismatch_max_mps =
      node.required<double>("velocity_mismatch_max_mps", above(0.0, 1e3));
  lab.point_interval_s = node.required<double>("point_interval_s", between(0.001, 1.0));
  const double intervals = step_s / lab.point_interval_s;
  if (std::abs(intervals - std::round(intervals)) > 1e-9 || std::round(intervals) < 1.0) {
    node.fail("point_interval_s",
              "a divisor of the automaton's step of " + shortest_text(step_s) + " s");
  }
  lab.pose_lead_s = node.optional("pose_lead_s", 0.0, between(0.0, vehicle::kMostPoseLead_s));
  lab.tracking_error_max_m =
      node.optional("tracking_error_max_m", 0.0, between(0.0, vehicle::kMostTrackingError_m));
  const Node area = node.map("area");
  lab.x_min_m = area.required<double>("x_min_m");
  lab.x_max_m = area.required<double>("x_max_m", above(lab.x_min_m));
  lab.y_min_m = area.required<double>("y_min_m");
  lab.y_max_m = area.required<double>("y_max_m", above(lab.y_min_m));
  area.check_no_unknown_keys();
  node.check_no_unknown_keys();
  return lab;
}

}  // namespace hlc::scenario
