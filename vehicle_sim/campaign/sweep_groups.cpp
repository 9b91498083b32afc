#include "vehicle_sim/campaign/sweep_groups.hpp"

#include <fmt/format.h>

#include <map>

namespace hlc::campaign {

std::vector<Axes> groupings_of(const SweepPlan& plan) {
  std::vector<Axes> groupings{{}};
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
    const std::size_t values = plan.axes[axis].values.size();
    if (values > 1 && values <= kMaxTableValues) groupings.push_back({axis});
  }
  groupings.insert(groupings.end(), plan.tables.begin(), plan.tables.end());
  return groupings;
}

std::vector<SweepGroup> groups_of(const Sweep& sweep, const Axes& axes) {
  std::map<std::vector<std::size_t>, SweepGroup> groups;
  for (std::size_t c = 0; c < sweep.combinations().size(); ++c) {
    std::vector<std::size_t> key;
    std::vector<std::string> values;
    for (const std::size_t axis : axes) {
      key.push_back(sweep.combinations()[c][axis]);
      values.push_back(sweep.plan().axes[axis].values[key.back()].text);
    }
    SweepGroup& group = groups[key];
    group.axes = axes;
    group.values = values;
    group.combinations.push_back(c);
  }
  std::vector<SweepGroup> list;
  for (auto& [key, group] : groups) list.push_back(std::move(group));
  return list;
}

std::string settings_text(const SweepPlan& plan, const Axes& axes, const char* separator) {
  std::vector<std::string> names;
  for (const std::size_t axis : axes) names.push_back(plan.axes[axis].setting);
  return names.empty() ? "all" : fmt::format("{}", fmt::join(names, separator));
}

std::string values_text(const SweepGroup& group, const char* separator) {
  return fmt::format("{}", fmt::join(group.values, separator));
}

std::vector<std::vector<std::size_t>> runs_by_combination(const Sweep& sweep) {
  std::vector<std::vector<std::size_t>> numbers(sweep.combinations().size());
  for (std::size_t i = 0; i < sweep.runs().size(); ++i) {
    numbers[sweep.runs()[i].combination].push_back(i);
  }
  return numbers;
}

}  // namespace hlc::campaign
