#include "planner/coordination/joint_gap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "planner/geometry/median.hpp"

namespace hlc::coordination {
namespace {

using Reports = std::map<VehicleId, const Report*>;

/// All that are connected with the vehicle over couplings that either of two reports names; takes
/// them out of `left`. Vehicles without a report included.
std::set<VehicleId> take_component(VehicleId first, const Reports& reports,
                                   std::set<VehicleId>& left) {
  std::set<VehicleId> component{first};
  std::vector<VehicleId> open{first};
  while (!open.empty()) {
    const VehicleId one = open.back();
    open.pop_back();
    const auto add = [&](VehicleId other) {
      if (component.insert(other).second) open.push_back(other);
    };
    for (const auto& [other, report] : reports) {
      const auto& coupled = report->coupled;
      if (other == one) std::ranges::for_each(coupled, add);
      if (std::ranges::find(coupled, one) != coupled.end()) add(other);
    }
  }
  for (const VehicleId one : component) left.erase(one);
  return component;
}

constexpr double kAnyExcess = 100.0;

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

}  // namespace

std::string excess_text(double excess) {
  return excess < kAnyExcess ? percent(excess) : "any amount";
}

double JointGap::excess() const {
  if (is_closed()) return 0.0;
  if (bound_m2 <= 0.0) return std::numeric_limits<double>::infinity();
  return cost_m2 / bound_m2 - 1.0;
}

std::string text_of(const JointGap& gap) {
  std::string optimum = fmt::format("the joint optimum of {} vehicles", gap.vehicles.size());
  if (!gap.is_known) return "at an unknown distance from " + optimum;
  if (gap.is_closed()) return optimum;
  return fmt::format("at most {} above {}", excess_text(gap.excess()), optimum);
}

std::optional<JointGapFigures> joint_gap_figures(std::span<const JointGap> gaps) {
  JointGapFigures figures;
  std::vector<double> excesses;
  JointGap all;
  for (const JointGap& gap : gaps) {
    if (!gap.is_known) {
      ++figures.unknown;
      continue;
    }
    excesses.push_back(gap.excess());
    all.cost_m2 += gap.cost_m2;
    all.bound_m2 += gap.bound_m2;
    if (gap.is_closed()) ++figures.closed;
  }
  figures.known = excesses.size();
  if (excesses.empty()) return std::nullopt;
  const auto rank = static_cast<std::size_t>(
      std::ceil(0.99 * static_cast<double>(excesses.size())));  // the nearest one
  std::ranges::sort(excesses);
  figures.p99 = excesses[rank - 1];
  figures.total = all.excess();
  figures.median = median(std::move(excesses));
  return figures;
}

std::string text_of(const JointGapFigures& figures) {
  return fmt::format(
      "the joint optimum in {} of {} cases, at most {} above it in 99 %, {} in all together",
      percent(static_cast<double>(figures.closed) / static_cast<double>(figures.known)),
      figures.known, excess_text(figures.p99), excess_text(figures.total));
}

std::vector<JointGap> joint_gaps(std::span<const Report* const> reports) {
  Reports by_vehicle;
  std::set<VehicleId> left;
  for (const Report* report : reports) {
    by_vehicle[report->vehicle] = report;
    left.insert(report->vehicle);
  }
  std::vector<JointGap> gaps;
  while (!left.empty()) {
    const std::set<VehicleId> component = take_component(*left.begin(), by_vehicle, left);
    if (component.size() < 2) continue;
    JointGap& gap = gaps.emplace_back();
    gap.vehicles.assign(component.begin(), component.end());
    gap.is_known = std::ranges::all_of(component, [&](VehicleId vehicle) {
      const auto found = by_vehicle.find(vehicle);
      if (found == by_vehicle.end() || !found->second->bound_m2) return false;
      // The bound of a vehicle that misses another one supposes that this one may be anywhere.
      return std::ranges::none_of(found->second->missing,
                                  [&](VehicleId other) { return component.contains(other); });
    });
    if (!gap.is_known) continue;
    for (const VehicleId vehicle : component) {
      gap.cost_m2 += by_vehicle[vehicle]->cost_m2;
      gap.bound_m2 += *by_vehicle[vehicle]->bound_m2;
    }
  }
  return gaps;
}

}  // namespace hlc::coordination
