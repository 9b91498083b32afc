#include "planner/plot/occupied_areas.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hlc::plot {
namespace {

/// Index of the area; the number of areas if it is new.
std::size_t index_of(const ConvexPolygon& area_m, const std::vector<OccupiedArea>& areas) {
  const auto found = std::ranges::find(areas, area_m, &OccupiedArea::area_m);
  return static_cast<std::size_t>(found - areas.begin());
}

std::vector<OccupiedArea> different_areas(const search::HorizonProblem& problem) {
  std::vector<OccupiedArea> areas;
  for (const auto* const of_steps : {&problem.obstacles_m, &problem.avoided_in_motion_m}) {
    for (std::size_t j = 0; j < of_steps->size(); ++j) {
      for (const ConvexPolygon& area_m : (*of_steps)[j]) {
        if (area_m.empty()) continue;
        const std::size_t index = index_of(area_m, areas);
        if (index == areas.size()) areas.push_back({.area_m = area_m, .steps = {}});
        std::vector<std::size_t>& steps = areas[index].steps;
        if (steps.empty() || steps.back() != j + 1) steps.push_back(j + 1);
      }
    }
  }
  return areas;
}

}  // namespace

std::string OccupiedAreas::name_of(const search::Obstruction& obstruction, std::size_t step,
                                   const search::HorizonProblem& problem) const {
  if (!obstruction.obstacle) return "the boundary";
  const ConvexPolygon& area_m = problem.area_m(step, *obstruction.obstacle);
  return fmt::format("area {}", index_of(area_m, areas) + 1);
}

OccupiedAreas occupied_areas(const search::HorizonProblem& problem,
                             const search::SearchTree& tree) {
  OccupiedAreas occupied{.areas = different_areas(problem)};
  for (const search::TreeVertex& vertex : tree.vertices) {
    if (vertex.fate != search::Fate::kCollision) continue;
    const auto met = search::obstruction_of(*vertex.maneuver, vertex.depth,
                                            tree.vertices[vertex.parent].frame, problem);
    if (!met) continue;
    if (!met->obstacle) {
      ++occupied.dropped_by_boundary;
      continue;
    }
    const ConvexPolygon& area_m = problem.area_m(vertex.depth, *met->obstacle);
    ++occupied.areas[index_of(area_m, occupied.areas)].dropped;
  }
  return occupied;
}

std::string ranges_of(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += text.empty() ? "" : ", ";
    text +=
        last == i ? fmt::to_string(numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace hlc::plot
