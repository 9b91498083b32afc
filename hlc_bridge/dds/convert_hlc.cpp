#include "hlc_bridge/dds/convert_hlc.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/dds/convert_areas.hpp"
#include "hlc_bridge/dds/convert_certificate.hpp"
#include "hlc_bridge/dds/convert_planning.hpp"

// The structured bindings name every field of a plain message, so that a new field does not compile
// until it is converted.
namespace hlc::dds {
namespace {

std::vector<std::uint8_t> ids_to_wire(const std::vector<VehicleId>& ids) {
  std::vector<std::uint8_t> result;
  for (const VehicleId id : ids) {
    result.push_back(id.value);
  }
  return result;
}

bool is_valid(const std::vector<std::uint8_t>& ids) {
  return ids.size() <= kMaxEntries &&
         std::ranges::all_of(ids, [](std::uint8_t id) { return dds::is_valid(VehicleId{id}); });
}

std::vector<VehicleId> ids_from_wire(const std::vector<std::uint8_t>& wire) {
  std::vector<VehicleId> result;
  for (const std::uint8_t id : wire) {
    result.push_back({id});
  }
  return result;
}

LaneClaimMessage claim_to_wire(const coordination::LaneClaim& claim) {
  const auto& [route, place_m, ahead_m, waiting_steps] = claim;
  LaneClaimMessage result;
  result.route(route);
  result.place_m(place_m);
  result.ahead_m(ahead_m);
  result.waiting_steps(waiting_steps);
  return result;
}

bool is_valid(const LaneClaimMessage& wire) {
  return is_near(wire.place_m()) && is_near(wire.ahead_m());
}

coordination::LaneClaim claim_from_wire(const LaneClaimMessage& wire) {
  return {.route = wire.route(),
          .place_m = wire.place_m(),
          .ahead_m = wire.ahead_m(),
          .waiting_steps = wire.waiting_steps()};
}

// Without a default case: a new enumerator does not compile until it is known here.
bool is_known(coordination::StepStatus status) {
  switch (status) {
    case coordination::StepStatus::kStandby:
    case coordination::StepStatus::kPlanned:
    case coordination::StepStatus::kFallback:
    case coordination::StepStatus::kMinimalRiskStop:
      return true;
  }
  return false;
}

bool is_known(coordination::FallbackReason reason) {
  switch (reason) {
    case coordination::FallbackReason::kNone:
    case coordination::FallbackReason::kInfeasible:
    case coordination::FallbackReason::kBudget:
    case coordination::FallbackReason::kMissing:
    case coordination::FallbackReason::kConflict:
    case coordination::FallbackReason::kNeighbour:
    case coordination::FallbackReason::kDeviation:
    case coordination::FallbackReason::kLate:
    case coordination::FallbackReason::kUndrivable:
    case coordination::FallbackReason::kOffRoute:
      return true;
  }
  return false;
}

bool is_known(coordination::PlanQuality quality) {
  switch (quality) {
    case coordination::PlanQuality::kNone:
    case coordination::PlanQuality::kOptimal:
    case coordination::PlanQuality::kBudget:
    case coordination::PlanQuality::kUnproven:
      return true;
  }
  return false;
}

bool is_known(RunPhase phase) {
  switch (phase) {
    case RunPhase::kRunning:
    case RunPhase::kMinimalRiskStop:
      return true;
  }
  return false;
}

bool has_valid_plan(const ReportMessage& wire) {
  return wire.plan_trims().size() <= kMaxEntries &&
         wire.plan_trims().size() == wire.plan_labels().size() &&
         std::ranges::all_of(wire.plan_labels(),
                             [](const std::string& label) { return label.size() <= kMaxText; });
}

std::vector<coordination::PlannedManeuver> plan_from_wire(const ReportMessage& wire) {
  std::vector<coordination::PlannedManeuver> plan;
  for (std::size_t i = 0; i < wire.plan_trims().size(); ++i) {
    plan.push_back({.to = {wire.plan_trims()[i]}, .label = wire.plan_labels()[i]});
  }
  return plan;
}

bool is_valid(const ReportMessage& wire) {
  return dds::is_valid(VehicleId{wire.vehicle_id()}) &&
         is_known(static_cast<coordination::StepStatus>(wire.status())) &&
         is_known(static_cast<coordination::FallbackReason>(wire.reason())) &&
         is_known(static_cast<coordination::PlanQuality>(wire.quality())) &&
         is_finite(pose_from_wire(wire.planned_pose())) && wire.maneuver().size() <= kMaxText &&
         wire.subgraph().size() <= kMaxText &&
         all_finite(wire.cost_m2(), wire.gap_m2(), wire.bound_m2(), wire.deviation_m()) &&
         is_valid(wire.coupled()) && is_valid(wire.missing()) && is_valid(wire.waits_for()) &&
         is_valid(wire.blocked_by()) && wire.waits_since() <= wire.step() &&
         (!wire.has_arrived() || wire.arrived_since() <= wire.step()) && has_valid_plan(wire) &&
         is_near(wire.held_place_m()) && is_near(wire.held_ahead_m()) &&
         (!wire.has_certificate() || dds::is_valid(wire.certificate()));
}

}  // namespace

bool can_be_written(const coordination::Traffic& message) { return is_valid(message.vehicle); }
bool can_be_written(const coordination::Prediction& message) { return is_valid(message.vehicle); }
bool can_be_written(const coordination::Outcome& message) { return is_valid(message.vehicle); }
bool can_be_written(const ReportRecord& message) { return is_valid(message.report.vehicle); }

void to_wire(const coordination::Traffic& message, TrafficMessage& wire) {
  const auto& [vehicle, step, next_pose, next_trim, running, reachable_area_m, silent,
               standing_steps, reference_areas_m, claim, planning] = message;
  wire.vehicle_id(vehicle.value);
  wire.step(step.value);
  wire.next_pose(pose_to_wire(next_pose));
  wire.next_trim(static_cast<std::uint32_t>(next_trim.index));
  wire.running(areas_to_wire(running));
  wire.reachable_area_m(polygon_to_wire(reachable_area_m));
  wire.silent(ids_to_wire(silent));
  wire.standing_steps(standing_steps);
  wire.reference_areas_m(polygons_to_wire(reference_areas_m));
  wire.claims_lane(claim.has_value());
  wire.claim(claim_to_wire(claim.value_or(coordination::LaneClaim{})));
  wire.has_planning(planning.has_value());
  wire.planning(planning_to_wire(planning.value_or(coordination::PlanningInput{})));
}

Incoming<coordination::Traffic> from_wire(const TrafficMessage& wire) {
  const bool valid =
      is_valid(VehicleId{wire.vehicle_id()}) && is_finite(pose_from_wire(wire.next_pose())) &&
      is_valid(wire.running()) && is_valid(wire.reachable_area_m()) && is_valid(wire.silent()) &&
      are_valid(wire.reference_areas_m()) && (!wire.claims_lane() || is_valid(wire.claim())) &&
      (!wire.has_planning() || is_valid(wire.planning()));
  if (!valid) {
    return {std::nullopt, 1};
  }
  return {
      coordination::Traffic{
          .vehicle = {wire.vehicle_id()},
          .step = {wire.step()},
          .next_pose = pose_from_wire(wire.next_pose()),
          .next_trim = {wire.next_trim()},
          .running = areas_from_wire(wire.running()),
          .reachable_area_m = polygon_from_wire(wire.reachable_area_m()),
          .silent = ids_from_wire(wire.silent()),
          .standing_steps = wire.standing_steps(),
          .reference_areas_m = polygons_from_wire(wire.reference_areas_m()),
          .claim = wire.claims_lane() ? std::optional{claim_from_wire(wire.claim())} : std::nullopt,
          .planning = wire.has_planning() ? std::optional{planning_from_wire(wire.planning())}
                                          : std::nullopt},
      0};
}

void to_wire(const coordination::Prediction& message, PredictionMessage& wire) {
  const auto& [vehicle, step, is_new, areas, desired] = message;
  wire.vehicle_id(vehicle.value);
  wire.step(step.value);
  wire.is_new(is_new);
  wire.areas(areas_to_wire(areas));
  wire.desires_more(desired.has_value());
  wire.desired(areas_to_wire(desired.value_or(coordination::OccupiedAreas{})));
}

Incoming<coordination::Prediction> from_wire(const PredictionMessage& wire) {
  if (!is_valid(VehicleId{wire.vehicle_id()}) || !is_valid(wire.areas()) ||
      !is_valid(wire.desired())) {
    return {std::nullopt, 1};
  }
  return {coordination::Prediction{.vehicle = {wire.vehicle_id()},
                                   .step = {wire.step()},
                                   .is_new = wire.is_new(),
                                   .areas = areas_from_wire(wire.areas()),
                                   .desired = wire.desires_more()
                                                  ? std::optional{areas_from_wire(wire.desired())}
                                                  : std::nullopt},
          0};
}

void to_wire(const coordination::Outcome& message, OutcomeMessage& wire) {
  const auto& [vehicle, step, wants_fallback, digests] = message;
  const auto& [inputs, plan, is_prediction_published] =
      digests.value_or(coordination::PlanDigests{});
  wire.vehicle_id(vehicle.value);
  wire.step(step.value);
  wire.wants_fallback(wants_fallback);
  wire.has_digests(digests.has_value());
  wire.inputs_digest(inputs);
  wire.plan_digest(plan);
  wire.prediction_is_published(is_prediction_published);
}

Incoming<coordination::Outcome> from_wire(const OutcomeMessage& wire) {
  return valid_if(
      is_valid(VehicleId{wire.vehicle_id()}),
      coordination::Outcome{.vehicle = {wire.vehicle_id()},
                            .step = {wire.step()},
                            .wants_fallback = wire.wants_fallback(),
                            .digests = wire.has_digests() ? std::optional{coordination::PlanDigests{
                                                                .inputs = wire.inputs_digest(),
                                                                .plan = wire.plan_digest(),
                                                                .is_prediction_published =
                                                                    wire.prediction_is_published()}}
                                                          : std::nullopt});
}

// A name that is too long is cut: without the report its sender would seem dead.
void to_wire(const ReportRecord& message, ReportMessage& wire) {
  const auto& [report, planning_ns, deadline_missed, late_ns, response_ns] = message;
  const auto& [vehicle, step, status, reason, planned_pose, planned_trim, maneuver, subgraph,
               cost_m2, quality, gap_m2, bound_m2, generated, expanded, level, coupled, missing,
               deviation_m, waiting, arrived_since, blocked_by, plan, held, certificate] = report;
  const auto& [waits_for, waits_since] = waiting;
  wire.vehicle_id(vehicle.value);
  wire.step(step.value);
  wire.status(static_cast<std::uint8_t>(status));
  wire.reason(static_cast<std::uint8_t>(reason));
  wire.planned_pose(pose_to_wire(planned_pose));
  wire.planned_trim(static_cast<std::uint32_t>(planned_trim.index));
  wire.maneuver(maneuver.substr(0, kMaxText));
  wire.subgraph(subgraph.substr(0, kMaxText));
  wire.cost_m2(cost_m2);
  wire.quality(static_cast<std::uint8_t>(quality));
  wire.gap_m2(gap_m2);
  wire.has_bound(bound_m2.has_value());
  wire.bound_m2(bound_m2.value_or(0.0));
  wire.generated(generated);
  wire.expanded(expanded);
  wire.level(level);
  wire.coupled(ids_to_wire(coupled));
  wire.missing(ids_to_wire(missing));
  wire.deviation_m(deviation_m);
  wire.planning_ns(planning_ns);
  wire.deadline_missed(deadline_missed);
  wire.late_ns(late_ns);
  wire.response_ns(response_ns);
  wire.waits_for(ids_to_wire(waits_for));
  wire.waits_since(waits_since.value);
  wire.blocked_by(ids_to_wire(blocked_by));
  wire.plan_trims().clear();
  wire.plan_labels().clear();
  for (const auto& [to, label] : plan) {
    wire.plan_trims().push_back(static_cast<std::uint32_t>(to.index));
    wire.plan_labels().push_back(label.substr(0, kMaxText));
  }
  wire.holds_road(held.has_value());
  const auto& [held_route, held_place_m, held_ahead_m] = held.value_or(coordination::HeldRoad{});
  wire.held_route(held_route);
  wire.held_place_m(held_place_m);
  wire.held_ahead_m(held_ahead_m);
  wire.has_certificate(certificate != nullptr);
  wire.certificate(
      certificate_to_wire(certificate != nullptr ? *certificate : coordination::Certificate{}));
  wire.has_arrived(arrived_since.has_value());
  wire.arrived_since(arrived_since.value_or(StepIndex{}).value);
}

Incoming<ReportRecord> from_wire(const ReportMessage& wire) {
  if (!is_valid(wire)) {
    return {std::nullopt, 1};
  }
  const coordination::Report report{
      .vehicle = {wire.vehicle_id()},
      .step = {wire.step()},
      .status = static_cast<coordination::StepStatus>(wire.status()),
      .reason = static_cast<coordination::FallbackReason>(wire.reason()),
      .planned_pose = pose_from_wire(wire.planned_pose()),
      .planned_trim = {wire.planned_trim()},
      .maneuver = wire.maneuver(),
      .subgraph = wire.subgraph(),
      .cost_m2 = wire.cost_m2(),
      .quality = static_cast<coordination::PlanQuality>(wire.quality()),
      .gap_m2 = wire.gap_m2(),
      .bound_m2 = wire.has_bound() ? std::optional(wire.bound_m2()) : std::nullopt,
      .generated = wire.generated(),
      .expanded = wire.expanded(),
      .level = wire.level(),
      .coupled = ids_from_wire(wire.coupled()),
      .missing = ids_from_wire(wire.missing()),
      .deviation_m = wire.deviation_m(),
      .waiting = {.vehicles = ids_from_wire(wire.waits_for()), .since = {wire.waits_since()}},
      .arrived_since =
          wire.has_arrived() ? std::optional(StepIndex{wire.arrived_since()}) : std::nullopt,
      .blocked_by = ids_from_wire(wire.blocked_by()),
      .plan = plan_from_wire(wire),
      .held = wire.holds_road()
                  ? std::optional{coordination::HeldRoad{.route = wire.held_route(),
                                                         .place_m = wire.held_place_m(),
                                                         .ahead_m = wire.held_ahead_m()}}
                  : std::nullopt,
      .certificate = wire.has_certificate() ? std::make_shared<const coordination::Certificate>(
                                                  certificate_from_wire(wire.certificate()))
                                            : nullptr};
  return {ReportRecord{.report = report,
                       .planning_ns = wire.planning_ns(),
                       .deadline_missed = wire.deadline_missed(),
                       .late_ns = wire.late_ns(),
                       .response_ns = wire.response_ns()},
          0};
}

void to_wire(const RunState& message, RunStateMessage& wire) {
  const auto& [phase, start] = message;
  wire.phase(static_cast<std::uint8_t>(phase));
  wire.start(start);
}

Incoming<RunState> from_wire(const RunStateMessage& wire) {
  const auto phase = static_cast<RunPhase>(wire.phase());
  return valid_if(is_known(phase), RunState{phase, wire.start()});
}

}  // namespace hlc::dds
