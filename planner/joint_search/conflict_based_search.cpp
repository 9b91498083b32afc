#include "planner/joint_search/conflict_based_search.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "planner/common/demand.hpp"

namespace hlc::joint_search {
namespace {

using search::HorizonProblem;
using search::NoPath;
using search::SearchResult;
using search::SearchStatus;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A node whose bound is so close to the best plan's cost is not taken: far above rounding.
constexpr double kLeastGain = 1e-9;

/// A point that one vehicle may not cover in one step, and those before.
struct Constraint {
  std::size_t step{};
  Point point_m{Point::Zero()};
  std::shared_ptr<const Constraint> before;
};

ConvexPolygon forbidden_area(const Point& point_m) {
  const double r = kPoint_m;
  return {{point_m + Point(r, 0.0), point_m + Point(-0.5 * r, 0.8 * r),
           point_m + Point(-0.5 * r, -0.8 * r)}};
}

/// A vehicle's optimum under its constraints.
struct VehiclePlan {
  SearchResult result;
  double bound_m2{};  ///< no plan under the constraints costs less; infinite: none exists
  std::vector<ConvexPolygon> areas_m;

  [[nodiscard]] bool is_found() const { return !result.maneuvers.empty(); }
};

/// Two plans share a point.
struct Conflict {
  std::size_t a{};
  std::size_t b{};
  std::size_t step{};
  Point point_m{Point::Zero()};
};

struct Node {
  std::vector<std::shared_ptr<const Constraint>> constraints;  ///< by vehicle; nullptr: none
  std::vector<std::shared_ptr<const VehiclePlan>> plans;       ///< by vehicle
  double bound_m2{};
  std::size_t number{};  ///< in the order in which they were made
};

/// The last one made first, of equal bounds: it has most constraints.
struct IsTakenLater {
  bool operator()(const Node& a, const Node& b) const {
    return a.bound_m2 != b.bound_m2 ? a.bound_m2 > b.bound_m2 : a.number < b.number;
  }
};

std::vector<Conflict> conflicts_of(const Node& node) {
  std::vector<Conflict> conflicts;
  for (std::size_t a = 0; a < node.plans.size(); ++a) {
    for (std::size_t b = a + 1; b < node.plans.size(); ++b) {
      const auto& areas_a = node.plans[a]->areas_m;
      const auto& areas_b = node.plans[b]->areas_m;
      for (std::size_t j = 0; j < areas_a.size(); ++j) {
        if (const auto point_m = shared_point_m(areas_a[j], areas_b[j])) {
          conflicts.push_back({.a = a, .b = b, .step = j, .point_m = *point_m});
        }
      }
    }
  }
  return conflicts;
}

class ConflictBasedSearch {
 public:
  ConflictBasedSearch(const JointProblem& problem, const JointSearchOptions& options,
                      JointPlan incumbent)
      : problem_(problem), max_expansions_(options.max_expansions) {
    HLC_DEMAND(!problem.empty());
    if (!incumbent.empty()) take(std::move(incumbent));
  }

  JointSearchResult run() {
    if (std::optional<Node> root = make_root()) open_.push(*std::move(root));
    while (!open_.empty() && is_worth_it(open_.top().bound_m2) && expanded_ < max_expansions_) {
      const Node node = open_.top();
      open_.pop();
      ++result_.nodes;
      take(node);
    }
    return finish();
  }

 private:
  [[nodiscard]] bool is_worth_it(double bound_m2) const {
    return best_m2_ == kInfinity || bound_m2 < best_m2_ - kLeastGain * best_m2_;
  }

  void take(JointPlan plans) {
    const double cost_m2 = cost_of(plans);
    if (cost_m2 >= best_m2_) return;
    best_m2_ = cost_m2;
    result_.plans = std::move(plans);
  }

  void take(const Node& node) {
    const std::vector<Conflict> conflicts = conflicts_of(node);
    if (conflicts.empty()) {
      take(results_of(node));
      // Only a search that used up its budget leaves a gap.
      if (is_worth_it(node.bound_m2)) leave_out(node.bound_m2);
      return;
    }
    complete(node);
    for (Node& child : children_of(node, conflicts)) {
      child.number = ++num_made_;
      open_.push(std::move(child));
    }
  }

  /// What lies under a node is not looked at.
  void leave_out(double bound_m2) { left_out_m2_ = std::min(left_out_m2_, bound_m2); }

  [[nodiscard]] static JointPlan results_of(const Node& node) {
    JointPlan plans;
    for (const auto& one : node.plans) plans.push_back(one->result);
    return plans;
  }

  /// Two children at most, for the conflict of which the cheaper one costs most.
  [[nodiscard]] std::vector<Node> children_of(const Node& node,
                                              const std::vector<Conflict>& conflicts) {
    std::vector<Node> chosen;
    std::pair<double, double> most{-kInfinity, -kInfinity};
    double chosen_unknown_m2 = kInfinity;
    for (const Conflict& conflict : conflicts) {
      std::vector<Node> children;
      std::vector<double> bounds_m2;
      double unknown_m2 = kInfinity;
      for (const std::size_t vehicle : {conflict.a, conflict.b}) {
        Node child = child_of(node, vehicle, conflict);
        bounds_m2.push_back(child.bound_m2);
        if (!is_worth_it(child.bound_m2) || child.bound_m2 == kInfinity) continue;
        if (child.plans[vehicle]->is_found()) {
          children.push_back(std::move(child));
        } else {
          unknown_m2 = std::min(unknown_m2, child.bound_m2);
        }
      }
      const std::pair<double, double> costs = std::minmax(bounds_m2[0], bounds_m2[1]);
      if (costs <= most) continue;
      most = costs;
      chosen = std::move(children);
      chosen_unknown_m2 = unknown_m2;
      if (chosen.empty()) break;
    }
    leave_out(chosen_unknown_m2);
    return chosen;
  }

