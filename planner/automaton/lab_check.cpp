#include "planner/automaton/lab_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "planner/automaton/trim_format.hpp"

namespace hlc::automaton {
namespace {

std::vector<TimedPoint> points_of(const Maneuver& maneuver, double interval_s,
                                  const vehicle::VehicleParameters& vehicle) {
  const auto count = static_cast<int>(std::lround(maneuver.duration_s / interval_s));
  std::vector<TimedPoint> points;
  for (int i = 0; i <= count; ++i) {
    const double time_s = static_cast<double>(i) * interval_s;
    points.push_back(vehicle::timed_point(time_s, state_at(maneuver, time_s, vehicle), vehicle));
  }
  return points;
}

/// Empty if the lab accepts the maneuver.
std::string lab_fault(const Maneuver& m, const vehicle::LabLimits& limits,
                      const vehicle::VehicleParameters& vehicle) {
  const auto found = vehicle::curve_fault(points_of(m, limits.point_interval_s, vehicle), limits);
  if (!found) return "";
  const std::string who = m.is_self_loop()
                              ? fmt::format("trim {}", m.from)
                              : fmt::format("maneuver {} ({})", TrimPair{m.from, m.to}, m.label);
  return who + ": " + vehicle::to_text(*found, limits);
}

}  // namespace

std::string validate_for_lab(const Subgraph& subgraph, const vehicle::LabLimits& limits) {
  // Trims first: a fault of a trim explains those of its maneuvers.
  for (const bool self_loops : {true, false}) {
    for (const TrimId trim : subgraph.start_trims()) {
      for (const Edge& edge : subgraph.successors(trim)) {
        if (edge.maneuver->is_self_loop() != self_loops) continue;
        std::string fault = lab_fault(*edge.maneuver, limits, subgraph.automaton().vehicle);
        if (!fault.empty()) return fault;
      }
    }
  }
  return "";
}

}  // namespace hlc::automaton
