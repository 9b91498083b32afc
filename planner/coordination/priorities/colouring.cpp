#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <set>

#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

/// The smallest colour that no neighbour has, vehicles with most neighbours first.
std::map<VehicleId, std::size_t> colours(const CouplingGraph& graph) {
  std::vector<VehicleId> by_degree = graph.vehicles();
  std::ranges::stable_sort(by_degree, std::greater<>{}, [&graph](VehicleId vehicle) {
    return graph.neighbours(vehicle).size();
  });
  std::map<VehicleId, std::size_t> colours;
  for (const VehicleId vehicle : by_degree) {
    std::set<std::size_t> taken;
    for (const VehicleId other : graph.neighbours(vehicle)) {
      const auto found = colours.find(other);
      if (found != colours.end()) taken.insert(found->second);
    }
    std::size_t colour = 0;
    while (taken.contains(colour)) ++colour;
    colours[vehicle] = colour;
  }
  return colours;
}

std::vector<VehicleId> by_colour(const PrioritySituation& situation) {
  const std::map<VehicleId, std::size_t> colour_of = colours(situation.graph);
  std::vector<VehicleId> order = situation.graph.vehicles();
  std::ranges::stable_sort(order, {},
                           [&colour_of](VehicleId vehicle) { return colour_of.at(vehicle); });
  return order;
}

}  // namespace

/// Few computation levels: no more than colours of a greedy colouring of the coupling graph (after
/// Welsh and Powell), at most one more than the most neighbours of a vehicle. P. Scheffe, J. Kahle,
/// B. Alrifaee, "Reducing Computation Time with Priority Assignment in Distributed MPC", colour in
/// a decentralised way and order the colours by their number of constraints.
constinit const PriorityStrategy kColouringPriorities{
    .name = "colouring", .meaning = "few computation levels", .assign = &by_colour};

}  // namespace hlc::coordination
