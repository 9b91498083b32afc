#include <algorithm>
#include <functional>

#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

std::vector<VehicleId> longest_standing_first(const PrioritySituation& situation) {
  std::vector<const Traffic*> traffic(situation.traffic.begin(), situation.traffic.end());
  std::ranges::stable_sort(traffic, std::greater<>{}, &Traffic::standing_steps);
  std::vector<VehicleId> order;
  order.reserve(traffic.size());
  for (const Traffic* one : traffic) order.push_back(one->vehicle);
  return order;
}

}  // namespace

/// A vehicle that has been kept standing gets its turn.
constinit const PriorityStrategy kWaitingTimePriorities{.name = "waiting_time",
                                                        .meaning = "first who has stood longest",
                                                        .assign = &longest_standing_first};

}  // namespace hlc::coordination
