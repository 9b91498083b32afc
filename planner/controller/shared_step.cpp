#include "planner/controller/shared_step.hpp"

#include <algorithm>
#include <utility>

namespace hlc::controller {
namespace {

/// Equal in all that a CouplingGraph depends on.
bool couples_alike(const coordination::Traffic* a, const coordination::Traffic* b) {
  return a == b || (a->vehicle == b->vehicle && a->reachable_area_m == b->reachable_area_m);
}

}  // namespace

const SharedStep::Coupling& SharedStep::coupling(std::vector<const coordination::Traffic*> traffic,
                                                 const coordination::PriorityRule& plans_before) {
  std::ranges::sort(traffic, {}, [](const coordination::Traffic* one) { return one->vehicle; });
  if (!coupling_ || plans_before != plans_before_ ||
      !std::ranges::equal(traffic, traffic_, couples_alike)) {
    traffic_ = traffic;
    plans_before_ = plans_before;
    coordination::CouplingGraph graph(std::move(traffic));
    auto levels = coordination::computation_levels(graph, plans_before);
    coupling_.emplace(std::move(graph), std::move(levels));
  }
  return *coupling_;
}

const std::vector<double>& SharedStep::granted(const right_of_way::ConflictMap& map,
                                               const std::vector<right_of_way::Holder>& holders,
                                               std::span<const right_of_way::Blocked> blocked,
                                               double look_ahead_m) {
  const bool is_known = granted_ && granted_->map == &map && granted_->holders == holders &&
                        std::ranges::equal(granted_->blocked, blocked) &&
                        granted_->look_ahead_m == look_ahead_m;
  if (!is_known) {
    granted_.emplace(&map, holders,
                     std::vector<right_of_way::Blocked>(blocked.begin(), blocked.end()),
                     look_ahead_m, right_of_way::grant(map, holders, blocked, look_ahead_m));
  }
  return granted_->ahead_m;
}

}  // namespace hlc::controller
