#include "planner/apps/search_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "planner/search/search_options.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;
using search::Fate;
using search::RecordedSearch;

Json to_json(const std::optional<search::Obstruction>& obstruction) {
  if (!obstruction) return nullptr;
  return obstruction->obstacle ? Json(*obstruction->obstacle) : Json("boundary");
}

Json to_json(const automaton::Maneuver& maneuver) {
  return {{"trim", maneuver.to.index + 1}, {"label", maneuver.label}};
}

Json trims_of(const search::SearchResult& plan) {
  Json trims = Json::array();
  for (const automaton::Maneuver* maneuver : plan.maneuvers) {
    trims.push_back(maneuver->to.index + 1);
  }
  return trims;
}

Json plans_of(const search::PlanCounts& counts) {
  Json json{{"total", counts.total}};
  for (const Fate fate : {Fate::kCollision, Fate::kBound, Fate::kOpen}) {
    json[to_string(fate)] = counts.fates[static_cast<std::size_t>(fate)];
  }
  return json;
}

Json depths_of(const search::SearchTree& tree) {
  Json json = Json::array();
  for (const search::DepthCounts& depth : counts_by_depth(tree)) {
    Json& row = json.emplace_back(Json{{"generated", depth.generated}});
    for (std::size_t fate = 0; fate < search::kFates; ++fate) {
      row[search::to_string(static_cast<Fate>(fate))] = depth.fates[fate];
    }
    row["least_f"] = depth.least_estimate_m2;
  }
  return json;
}

Json alternatives_of(const RecordedSearch& recorded) {
  const bool has_plan = !recorded.result.maneuvers.empty();
  Json json = Json::array();
  for (const search::Alternative& one : recorded.alternatives) {
    const bool leads_to_plan = !one.best.maneuvers.empty();
    json.push_back(
        {{"maneuver", to_json(*one.first)},
         {"cost", leads_to_plan ? Json(one.best.cost) : Json()},
         {"extra", leads_to_plan && has_plan ? Json(one.best.cost - recorded.result.cost) : Json()},
         {"status", search::to_string(one.best.status)},
         {"reason", search::to_string(one.best.reason)},
         {"obstruction", to_json(one.obstruction)},
         {"trims", trims_of(one.best)}});
  }
  return json;
}

Json vertex_of(std::uint32_t id, const search::SearchTree& tree,
               const search::HorizonProblem& problem) {
  const search::TreeVertex& vertex = tree.vertices[id];
  const bool is_root = id == 0;
  std::optional<search::Obstruction> obstruction;
  if (vertex.fate == Fate::kCollision) {
    obstruction = search::obstruction_of(*vertex.maneuver, vertex.depth,
                                         tree.vertices[vertex.parent].frame, problem);
  }
  return {{"id", id},
          {"parent", is_root ? Json() : Json(vertex.parent)},
          {"depth", vertex.depth},
          {"maneuver", is_root ? Json() : to_json(*vertex.maneuver)},
          {"x", vertex.frame.origin_m.x()},
          {"y", vertex.frame.origin_m.y()},
          {"g", vertex.cost_so_far_m2},
          {"f", vertex.estimate_m2},
          {"fate", search::to_string(vertex.fate)},
          {"obstruction", to_json(obstruction)}};
}

}  // namespace

std::string search_json(const scenario::ProblemFile& file, const RecordedSearch& recorded) {
  const search::SearchResult& result = recorded.result;
  const bool has_plan = !result.maneuvers.empty();
  const search::Alternative* const second = runner_up(recorded.alternatives);
  Json json;
  json["status"] = search::to_string(result.status);
  json["reason"] = search::to_string(result.reason);
  json["cost"] = has_plan ? Json(result.cost) : Json();
  json["lower_bound"] = has_plan ? Json(result.lower_bound) : Json();
  json["generated"] = result.generated;
  json["expanded"] = result.expanded;
  json["trims"] = trims_of(result);
  json["plans"] = plans_of(count_plans(recorded.tree, *file.subgraph, file.problem));
  json["depths"] = depths_of(recorded.tree);
  json["runner_up"] = second == nullptr ? Json() : Json(second - recorded.alternatives.data());
  json["alternatives"] = alternatives_of(recorded);
  const std::vector<std::uint32_t> shown = vertices_to_show(recorded.tree, kMostWritten);
  json["vertices"] = Json::array();
  for (const std::uint32_t id : shown) {
    json["vertices"].push_back(vertex_of(id, recorded.tree, file.problem));
  }
  json["vertices_left_out"] = recorded.tree.vertices.size() - shown.size();
  return json.dump() + "\n";
}

}  // namespace hlc::apps
