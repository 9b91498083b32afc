#include "tests/support/exhaustive_joint_search.hpp"

#include <algorithm>

#include "tests/support/plan_check.hpp"

namespace hlc::test {
namespace {

struct Driven {
  Pose pose;
  TrimId trim;
};

/// Vehicle by vehicle, then step by step.
class JointEnumeration {
 public:
  JointEnumeration(const automaton::Subgraph& subgraph,
                   const std::vector<search::HorizonProblem>& problems)
      : subgraph_(subgraph), problems_(problems) {}

  std::optional<double> run() {
    std::vector<Driven> starts;
    for (const search::HorizonProblem& one : problems_)
      starts.push_back({one.start, one.start_trim});
    try_step(1, starts, 0.0);
    return least_;
  }

 private:
  void try_step(std::size_t step, const std::vector<Driven>& from, double cost) {
    if (step > problems_.front().horizon_steps()) {
      const bool all_stand = std::ranges::all_of(from, [&](const Driven& one) {
        return subgraph_.automaton().trims[one.trim.index].speed_mps == 0.0;
      });
      if (all_stand) least_ = std::min(least_.value_or(cost), cost);
      return;
    }
    std::vector<Driven> to;
    std::vector<ConvexPolygon> areas_m;
    try_vehicle(step, from, to, areas_m, cost);
  }

  void try_vehicle(std::size_t step, const std::vector<Driven>& from, std::vector<Driven>& to,
                   std::vector<ConvexPolygon>& areas_m, double cost) {
    const std::size_t vehicle = to.size();
    if (vehicle == from.size()) {
      try_step(step + 1, to, cost);
      return;
    }
    const auto& [pose, trim] = from[vehicle];
    const search::HorizonProblem& problem = problems_[vehicle];
    for (const automaton::Edge& edge : subgraph_.successors(trim)) {
      if (!is_free(*edge.maneuver, pose, step, problem)) continue;
      const ConvexPolygon area_m = transformed(edge.maneuver->swept_area_m, pose);
      const auto meets = [&](const ConvexPolygon& other_m) { return intersects(area_m, other_m); };
      if (std::ranges::any_of(areas_m, meets)) continue;
      const Pose next = compose(pose, edge.maneuver->displacement);
      to.push_back({next, edge.to});
      areas_m.push_back(area_m);
      try_vehicle(step, from, to, areas_m,
                  cost + position_cost_m2(problem, step, next.position_m()));
      to.pop_back();
      areas_m.pop_back();
    }
  }

  const automaton::Subgraph& subgraph_;
  const std::vector<search::HorizonProblem>& problems_;
  std::optional<double> least_;
};

}  // namespace

std::optional<double> exhaustive_joint_search(const automaton::Subgraph& subgraph,
                                              const std::vector<search::HorizonProblem>& problems) {
  return JointEnumeration(subgraph, problems).run();
}

}  // namespace hlc::test
