#include "planner/maneuver_design/dominance.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

namespace hlc::maneuver_design {

bool dominates(const Objectives& a, const Objectives& b, const Objectives& tolerance) {
  HLC_DEMAND(a.size() == b.size() && (tolerance.size() == 0 || tolerance.size() == a.size()),
             a.size(), b.size(), tolerance.size());
  bool is_better_somewhere = false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double slack = tolerance.size() == 0 ? 0.0 : tolerance(i);
    if (a(i) > b(i) + slack) {
      return false;
    }
    is_better_somewhere |= a(i) < b(i) - slack;
  }
  return is_better_somewhere;
}

std::vector<std::size_t> non_dominated(const std::vector<Objectives>& points,
                                       const Objectives& tolerance) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_dominated = std::any_of(points.begin(), points.end(), [&](const Objectives& p) {
      return dominates(p, points[i], tolerance);
    });
    if (!is_dominated) {
      result.push_back(i);
    }
  }
  return result;
}

double hypervolume(std::vector<Objectives> points, const Objectives& reference) {
  std::erase_if(points,
                [&](const Objectives& p) { return (p.array() >= reference.array()).any(); });
  if (points.empty()) {
    return 0.0;
  }
  const Eigen::Index last = reference.size() - 1;
  std::stable_sort(points.begin(), points.end(),
                   [last](const Objectives& a, const Objectives& b) { return a(last) < b(last); });
  if (last == 0) {
    return reference(0) - points.front()(0);
  }
  // Between two values of the last objective the cross-section is that of the points below.
  double volume = 0.0;
  std::vector<Objectives> below;
  for (std::size_t i = 0; i < points.size(); ++i) {
    below.emplace_back(points[i].head(last));
    const double top = i + 1 < points.size() ? points[i + 1](last) : reference(last);
    if (top > points[i](last)) {
      volume += (top - points[i](last)) * hypervolume(below, reference.head(last));
    }
  }
  return volume;
}

ObjectiveRange range_of(const std::vector<Objectives>& points) {
  HLC_DEMAND(!points.empty());
  ObjectiveRange range{points.front(), points.front()};
  for (const Objectives& point : points) {
    range.best = range.best.cwiseMin(point);
    range.worst = range.worst.cwiseMax(point);
  }
  return range;
}

std::size_t knee_point(const std::vector<Objectives>& points) {
  const ObjectiveRange range = range_of(points);
  const auto sum = [&](const Objectives& point) {
    double result = 0.0;
    for (Eigen::Index i = 0; i < point.size(); ++i) {
      const double width = range.worst(i) - range.best(i);
      result += width > 0.0 ? (point(i) - range.best(i)) / width : 0.0;
    }
    return result;
  };
  const auto knee =
      std::min_element(points.begin(), points.end(),
                       [&](const Objectives& a, const Objectives& b) { return sum(a) < sum(b); });
  return static_cast<std::size_t>(knee - points.begin());
}

}  // namespace hlc::maneuver_design
