#include "planner/controller/problem_alone.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "planner/geometry/footprint.hpp"

namespace hlc::controller {
namespace {

/// Boundary pieces this far beyond the reach of the plan are kept, so that none is missed: more
/// than half the footprint's length. Of the µCar, for others scale_of times as long.
constexpr double kBoundaryReserve_m = 0.4;
/// Half the length of the chord whose direction counts as the path's.
constexpr double kHalfChord_m = 0.02;

/// HorizonProblem::contouring at the points of the path with these arc lengths.
std::vector<Point> contouring(const road::ReferencePath& path, std::span<const double> s_m,
                              double weight) {
  std::vector<Point> contouring;
  contouring.reserve(s_m.size());
  for (const double s : s_m) {
    // The direction of a single segment would jump at the joints.
    const double heading_rad = road::chord_heading_rad(path, s, kHalfChord_m);
    contouring.push_back(std::sqrt(weight) * Point(-std::sin(heading_rad), std::cos(heading_rad)));
  }
  return contouring;
}

}  // namespace

road::Reference reference_alone(const coordination::Traffic& own, const RouteTracker& tracker,
                                double s_m, const automaton::Subgraph& subgraph,
                                const ControllerOptions& options, double end_s_m) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const double speed_mps =
      std::min(options.reference_speed_mps,
               subgraph.spec().max_speed_mps.value_or(options.reference_speed_mps));
  road::Reference reference = road::reference_points(
      tracker.route().path, s_m, automaton.trims[own.next_trim.index].speed_mps, speed_mps,
      options.horizon_steps, automaton.step_s, options.reference_rule,
      tracker.route().speed_sections);
  return road::reference_on(tracker.route().driving_line, tracker.route().path,
                            std::move(reference), end_s_m);
}

std::vector<ConvexPolygon> areas_on(const road::Reference& reference,
                                    const road::ReferencePath& path,
                                    const vehicle::VehicleParameters& vehicle) {
  std::vector<ConvexPolygon> areas_m;
  for (std::size_t j = 0; j < reference.points_m.size(); ++j) {
    const Point& point_m = reference.points_m[j];
    const double heading_rad = road::chord_heading_rad(path, reference.s_m[j], kHalfChord_m);
    areas_m.push_back(footprint_area(vehicle.footprint, {point_m.x(), point_m.y(), heading_rad},
                                     vehicle.safety_margin_m));
  }
  return areas_m;
}

search::HorizonProblem problem_alone(const coordination::Traffic& own, const RouteTracker& tracker,
                                     const road::Corridor& corridor, double reach_m,
                                     const automaton::Subgraph& subgraph,
                                     const ControllerOptions& options, const ReferenceEnd& end) {
  const double s_m = tracker.s_m().value();
  search::HorizonProblem problem{.start = own.next_pose, .start_trim = own.next_trim};
  road::Reference reference = reference_alone(own, tracker, s_m, subgraph, options, end.s_m);
  problem.reference_m = std::move(reference.points_m);
  problem.reference_speed_mps = std::move(reference.speeds_mps);
  const double weight = end.is_held_up
                            ? options.held_up_contouring_weight.value_or(options.contouring_weight)
                            : options.contouring_weight;
  if (weight > 0.0) problem.contouring = contouring(tracker.route().path, reference.s_m, weight);
  const double reserve_m = scale_of(subgraph.automaton().vehicle.footprint) * kBoundaryReserve_m;
  problem.boundary_m = corridor.boundary_m(s_m - reserve_m, s_m + reach_m + reserve_m);
  return problem;
}

search::HorizonProblem one_step_later(search::HorizonProblem problem,
                                      const coordination::Traffic& own) {
  problem.start = own.next_pose;
  problem.start_trim = own.next_trim;
  problem.incumbent.clear();
  auto& reference_m = problem.reference_m;
  if (reference_m.size() < 2) return problem;
  reference_m.push_back(2.0 * reference_m.back() - reference_m[reference_m.size() - 2]);
  reference_m.erase(reference_m.begin());
  if (!problem.contouring.empty()) {
    std::ranges::rotate(problem.contouring, problem.contouring.begin() + 1);
    problem.contouring.back() = problem.contouring[problem.contouring.size() - 2];
  }
  for (auto* const areas_m : {&problem.obstacles_m, &problem.avoided_in_motion_m}) {
    if (areas_m->empty()) continue;
    std::ranges::rotate(*areas_m, areas_m->begin() + 1);
    areas_m->back() = (*areas_m)[areas_m->size() - 2];
  }
  return problem;
}

}  // namespace hlc::controller
