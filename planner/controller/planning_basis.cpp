#include "planner/controller/planning_basis.hpp"

#include <algorithm>
#include <array>

#include "planner/common/word_hash.hpp"
#include "planner/controller/coordination_rules.hpp"

namespace hlc::controller {
namespace {

void add(WordHash& hash, const Point& point) {
  hash.add(point.x());
  hash.add(point.y());
}

void add(WordHash& hash, const Pose& pose) {
  add(hash, pose.position_m());
  hash.add(pose.heading_rad);
}

void add(WordHash& hash, const ConvexPolygon& polygon) {
  hash.add(std::uint64_t{polygon.vertices_m.size()});
  for (const Point& vertex : polygon.vertices_m) add(hash, vertex);
}

void add(WordHash& hash, const automaton::Maneuver& maneuver) {
  hash.add(std::uint64_t{maneuver.from.index});
  hash.add(std::uint64_t{maneuver.to.index});
  hash.add(maneuver.label);
  hash.add(maneuver.duration_s);
  for (const vehicle::Input& input : maneuver.inputs) {
    hash.add(input.acceleration_mps2);
    hash.add(input.steering_rate_radps);
  }
  for (const vehicle::State& state : maneuver.states) {
    add(hash, state.pose);
    hash.add(state.speed_mps);
    hash.add(state.steering_rad);
  }
  add(hash, maneuver.displacement);
  add(hash, maneuver.swept_area_m);
  add(hash, maneuver.lane_area_m);
  for (const CriterionValue& criterion : maneuver.criteria) {
    hash.add(criterion.name);
    hash.add(criterion.value);
  }
}

void add(WordHash& hash, const vehicle::VehicleParameters& vehicle) {
  hash.add(vehicle.wheelbase_m);
  hash.add(vehicle.rear_axle_to_cg_m);
  hash.add(vehicle.footprint.length_m);
  hash.add(vehicle.footprint.width_m);
  hash.add(vehicle.safety_margin_m);
}

void add(WordHash& hash, const vehicle::IdentifiedVehicle& identified) {
  for (const double value :
       {identified.path_speed_gain, identified.path_speed_steering, identified.slip_gain_rad,
        identified.yaw_rate_gain_per_m, identified.drag_per_s, identified.thrust_offset_mps2,
        identified.thrust_per_volt, identified.throttle_exponent, identified.steering_offset,
        identified.slip_offset_rad}) {
    hash.add(value);
  }
  if (identified.steering_rate_per_s) hash.add(*identified.steering_rate_per_s);
}

void add(WordHash& hash, const road::DrivableRoute& route) {
  hash.add(std::uint64_t{route.number});
  hash.add(std::uint64_t{route.path.is_closed()});
  for (const Point& point : route.path.points_m()) add(hash, point);
  for (const double s_m : route.path.joints_s_m()) hash.add(route.driving_line.left_m(s_m));
  for (const road::Corridor::Piece& piece : route.corridor.pieces()) {
    add(hash, piece.segment.from_m);
    add(hash, piece.segment.to_m);
    hash.add(piece.from_s_m);
    hash.add(piece.to_s_m);
  }
  add(hash, route.corridor.ground_m().min_m);
  add(hash, route.corridor.ground_m().max_m);
  for (const road::SpeedSection& section : route.speed_sections) {
    for (const double value : {section.from_s_m, section.to_s_m, section.speed_mps}) {
      hash.add(value);
    }
  }
}

void add(WordHash& hash, const std::optional<vehicle::LabLimits>& lab) {
  hash.add(std::uint64_t{lab.has_value()});
  if (!lab) return;
  for (const double value :
       {lab->curvature_min_per_m, lab->curvature_max_per_m, lab->acceleration_max_mps2,
        lab->velocity_mismatch_max_mps, lab->x_min_m, lab->x_max_m, lab->y_min_m, lab->y_max_m,
        lab->point_interval_s, lab->pose_lead_s, lab->tracking_error_max_m}) {
    hash.add(value);
  }
}

/// Place of a rule among the known ones of its kind: addresses differ from process to process.
template <class Rule, std::size_t n>
std::uint64_t number_of(const Rule& rule, const std::array<Rule, n>& known) {
  return static_cast<std::uint64_t>(std::ranges::find(known, rule) - known.begin());
}

void add(WordHash& hash, const ControllerStrategies& strategies) {
  const auto& [strategy, first, max_levels, beyond] = strategies.priorities;
  hash.add(strategy->name);
  hash.add(std::uint64_t{first.size()});
  for (const VehicleId vehicle : first) hash.add(std::uint64_t{vehicle.value});
  hash.add(std::uint64_t{max_levels});
  hash.add(beyond->name);
  hash.add(strategies.coupling->name);
  hash.add(strategies.grant_order->name);
  hash.add(name_of(strategies.coordination));
  hash.add(number_of(strategies.incumbent,
                     std::array<IncumbentRule, 2>{&rest_of_plan_in_force, &no_incumbent}));
  hash.add(number_of(strategies.standstill_timeout,
                     std::array<StandstillTimeoutRule, 2>{&once_per_horizon, &no_timeout}));
}

void add(WordHash& hash, const search::SearchOptions& search) {
  hash.add(static_cast<std::uint64_t>(search.engine));
  hash.add(static_cast<std::uint64_t>(search.cost_to_go));
  hash.add(std::uint64_t{search.max_expansions});
  for (const search::PlanningWeight& weight : search.criterion_weights) {
    hash.add(weight.criterion);
    hash.add(weight.weight_m2);
  }
  hash.add(std::uint64_t{search.factory != nullptr});
}

}  // namespace

std::uint64_t digest_of(const automaton::Subgraph& subgraph) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  WordHash hash;
  add(hash, automaton.vehicle);
  add(hash, automaton.identified);
  hash.add(automaton.step_s);
  for (const automaton::Trim& trim : automaton.trims) {
    hash.add(trim.speed_mps);
    hash.add(trim.steering_rad);
  }
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) add(hash, maneuver);
  for (const TrimId trim : subgraph.start_trims()) {
    hash.add(std::uint64_t{trim.index});
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      hash.add(static_cast<std::uint64_t>(edge.maneuver - automaton.maneuvers.data()));
    }
  }
  return hash.value();
}

