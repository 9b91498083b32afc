#include "planner/road/random_tour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>

#include "planner/common/random_index.hpp"

namespace hlc::road {
namespace {

constexpr std::size_t kRandomLanelets = 200;

/// The lanelets that may follow each lanelet, ascending.
using Successors = std::map<LaneletId, std::set<LaneletId>>;

/// All that can be reached from `start` by at least one edge.
std::set<LaneletId> reachable_from(LaneletId start, const Successors& successors) {
  std::set<LaneletId> reached;
  std::vector<LaneletId> open{start};
  while (!open.empty()) {
    const LaneletId id = open.back();
    open.pop_back();
    for (const LaneletId next : successors.at(id)) {
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return reached;
}

/// The lanelets that lie on a closed way through `start`, and their successors among them.
Successors closed_ways_through(const LaneletMap& map, LaneletId start) {
  Successors forwards;
  Successors backwards;
  for (const auto& [id, lanelet] : map.lanelets) {
    forwards[id].insert(lanelet.successors.begin(), lanelet.successors.end());
    backwards[id];
    for (const LaneletId next : lanelet.successors) backwards[next].insert(id);
  }
  if (!forwards.contains(start)) {
    throw std::runtime_error(fmt::format("lanelet {} is not in the map", start));
  }
  const std::set<LaneletId> after = reachable_from(start, forwards);
  const std::set<LaneletId> before = reachable_from(start, backwards);
  if (!after.contains(start)) {
    throw std::runtime_error(
        fmt::format("no way leads back to lanelet {}; a random route must be closed", start));
  }
  std::erase_if(forwards, [&](const auto& entry) {
    return !after.contains(entry.first) || !before.contains(entry.first);
  });
  for (auto& [id, next] : forwards) {
    std::erase_if(next, [&](LaneletId one) { return !forwards.contains(one); });
  }
  return forwards;
}

/// Appends the shortest way from the end of the tour to one of the goals.
/// @pre there is one, of at least one step
void append_way(std::vector<LaneletId>& tour, const std::set<LaneletId>& goals,
                const Successors& successors) {
  const LaneletId from = tour.back();
  std::map<LaneletId, LaneletId> reached_from;
  std::deque<LaneletId> open{from};
  std::optional<LaneletId> goal;
  while (!goal) {
    const LaneletId id = open.front();
    open.pop_front();
    for (const LaneletId next : successors.at(id)) {
      if (!reached_from.emplace(next, id).second) continue;
      open.push_back(next);
      if (!goal && goals.contains(next)) goal = next;
    }
  }
  std::vector<LaneletId> way{*goal};
  while (reached_from.at(way.back()) != from) way.push_back(reached_from.at(way.back()));
  tour.insert(tour.end(), way.rbegin(), way.rend());
}

}  // namespace

std::vector<LaneletId> random_tour(const LaneletMap& map, LaneletId start, std::uint64_t seed,
                                   std::uint8_t vehicle) {
  const Successors successors = closed_ways_through(map, start);
  std::seed_seq seeds{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                      static_cast<std::uint32_t>(vehicle)};
  std::mt19937_64 random(seeds);
  std::vector<LaneletId> tour{start};
  while (tour.size() < kRandomLanelets) {
    const std::set<LaneletId>& next = successors.at(tour.back());
    tour.push_back(
        *std::next(next.begin(), static_cast<std::ptrdiff_t>(random_index(random, next.size()))));
  }
  std::set<LaneletId> unvisited;
  for (const auto& [id, next] : successors) unvisited.insert(id);
  for (const LaneletId id : tour) unvisited.erase(id);
  const bool visits_all = successors.size() <= kRandomLanelets;
  while (visits_all && !unvisited.empty()) {
    const std::size_t from = tour.size();
    append_way(tour, unvisited, successors);
    for (std::size_t i = from; i < tour.size(); ++i) unvisited.erase(tour[i]);
  }
  append_way(tour, {start}, successors);
  tour.pop_back();  // the start again
  std::rotate(tour.begin(), tour.end() - 1, tour.end());
  return tour;
}

}  // namespace hlc::road
