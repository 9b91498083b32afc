#include "planner/plot/problem_data.hpp"

#include <array>
#include <utility>

#include "planner/geometry/footprint.hpp"
#include "planner/plot/json_points.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::plot {
namespace {

using Json = nlohmann::ordered_json;

/// Result: of one vehicle or of several.
template <class Result>
Json heading_of(const automaton::Subgraph& subgraph, std::size_t horizon_steps,
                const Result& result) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const Footprint& footprint = automaton.vehicle.footprint;
  return {{"subgraph", subgraph.spec().name},
          {"horizon_steps", horizon_steps},
          {"step_s", automaton.step_s},
          {"status", search::to_string(result.status)},
          {"reason", search::to_string(result.reason)},
          {"cost_m2", result.cost},
          {"footprint", {{"length_m", footprint.length_m}, {"width_m", footprint.width_m}}},
          {"vehicles", Json::array()}};
}

Json vehicle_of(const search::HorizonProblem& problem, const search::SearchResult& result) {
  Json json{{"start", json_pose(problem.start)},
            {"reference", json_points(problem.reference_m)},
            {"boundary", Json::array()},
            {"obstacles", Json::array()},
            {"poses", Json::array()},
            {"swept", Json::array()}};
  for (const Segment& segment : problem.boundary_m) {
    json["boundary"].push_back(json_points(std::array{segment.from_m, segment.to_m}));
  }
  const bool has_areas = !problem.obstacles_m.empty() || !problem.avoided_in_motion_m.empty();
  for (std::size_t j = 0; has_areas && j < problem.horizon_steps(); ++j) {
    Json areas = Json::array();
    for (const auto* const of_steps : {&problem.obstacles_m, &problem.avoided_in_motion_m}) {
      if (of_steps->empty()) continue;
      for (const ConvexPolygon& area_m : (*of_steps)[j]) {
        if (!area_m.empty()) areas.push_back(json_points(area_m.vertices_m));
      }
    }
    json["obstacles"].push_back(std::move(areas));
  }
  Pose from = problem.start;
  for (std::size_t j = 0; j < result.maneuvers.size(); ++j) {
    json["swept"].push_back(
        json_points(transformed(result.maneuvers[j]->swept_area_m, from).vertices_m));
    from = result.poses[j];
    json["poses"].push_back(json_pose(from));
  }
  return json;
}

}  // namespace

Json problem_data(const scenario::ProblemFile& file, const search::SearchResult& result) {
  Json data = heading_of(*file.subgraph, file.problem.horizon_steps(), result);
  data["vehicles"].push_back(vehicle_of(file.problem, result));
  return data;
}

Json problem_data(const scenario::JointProblemFile& file,
                  const joint_search::JointSearchResult& result) {
  Json data = heading_of(*file.subgraph, file.problems.front().horizon_steps(), result);
  const search::SearchResult none;
  for (std::size_t i = 0; i < file.problems.size(); ++i) {
    data["vehicles"].push_back(
        vehicle_of(file.problems[i], result.plans.empty() ? none : result.plans[i]));
  }
  return data;
}

}  // namespace hlc::plot
