#include "planner/coordination/priority.hpp"

namespace hlc::coordination {

std::vector<VehicleId> smaller_ids_first(const PrioritySituation& /*situation*/) { return {}; }

/// The same in every step.
constinit const PriorityStrategy kConstantPriorities{
    .name = "constant", .meaning = "smaller ids first", .assign = &smaller_ids_first};

}  // namespace hlc::coordination
