#include "planner/plot/pareto_data.hpp"

#include "planner/maneuver_design/dominance.hpp"

namespace hlc::plot {
namespace {

using Json = nlohmann::ordered_json;

Json point_of(const maneuver_design::ParetoPoint& point) {
  const maneuver_design::ManeuverSolution& solution = point.solution;
  Json json{{"objectives", {point.objectives(0), point.objectives(1)}},
            {"is_converged", solution.status == maneuver_design::ManeuverStatus::kOptimal},
            {"duration_s", solution.duration_s},
            {"states", Json::array()},
            {"inputs", Json::array()}};
  for (const vehicle::State& state : solution.states) {
    json["states"].push_back(
        {state.pose.x_m, state.pose.y_m, state.pose.heading_rad, state.speed_mps});
  }
  for (const vehicle::Input& input : solution.inputs) {
    json["inputs"].push_back({input.acceleration_mps2, input.steering_rate_radps});
  }
  return json;
}

}  // namespace

Json pareto_data(const maneuver_design::ParetoFront& front,
                 const maneuver_design::ParetoFront& weighted_sums,
                 const ParetoDescription& description) {
  const auto& range = description.free_duration;
  Json data{{"from", {description.from.speed_mps, description.from.steering_rad}},
            {"to", {description.to.speed_mps, description.to.steering_rad}},
            {"duration_s",
             {range ? range->min_s : description.duration_s,
              range ? range->max_s : description.duration_s}},
            {"criteria", description.criteria},
            {"knee", maneuver_design::knee_point(front.objectives())},
            {"points", Json::array()},
            {"weighted_sums", Json::array()}};
  for (const maneuver_design::ParetoPoint& point : front.points) {
    data["points"].push_back(point_of(point));
  }
  for (const maneuver_design::ParetoPoint& point : weighted_sums.points) {
    data["weighted_sums"].push_back({point.objectives(0), point.objectives(1)});
  }
  return data;
}

}  // namespace hlc::plot