std::uint64_t digest_of(std::span<const road::DrivableRoute> routes) {
  WordHash hash;
  for (const road::DrivableRoute& route : routes) add(hash, route);
  return hash.value();
}

std::uint64_t digest_of(std::span<const ConvexPolygon> areas_m) {
  WordHash hash;
  for (const ConvexPolygon& area_m : areas_m) add(hash, area_m);
  return hash.value();
}

std::uint64_t digest_of(const ControllerOptions& options) {
  WordHash hash;
  hash.add(std::uint64_t{options.horizon_steps});
  hash.add(options.reference_speed_mps);
  hash.add(options.contouring_weight);
  hash.add(options.held_up_contouring_weight.value_or(options.contouring_weight));
  hash.add(road::name_of(options.reference_rule));
  add(hash, options.strategies);
  add(hash, options.search);
  hash.add(options.deviation.reanchor_share);
  hash.add(options.deviation.tracking_error_max_m);
  hash.add(options.deviation.tolerated_drift_share);
  hash.add(std::uint64_t{options.conflicts != nullptr});
  if (options.conflicts) {
    hash.add(options.conflicts->stopping_room_m());
    for (std::size_t route = 0; route < options.conflicts->num_routes(); ++route) {
      hash.add(options.conflicts->length_m(route));
      hash.add(std::uint64_t{options.conflicts->num_cells(route)});
    }
  }
  add(hash, options.lab);
  return hash.value();
}

}  // namespace hlc::controller
