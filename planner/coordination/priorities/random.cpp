#include <algorithm>
#include <cstdint>

#include "planner/common/word_hash.hpp"
#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

/// By a hash of step and id, so that all controllers draw the same.
std::vector<VehicleId> drawn_order(const PrioritySituation& situation) {
  std::vector<VehicleId> order = situation.graph.vehicles();
  if (order.empty()) return order;
  const StepIndex step = situation.traffic.front()->step;
  std::ranges::sort(order, {}, [step](VehicleId vehicle) {
    WordHash hash;
    hash.add(step.value);
    hash.add(std::uint64_t{vehicle.value});
    return hash.value();
  });
  return order;
}

}  // namespace

/// For comparison: what a strategy gains must be more than this one does.
constinit const PriorityStrategy kRandomPriorities{
    .name = "random", .meaning = "drawn in every step", .assign = &drawn_order};

}  // namespace hlc::coordination
