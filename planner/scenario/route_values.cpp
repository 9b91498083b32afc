#include "planner/scenario/route_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace hlc::scenario {
namespace {

using Lanelets = std::vector<road::LaneletId>;

/// Index of the lanelet that the key names.
std::size_t index_of(const Node& section, const char* key, const Lanelets& lanelets) {
  const int id = section.required<int>(key);
  if (std::ranges::count(lanelets, id) != 1) {
    section.fail(key, "a lanelet that the route drives, and drives once");
  }
  return static_cast<std::size_t>(std::ranges::find(lanelets, id) - lanelets.begin());
}

/// @param taken  indices of lanelets in sections above; those of this one are added
SectionValues read_section(const Node& node, const RouteValues& route, const Lanelets& lanelets,
                           std::set<std::size_t>& taken) {
  const std::size_t first = index_of(node, "from", lanelets);
  const std::size_t last = index_of(node, "to", lanelets);
  if (!route.is_closed && last < first) {
    node.fail("to", "`from` or a lanelet after it: the route is open");
  }
  SectionValues section{
      .from = lanelets[first],
      .to = lanelets[last],
      .reference_speed_mps = node.required<double>("reference_speed_mps", above(0.0)),
      .node = node};
  node.check_no_unknown_keys();
  for (std::size_t i = first;; i = (i + 1) % lanelets.size()) {
    if (!taken.insert(i).second) {
      node.fail("from", fmt::format("the first of lanelets in no section above; lanelet {} is in "
                                    "one",
                                    lanelets[i]));
    }
    if (i == last) return section;
  }
}

void read_sections(const Node& node, RouteValues& route) {
  if (!node.has("sections")) return;
  route.sections.emplace();
  const Node by_map = node.map("sections");
  for (const std::string& benchmark_id : by_map.keys()) {
    const std::vector<Node> listed = by_map.list(benchmark_id);
    const auto lanelets = route.lanelets.find(benchmark_id);
    if (lanelets == route.lanelets.end()) {
      by_map.fail(benchmark_id, "of a map for which the route has `lanelets`");
    }
    std::set<std::size_t> taken;
    std::vector<SectionValues>& sections = (*route.sections)[benchmark_id];
    for (const Node& one : listed) {
      sections.push_back(read_section(one, route, lanelets->second, taken));
    }
  }
}

/// The route of the name, from another one of its lanelets on.
RouteValues begun_elsewhere(const std::vector<RouteValues>& routes, const Node& node) {
  const auto of = std::ranges::find(routes, node.required<std::string>("of"), &RouteValues::name);
  if (of == routes.end() || !of->is_closed) node.fail("of", "the name of a closed route above");
  const int from = node.required<int>("from");
  RouteValues route = *of;
  for (auto& [benchmark_id, lanelets] : route.lanelets) {
    const auto begin = std::ranges::find(lanelets, from);
    if (begin == lanelets.end()) node.fail("from", "a lanelet of " + of->name);
    std::ranges::rotate(lanelets, begin);
  }
  route.begins_elsewhere = true;
  route.node = of->node;
  return route;
}

RouteValues read_route(const std::vector<RouteValues>& above, const Node& node) {
  RouteValues route{.node = node};
  if (node.has("of")) {
    route = begun_elsewhere(above, node);
  } else {
    route.is_closed = node.optional<bool>("closed", true);
    const Node by_map = node.map("lanelets");
    for (const std::string& benchmark_id : by_map.keys()) {
      for (const Node& lanelet : by_map.list(benchmark_id)) {
        route.lanelets[benchmark_id].push_back(lanelet.as<int>(at_least(1.0)));
      }
    }
    read_sections(node, route);
  }
  route.name = node.required<std::string>("name");
  node.check_no_unknown_keys();
  return route;
}

}  // namespace

std::vector<RouteValues> read_routes(const Node& scenario) {
  std::vector<RouteValues> routes;
  for (const Node& node : scenario.list("routes")) routes.push_back(read_route(routes, node));
  return routes;
}

}  // namespace hlc::scenario
