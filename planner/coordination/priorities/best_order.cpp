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
      : graph_(&graph), plan_(&plan), best_(std::move(start)), least_(plan_all(best_)) {}

  [[nodiscard]] std::vector<VehicleId> result() && {
    std::vector<VehicleId> reversed(best_.rbegin(), best_.rend());
    if (!is_used_up()) static_cast<void>(take_if_better(std::move(reversed)));
    while (promote_any()) {
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] bool is_used_up() const { return expanded_ >= kMostOrderExpansions; }

  /// False: no promotion helps, or the budget is used up.
  bool promote_any() {
    std::vector<VehicleId> by_regret = best_;
    std::map<VehicleId, double> regret;
    for (std::size_t i = 0; i < best_.size(); ++i) {
      const double cheapest_m2 = cheapest_.at(best_[i]);
      const bool has_ever_planned = std::isfinite(cheapest_m2);
      regret[best_[i]] = has_ever_planned ? least_.costs_m2[i] - cheapest_m2 : 0.0;
    }
    std::ranges::stable_sort(by_regret, std::greater<>{},
                             [&regret](VehicleId one) { return regret.at(one); });
    return std::ranges::any_of(by_regret, [this](VehicleId one) { return promote(one); });
  }

  /// Before all others, or before the last one that it has to make way for.
  bool promote(VehicleId vehicle) {
    const auto own = std::ranges::find(best_, vehicle);
    auto last = own;
    while (last != best_.begin() && !graph_->are_coupled(*(last - 1), vehicle)) --last;
    if (last == best_.begin()) return false;  // it makes way for nobody
    const auto place = own - best_.begin();
    const auto before_last = last - best_.begin() - 1;
    return (!is_used_up() && take_if_better(moved(place, 0))) ||
           (before_last > 0 && !is_used_up() && take_if_better(moved(place, before_last)));
  }

  [[nodiscard]] std::vector<VehicleId> moved(std::ptrdiff_t from, std::ptrdiff_t to) const {
    std::vector<VehicleId> order = best_;
    std::rotate(order.begin() + to, order.begin() + from, order.begin() + from + 1);
    return order;
  }

  bool take_if_better(std::vector<VehicleId> order) {
    OrderCost cost = plan_all(order);
    if (!is_better(cost, least_)) return false;
    least_ = std::move(cost);
    best_ = std::move(order);
    return true;
  }

  OrderCost plan_all(const std::vector<VehicleId>& order) {
    OrderCost cost = (*plan_)(order);
    expanded_ += cost.expanded;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto [known, is_first] = cheapest_.emplace(order[i], cost.costs_m2[i]);
      if (!is_first) known->second = std::min(known->second, cost.costs_m2[i]);
    }
    return cost;
  }

  const CouplingGraph* graph_;
  const TryOrder* plan_;
  std::size_t expanded_{};
  std::map<VehicleId, double> cheapest_;  ///< of all orders tried
  std::vector<VehicleId> best_;
  OrderCost least_;
};

std::vector<VehicleId> promoted(const CouplingGraph& graph, const std::vector<VehicleId>& start,
                                const TryOrder& plan) {
  if (start.size() <= kFew) {
    return cheapest_of_all_orders(graph, start, plan, kMostOrderExpansions);
  }
  return Promotions(graph, start, plan).result();
}

}  // namespace

/// All orders of up to 4 vehicles. Of more a local search: the better of the order and its reverse;
/// then the vehicle whose plan costs most above its cheapest one so far is moved to the front, or
/// before the last one that it has to make way for, as long as that makes the plans cheaper all in
/// all. Ends after kMostOrderExpansions.
constinit const PriorityStrategy kBestOrder{
    .name = "best_order",
    .meaning = "the cheapest order of up to 4 coupled vehicles, of more the best of a local search",
    .assign = &smaller_ids_first,
    .search = &promoted};

}  // namespace hlc::coordination
