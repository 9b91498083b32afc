#include <algorithm>
#include <cstddef>
#include <functional>

#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

/// In how many steps the vehicles would meet if each followed its reference.
std::size_t num_collisions(const Traffic& a, const Traffic& b) {
  const std::size_t steps = std::min(a.reference_areas_m.size(), b.reference_areas_m.size());
  std::size_t collisions = 0;
  for (std::size_t j = 0; j < steps; ++j) {
    if (intersects(a.reference_areas_m[j], b.reference_areas_m[j])) ++collisions;
  }
  return collisions;
}

std::vector<VehicleId> most_collisions_first(const PrioritySituation& situation) {
  const std::vector<VehicleId>& vehicles = situation.graph.vehicles();
  std::vector<std::size_t> collisions(vehicles.size());
  for (std::size_t a = 0; a < vehicles.size(); ++a) {
    for (std::size_t b = a + 1; b < vehicles.size(); ++b) {
      if (!situation.graph.are_coupled(vehicles[a], vehicles[b])) continue;
      const std::size_t both = num_collisions(*situation.traffic[a], *situation.traffic[b]);
      collisions[a] += both;
      collisions[b] += both;
    }
  }
  std::vector<VehicleId> order = vehicles;
  std::ranges::stable_sort(order, std::greater<>{}, [&](VehicleId vehicle) {
    return collisions[static_cast<std::size_t>(std::ranges::lower_bound(vehicles, vehicle) -
                                               vehicles.begin())];
  });
  return order;
}

}  // namespace

/// Future collision assessment (P. Scheffe, G. Dorndorf, B. Alrifaee, "Increasing Feasibility with
/// Dynamic Priority Assignment in Distributed Trajectory Planning for Road Vehicles", IV 2022).
/// Counted are the steps in which footprints of coupled vehicles on the reference points meet.
constinit const PriorityStrategy kMostCollisionsFirst{
    .name = "fca",
    .meaning = "first who would meet others most often on its reference",
    .assign = &most_collisions_first,
    .compares_references = true};

}  // namespace hlc::coordination
