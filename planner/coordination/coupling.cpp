#include "planner/coordination/coupling.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

namespace hlc::coordination {

CouplingGraph::CouplingGraph(std::vector<const Traffic*> traffic, const CouplingRule& rule) {
  std::ranges::sort(traffic, {}, [](const Traffic* one) { return one->vehicle; });
  neighbours_.resize(traffic.size());
  vehicles_.reserve(traffic.size());
  for (const Traffic* one : traffic) vehicles_.push_back(one->vehicle);
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    for (std::size_t j = i + 1; j < traffic.size(); ++j) {
      if (coordination::are_coupled(*traffic[i], *traffic[j], rule)) {
        neighbours_[i].push_back(j);
        neighbours_[j].push_back(i);
      }
    }
  }
}

std::size_t CouplingGraph::index(VehicleId vehicle) const {
  const auto found = std::ranges::lower_bound(vehicles_, vehicle);
  HLC_DEMAND(found != vehicles_.end() && *found == vehicle, vehicle);
  return static_cast<std::size_t>(found - vehicles_.begin());
}

bool CouplingGraph::are_coupled(VehicleId a, VehicleId b) const {
  return std::ranges::find(neighbours_[index(a)], index(b)) != neighbours_[index(a)].end();
}

std::vector<VehicleId> CouplingGraph::neighbours(VehicleId vehicle) const {
  const auto& neighbours = neighbours_[index(vehicle)];
  std::vector<VehicleId> result;
  result.reserve(neighbours.size());
  for (const std::size_t i : neighbours) result.push_back(vehicles_[i]);
  return result;
}

std::vector<VehicleId> CouplingGraph::component(VehicleId vehicle) const {
  std::vector<bool> seen(vehicles_.size(), false);
  std::vector<std::size_t> open{index(vehicle)};
  seen[open.front()] = true;
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const std::size_t j : neighbours_[i]) {
      if (!seen[j]) {
        seen[j] = true;
        open.push_back(j);
      }
    }
  }
  std::vector<VehicleId> result;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) result.push_back(vehicles_[i]);
  }
  return result;
}

}  // namespace hlc::coordination
