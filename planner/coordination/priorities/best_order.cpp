#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "planner/coordination/priorities/all_orders.hpp"
#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

constexpr std::size_t kFew = 4;  // 24 orders

/// Lets those plan earlier that pay most for planning late.
class Promotions {
 public:
  Promotions(const CouplingGraph& graph, std::vector<VehicleId> start, const TryOrder& plan)
      : graph_(&graph), plan_(&plan), best_(std::move(start)), least_((*plan_)(best_, nullptr)) {
    expanded_ = least_.expanded;
    for (const VehicleId one : best_) {
      if (is_used_up()) break;
      const OrderCost alone = (*plan_)({one}, nullptr);
      expanded_ += alone.expanded;
      alone_m2_[one] = alone.costs_m2.front();
    }
  }

  [[nodiscard]] std::vector<VehicleId> result() && {
    if (!is_any_late()) return std::move(best_);
    if (best_.size() <= kFew) {
      return cheapest_of_all_orders(*graph_, best_, *plan_, kMostOrderExpansions - expanded_);
    }
    static_cast<void>(take_if_better({best_.rbegin(), best_.rend()}));
    while (promote_any()) {
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] bool is_used_up() const { return expanded_ >= kMostOrderExpansions; }

  /// What it costs a vehicle that it does not plan first.
  [[nodiscard]] double regret_m2(std::size_t place) const {
    const auto alone_m2 = alone_m2_.find(best_[place]);
    const bool is_known = alone_m2 != alone_m2_.end() && std::isfinite(alone_m2->second);
    return is_known ? least_.costs_m2[place] - alone_m2->second : 0.0;
  }

  /// Otherwise no order is better than the best one, or the budget is used up.
  [[nodiscard]] bool is_any_late() const {
    if (is_used_up()) return false;
    for (std::size_t i = 0; i < best_.size(); ++i) {
      if (regret_m2(i) > 0.0) return true;
    }
    return false;
  }

  /// False: no promotion helps, or the budget is used up.
  bool promote_any() {
    std::vector<std::pair<double, VehicleId>> late;
    for (std::size_t i = 0; i < best_.size(); ++i) {
      if (regret_m2(i) > 0.0) late.emplace_back(regret_m2(i), best_[i]);
    }
    std::ranges::stable_sort(late, std::greater<>{}, [](const auto& one) { return one.first; });
    return std::ranges::any_of(late, [this](const auto& one) { return promote(one.second); });
  }

  /// Before all others, or before the last one that it has to make way for.
  bool promote(VehicleId vehicle) {
    const auto own = std::ranges::find(best_, vehicle);
    auto last = own;
    while (last != best_.begin() && !graph_->are_coupled(*(last - 1), vehicle)) --last;
    if (last == best_.begin()) return false;  // it makes way for nobody
    const auto place = own - best_.begin();
    const auto before_last = last - best_.begin() - 1;
    return take_if_better(moved(place, 0)) ||
           (before_last > 0 && take_if_better(moved(place, before_last)));
  }

  [[nodiscard]] std::vector<VehicleId> moved(std::ptrdiff_t from, std::ptrdiff_t to) const {
    std::vector<VehicleId> order = best_;
    std::rotate(order.begin() + to, order.begin() + from, order.begin() + from + 1);
    return order;
  }

  /// Not if the budget is used up.
  bool take_if_better(std::vector<VehicleId> order) {
    if (is_used_up()) return false;
    OrderCost cost = (*plan_)(order, &least_);
    expanded_ += cost.expanded;
    if (!is_better(cost, least_)) return false;
    least_ = std::move(cost);
    best_ = std::move(order);
    return true;
  }

  const CouplingGraph* graph_;
  const TryOrder* plan_;
  std::size_t expanded_{};
  std::map<VehicleId, double> alone_m2_;  ///< costs of those that plan first
  std::vector<VehicleId> best_;
  OrderCost least_;
};

std::vector<VehicleId> promoted(const CouplingGraph& graph, const std::vector<VehicleId>& start,
                                const TryOrder& plan) {
  return Promotions(graph, start, plan).result();
}

}  // namespace

/// The order to start from, where no vehicle would pay less if it planned first. Otherwise all
/// orders of up to 4 vehicles. Of more a local search: the better of the order and its reverse;
/// then the vehicle that pays most for planning late is moved to the front, or before the last one
/// that it has to make way for, as long as that makes the plans cheaper all in all. Ends after
/// kMostOrderExpansions.
constinit const PriorityStrategy kBestOrder{
    .name = "best_order",
    .meaning = "the cheapest order of up to 4 coupled vehicles, of more the best of a local search",
    .assign = &smaller_ids_first,
    .search = &promoted};

}  // namespace hlc::coordination
