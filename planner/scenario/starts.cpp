#include "planner/scenario/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/common/demand.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::scenario {
namespace {

/// Uniform in [0, 1), independent of the library: the standard does not fix its own distribution.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> overlapping_starts(const Scenario& scenario) {
  const vehicle::VehicleParameters& parameters = scenario.subgraph->automaton().vehicle;
  std::vector<ConvexPolygon> areas;
  for (std::size_t j = 0; j < scenario.vehicles.size(); ++j) {
    areas.push_back(footprint_area(parameters.footprint, scenario.vehicles[j].start,
                                   parameters.safety_margin_m));
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

Scenario with_random_starts(const Scenario& scenario, std::uint64_t seed) {
  constexpr int kDraws = 1000;
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
    if (!overlapping_starts(candidate)) return candidate;
  }
  throw std::invalid_argument(
      fmt::format("{}: {} vehicles, too many for random starts without overlap",
                  scenario.file.string(), scenario.vehicles.size()));
}

}  // namespace hlc::scenario
