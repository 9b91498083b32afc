#include "planner/scenario/reference_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "planner/automaton/requested_subgraph.hpp"

namespace hlc::scenario {
namespace {

constexpr char kSpeedKey[] = "reference_speed_mps";

/// @pre the route drives the lanelet
std::size_t index_of(road::LaneletId lanelet, const road::Route& route) {
  return static_cast<std::size_t>(std::ranges::find(route.lanelets, lanelet) -
                                  route.lanelets.begin());
}

double top_trim_speed_mps(const automaton::Subgraph& subgraph) {
  double top_mps = 0.0;
  for (const TrimId trim : subgraph.trims()) {
    top_mps = std::max(top_mps, subgraph.automaton().trims[trim.index].speed_mps);
  }
  return top_mps;
}

/// Trims that differ by less steer alike, and are equally fast.
constexpr double kTrimRounding = 1e-9;

/// Of the trims that are not slower the straightest, of these the slowest.
std::optional<double> straight_trim_speed_mps(const automaton::Subgraph& subgraph,
                                              double speed_mps) {
  std::optional<double> found;
  double straight_rad = 0.0;
  for (const TrimId id : subgraph.trims()) {
    const automaton::Trim& trim = subgraph.automaton().trims[id.index];
    if (trim.speed_mps < speed_mps - kTrimRounding) continue;
    const double steering_rad = std::abs(trim.steering_rad);
    if (found && steering_rad > straight_rad + kTrimRounding) continue;
    const bool is_straighter = !found || steering_rad < straight_rad - kTrimRounding;
    found = is_straighter ? trim.speed_mps : std::min(*found, trim.speed_mps);
    straight_rad = is_straighter ? steering_rad : straight_rad;
  }
  return found;
}

template <class Check>
void for_each_section(const ScenarioValues& values, const Check& check) {
  for (const RouteValues& route : values.routes) {
    if (!route.sections) continue;
    for (const auto& [benchmark_id, sections] : *route.sections) {
      std::ranges::for_each(sections, check);
    }
  }
}

}  // namespace

std::vector<road::SpeedSection> speed_sections_of(const RouteValues& values,
                                                  const road::Route& route,
                                                  const std::string& benchmark_id) {
  std::vector<road::SpeedSection> sections;
  if (!values.sections) return sections;
  const auto listed = values.sections->find(benchmark_id);
  if (listed == values.sections->end()) {
    values.node.fail("sections", "a list for the map with benchmarkID " + benchmark_id);
  }
  for (const SectionValues& one : listed->second) {
    const std::size_t first = index_of(one.from, route);
    const std::size_t last = index_of(one.to, route);
    const double laps_m = last < first ? route.path.length_m() : 0.0;
    sections.push_back({.from_s_m = route.lanelet_s_m[first],
                        .to_s_m = route.lanelet_s_m[last + 1] + laps_m,
                        .speed_mps = one.reference_speed_mps});
  }
  return sections;
}

std::shared_ptr<const automaton::Subgraph> subgraph_at(
    const std::shared_ptr<const automaton::Subgraph>& subgraph, double reference_speed_mps,
    std::size_t horizon_steps) {
  const std::optional<double> most_mps = straight_trim_speed_mps(*subgraph, reference_speed_mps);
  if (!most_mps || top_trim_speed_mps(*subgraph) <= *most_mps + kTrimRounding) return subgraph;
  return automaton::requested_subgraph(*subgraph, {.max_speed_mps = most_mps}, horizon_steps);
}

std::vector<std::shared_ptr<const automaton::Subgraph>> subgraphs_of(
    const ScenarioValues& values, const std::shared_ptr<const automaton::Subgraph>& subgraph) {
  std::vector<std::shared_ptr<const automaton::Subgraph>> all{subgraph};
  for (const VehicleValues& vehicle : values.vehicles) {
    if (!vehicle.reference_speed_mps) continue;
    auto own = subgraph_at(subgraph, *vehicle.reference_speed_mps, values.horizon_steps);
    if (own != subgraph) all.push_back(std::move(own));
  }
  return all;
}

void check_reference_speeds(const ScenarioValues& values,
                            const std::shared_ptr<const automaton::Subgraph>& subgraph) {
  const double top_mps = top_trim_speed_mps(*subgraph);
  const auto check_drivable = [&](const Node& node, double speed_mps) {
    if (speed_mps <= top_mps) return;
    node.fail(kSpeedKey, fmt::format("<= {}, the speed of the fastest trim of subgraph {}", top_mps,
                                     subgraph->spec().name));
  };
  bool have_all_their_own = !values.vehicles.empty();
  double fastest_mps = 0.0;
  for (const VehicleValues& vehicle : values.vehicles) {
    have_all_their_own = have_all_their_own && vehicle.reference_speed_mps;
    if (!vehicle.reference_speed_mps) continue;
    check_drivable(vehicle.node, *vehicle.reference_speed_mps);
    fastest_mps = std::max(fastest_mps, *vehicle.reference_speed_mps);
    try {
      static_cast<void>(subgraph_at(subgraph, *vehicle.reference_speed_mps, values.horizon_steps));
    } catch (const std::invalid_argument& error) {
      vehicle.node.fail(kSpeedKey, fmt::format("one at which the car can stop: {}", error.what()));
    }
  }
  if (!have_all_their_own) fastest_mps = std::max(fastest_mps, values.reference_speed_mps);
  for_each_section(values, [&](const SectionValues& section) {
    check_drivable(section.node, section.reference_speed_mps);
    if (section.reference_speed_mps <= fastest_mps) return;
    section.node.fail(kSpeedKey, fmt::format("<= {}, the highest reference speed of a vehicle: a "
                                             "section makes none faster",
                                             fastest_mps));
  });
}

}  // namespace hlc::scenario
