#include "planner/automaton/lateral_step.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace hlc::automaton {

double lateral_step_m(const Subgraph& subgraph) {
  const UniversalAutomaton& automaton = subgraph.automaton();
  std::map<double, double> least_mps;  // by curvature
  for (const TrimId id : subgraph.trims()) {
    const Trim& trim = automaton.trims[id.index];
    if (trim.is_equilibrium()) continue;
    const double curvature = vehicle::curvature_per_m(trim.steering_rad, automaton.vehicle);
    const auto [known, is_new] = least_mps.try_emplace(curvature, trim.speed_mps);
    if (!is_new) known->second = std::min(known->second, trim.speed_mps);
  }
  double most_m = 0.0;
  if (least_mps.empty()) return most_m;
  for (auto one = least_mps.begin(), next = std::next(one); next != least_mps.end();
       one = next, ++next) {
    const double way_m = std::min(one->second, next->second) * automaton.step_s;
    most_m = std::max(most_m, std::abs(next->first - one->first) / 4.0 * way_m * way_m);
  }
  return most_m;
}

}  // namespace hlc::automaton
