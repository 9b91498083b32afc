#include "planner/scenario/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/common/demand.hpp"
#include "planner/common/random_index.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/road/random_tour.hpp"
#include "planner/road/route.hpp"
#include "planner/scenario/right_of_way.hpp"

namespace hlc::scenario {
namespace {

constexpr int kDraws = 1000;

/// Uniform in [0, 1), independent of the library: the standard does not fix its own distribution.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

ConvexPolygon start_area(const Scenario& scenario, const ScenarioVehicle& vehicle) {
  const vehicle::VehicleParameters& parameters = scenario.subgraph->automaton().vehicle;
  return footprint_area(parameters.footprint, vehicle.start, parameters.safety_margin_m);
}

ConvexPolygon start_area(const ScenarioGuest& guest) {
  return footprint_area(guest.guest.footprint, guest.start, guest.guest.safety_margin_m);
}

std::invalid_argument too_many(const Scenario& scenario) {
  return std::invalid_argument(
      fmt::format("{}: {} vehicles, too many for random starts without overlap",
                  scenario.file.string(), scenario.vehicles.size()));
}

/// Takes the areas from `first` to `end` in a random order, besides those taken before, and leaves
/// out those that overlap with one taken.
std::vector<std::size_t> drawn(const std::vector<ConvexPolygon>& areas, std::size_t first,
                               std::size_t end, std::vector<std::size_t> taken, std::size_t most,
                               std::mt19937_64& random) {
  std::vector<std::size_t> left(end - first);
  std::iota(left.begin(), left.end(), first);
  while (taken.size() < most && !left.empty()) {
    std::swap(left[random_index(random, left.size())], left.back());
    const std::size_t one = left.back();
    left.pop_back();
    const auto overlaps = [&](std::size_t other) { return intersects(areas[one], areas[other]); };
    if (std::ranges::none_of(taken, overlaps)) taken.push_back(one);
  }
  return taken;
}

/// Whether a footprint at the start overlaps an obstacle or a guest.
bool is_taken(const Scenario& scenario, const ConvexPolygon& start_area_m) {
  return std::ranges::any_of(
             scenario.obstacles,
             [&](const ScenarioObstacle& one) { return intersects(start_area_m, one.area_m); }) ||
         std::ranges::any_of(scenario.guests, [&](const ScenarioGuest& one) {
           return intersects(start_area_m, start_area(one));
         });
}

}  // namespace

std::vector<road::DrivableRoute> routes_of(std::span<const ScenarioVehicle> vehicles) {
  std::vector<road::DrivableRoute> routes;
  for (const ScenarioVehicle& one : vehicles) {
    routes.push_back({.name = one.name,
                      .path = one.path,
                      .corridor = one.corridor,
                      .goal = one.goal,
                      .speed_sections = one.speed_sections});
  }
  return routes;
}

ScenarioVehicle on_random_route(ScenarioVehicle vehicle, const road::LaneletMap& map,
                                std::uint64_t seed) {
  road::Route route = road::build_route(
      map, road::random_tour(map, vehicle.start_lanelet, seed, vehicle.id.value), true);
  // The tour's second lanelet is the first of the car's.
  vehicle.start_s_m =
      route.path
          .project_within(vehicle.start.position_m(), route.lanelet_s_m[1], route.lanelet_s_m[2])
          .s_m;
  vehicle.path = std::move(route.path);
  vehicle.corridor = std::move(route.corridor);
  vehicle.speed_sections.clear();  // of another route
  return vehicle;
}

std::vector<ScenarioVehicle> draw_cars(const Scenario& scenario, std::size_t cars,
                                       std::uint64_t seed) {
  std::vector<const ScenarioVehicle*> candidates;
  std::vector<ConvexPolygon> areas;
  const auto add_all = [&](const std::vector<ScenarioVehicle>& list) {
    for (const ScenarioVehicle& one : list) {
      ConvexPolygon area_m = start_area(scenario, one);
      if (is_taken(scenario, area_m)) continue;
      candidates.push_back(&one);
      areas.push_back(std::move(area_m));
    }
    return areas.size();
  };
  const std::size_t num_first = add_all(scenario.candidates);
  add_all(scenario.further_candidates);
  std::mt19937_64 random(seed);
  std::vector<std::size_t> best;
  const auto draw_from = [&](std::size_t first, std::size_t end) {
    const std::vector<std::size_t> before = best;
    for (int draw = 0; draw < kDraws && best.size() < cars; ++draw) {
      std::vector<std::size_t> taken = drawn(areas, first, end, before, cars, random);
      if (taken.size() > best.size()) best = std::move(taken);
    }
  };
  draw_from(0, num_first);
  draw_from(num_first, areas.size());
  std::vector<ScenarioVehicle> vehicles;
  for (const std::size_t i : best) {
    ScenarioVehicle vehicle = *candidates[i];
    vehicle.id = {static_cast<std::uint8_t>(vehicles.size() + 1)};
    vehicles.push_back(scenario.random_routes_on
                           ? on_random_route(std::move(vehicle), *scenario.random_routes_on, seed)
                           : std::move(vehicle));
  }
  return vehicles;
}

std::optional<std::pair<std::size_t, std::size_t>> start_in_obstacle(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    const ConvexPolygon area_m = start_area(scenario, scenario.vehicles[i]);
    for (std::size_t j = 0; j < scenario.obstacles.size(); ++j) {
      if (intersects(area_m, scenario.obstacles[j].area_m)) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

std::string overlapped_by_guest(std::size_t index, const Scenario& scenario) {
  const ConvexPolygon area_m = start_area(scenario.guests[index]);
  const auto meets = [&area_m](const ConvexPolygon& other_m) {
    return intersects(area_m, other_m);
  };
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    if (meets(start_area(scenario, vehicle))) return fmt::format("vehicle {}", vehicle.id.value);
  }
  for (std::size_t before = 0; before < index; ++before) {
    const ScenarioGuest& other = scenario.guests[before];
    if (meets(start_area(other))) return fmt::format("guest {}", other.guest.vehicle.value);
  }
  for (const ScenarioObstacle& one : scenario.obstacles) {
    if (meets(one.area_m)) return fmt::format("obstacle {}", one.name);
  }
  return {};
}

std::optional<std::pair<std::size_t, std::size_t>> overlapping_starts(const Scenario& scenario) {
  std::vector<ConvexPolygon> areas;
  for (std::size_t j = 0; j < scenario.vehicles.size(); ++j) {
    areas.push_back(start_area(scenario, scenario.vehicles[j]));
    for (std::size_t i = 0; i < j; ++i) {
      if (intersects(areas[i], areas[j])) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

Scenario with_starts(Scenario scenario, std::span<const double> starts_s_m) {
  HLC_DEMAND(starts_s_m.size() == scenario.vehicles.size(), starts_s_m.size(),
             scenario.vehicles.size());
  for (std::size_t i = 0; i < starts_s_m.size(); ++i) {
    ScenarioVehicle& vehicle = scenario.vehicles[i];
    const Point position_m = vehicle.path.at(starts_s_m[i]);
    vehicle.start_s_m = starts_s_m[i];
    vehicle.start = {position_m.x(), position_m.y(), vehicle.path.heading_rad_at(starts_s_m[i])};
  }
  return scenario;
}

namespace {

/// With as many cars, drawn again from the candidates.
Scenario redrawn(Scenario scenario, std::uint64_t seed) {
  std::vector<ScenarioVehicle> vehicles = draw_cars(scenario, scenario.vehicles.size(), seed);
  if (vehicles.size() < scenario.vehicles.size()) throw too_many(scenario);
  scenario.seed = seed;
  scenario.vehicles = std::move(vehicles);
  if (scenario.random_routes_on) scenario.routes = routes_of(scenario.vehicles);
  return scenario;
}

/// With the same cars elsewhere on their paths.
Scenario displaced(const Scenario& scenario, std::uint64_t seed) {
  const bool are_closed = std::ranges::all_of(
      scenario.vehicles, [](const ScenarioVehicle& vehicle) { return vehicle.path.is_closed(); });
  if (!are_closed) {
    throw std::invalid_argument(scenario.file.string() +
                                ": open paths; random starts need closed "
                                "routes");
  }
  std::mt19937_64 random(seed);
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> starts_s_m;
    for (const ScenarioVehicle& vehicle : scenario.vehicles) {
      starts_s_m.push_back(uniform(random) * vehicle.path.length_m());
    }
    Scenario candidate = with_starts(scenario, starts_s_m);
    const bool is_any_taken =
        std::ranges::any_of(candidate.vehicles, [&candidate](const ScenarioVehicle& vehicle) {
          return is_taken(candidate, start_area(candidate, vehicle));
        });
    if (!overlapping_starts(candidate) && !is_any_taken) return candidate;
  }
  throw too_many(scenario);
}

}  // namespace

Scenario with_random_starts(const Scenario& scenario, std::uint64_t seed) {
  Scenario other =
      scenario.candidates.empty() ? displaced(scenario, seed) : redrawn(scenario, seed);
  for (ScenarioGuest& guest : other.guests) guest.seed += seed;
  if (!scenario.candidates.empty()) relate_routes(other);
  return other;
}

void check_random_starts(const Scenario& scenario, std::uint64_t seed) {
  static_cast<void>(scenario.candidates.empty() ? displaced(scenario, seed)
                                                : redrawn(scenario, seed));
}

}  // namespace hlc::scenario