  [[nodiscard]] Node child_of(const Node& node, std::size_t vehicle, const Conflict& conflict) {
    Node child = node;
    child.constraints[vehicle] = std::make_shared<const Constraint>(Constraint{
        .step = conflict.step, .point_m = conflict.point_m, .before = node.constraints[vehicle]});
    child.plans[vehicle] = plan(vehicle, child.constraints[vehicle].get(), {});
    const auto& areas_m = child.plans[vehicle]->areas_m;  // otherwise the search would not end
    HLC_DEMAND(areas_m.empty() || !contains(areas_m[conflict.step], conflict.point_m));
    double sum_m2 = 0.0;
    for (const auto& one : child.plans) sum_m2 += one->bound_m2;
    // A search that uses up its budget may know less than the one before it.
    child.bound_m2 = std::max(sum_m2, node.bound_m2);
    return child;
  }

  [[nodiscard]] std::optional<Node> make_root() {
    Node root;
    root.constraints.resize(problem_.size());
    for (std::size_t i = 0; i < problem_.size(); ++i) {
      root.plans.push_back(plan(i, nullptr, {}));
      root.bound_m2 += root.plans.back()->bound_m2;
      if (root.plans.back()->is_found()) continue;
      leave_out(root.plans.back()->bound_m2);
      return std::nullopt;
    }
    return root;
  }

  /// Plans in order around each other, under the node's constraints.
  void complete(const Node& node) {
    std::vector<std::shared_ptr<const VehiclePlan>> before;
    JointPlan plans;
    double cost_m2 = 0.0;
    for (std::size_t i = 0; i < problem_.size(); ++i) {
      auto own = meets_any(*node.plans[i], before) ? plan(i, node.constraints[i].get(), before)
                                                   : node.plans[i];
      cost_m2 += own->result.cost;
      if (!own->is_found() || !is_worth_it(cost_m2)) return;
      plans.push_back(own->result);
      before.push_back(std::move(own));
    }
    take(std::move(plans));
  }

  [[nodiscard]] static bool meets_any(
      const VehiclePlan& plan, const std::vector<std::shared_ptr<const VehiclePlan>>& others) {
    return std::ranges::any_of(
        others, [&](const auto& other) { return meet(plan.areas_m, other->areas_m); });
  }

  [[nodiscard]] std::shared_ptr<const VehiclePlan> plan(
      std::size_t vehicle, const Constraint* constraint,
      const std::vector<std::shared_ptr<const VehiclePlan>>& others) {
    HorizonProblem problem = problem_[vehicle].problem;
    problem.obstacles_m.resize(problem.horizon_steps());
    for (; constraint != nullptr; constraint = constraint->before.get()) {
      problem.obstacles_m[constraint->step].push_back(forbidden_area(constraint->point_m));
    }
    for (const auto& other : others) add_obstacles(other->areas_m, problem);
    auto found = std::make_shared<VehiclePlan>();
    found->result = problem_[vehicle].engine->search(problem);
    found->areas_m = areas_of(found->result, problem);
    const bool is_none = !found->is_found() && found->result.reason == NoPath::kInfeasible;
    found->bound_m2 = found->result.lower_bound;
    if (is_none) found->bound_m2 = kInfinity;
    expanded_ += found->result.expanded;
    return found;
  }

  [[nodiscard]] JointSearchResult finish() {
    double bound_m2 = std::min(left_out_m2_, best_m2_);
    if (!open_.empty()) bound_m2 = std::min(bound_m2, open_.top().bound_m2);
    const bool is_proven = !is_worth_it(bound_m2) || bound_m2 == kInfinity;
    result_.expanded = expanded_;
    result_.lower_bound = bound_m2 == kInfinity ? 0.0 : bound_m2;
    if (result_.plans.empty()) {
      result_.reason = is_proven ? NoPath::kInfeasible : NoPath::kBudget;
      return std::move(result_);
    }
    result_.cost = best_m2_;
    result_.reason = NoPath::kNone;
    result_.status = is_proven ? SearchStatus::kOptimal : SearchStatus::kBudget;
    return std::move(result_);
  }

  const JointProblem& problem_;
  std::size_t max_expansions_;
  JointSearchResult result_;
  double best_m2_{kInfinity};      ///< cost of result_.plans
  double left_out_m2_{kInfinity};  ///< least bound of what is not looked at
  std::size_t expanded_{};
  std::size_t num_made_{};
  std::priority_queue<Node, std::vector<Node>, IsTakenLater> open_;
};

}  // namespace

JointSearchResult search_jointly(const JointProblem& problem, const JointSearchOptions& options,
                                 JointPlan incumbent) {
  return ConflictBasedSearch(problem, options, std::move(incumbent)).run();
}

}  // namespace hlc::joint_search
