#pragma once

#include <utility>
#include <vector>

#include "planner/coordination/coupling.hpp"

namespace hlc::coordination {

/// The graph of messages that a test writes down on the spot.
inline CouplingGraph graph_of(const std::vector<Traffic>& traffic) {
  std::vector<const Traffic*> pointers;
  for (const Traffic& one : traffic) pointers.push_back(&one);
  return CouplingGraph(std::move(pointers));
}

}  // namespace hlc::coordination
