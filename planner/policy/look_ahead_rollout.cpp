#include "planner/policy/look_ahead_rollout.hpp"

#include <algorithm>
#include <cstdint>

#include "planner/controller/followed_plan.hpp"
#include "planner/controller/joint_step.hpp"

namespace hlc::policy {
namespace {

/// Range of the path searched for a vehicle, around its reach in a step.
constexpr double kProjection_m = 0.5;

/// The areas from t(step) on. @pre step >= areas.first
coordination::OccupiedAreas rest_of(const coordination::OccupiedAreas& areas, StepIndex step) {
  const std::size_t past = std::min(step.value - areas.first.value, areas.areas_m.size());
  coordination::OccupiedAreas rest{
      .first = step, .areas_m = {}, .final_area_m = areas.final_area_m};
  rest.areas_m.assign(areas.areas_m.begin() + static_cast<std::ptrdiff_t>(past),
                      areas.areas_m.end());
  if (rest.areas_m.empty()) rest.areas_m.push_back(areas.final_area_m);
  return rest;
}

coordination::Traffic traffic_of(const controller::Controller::AnnouncedPlan& plan,
                                 StepIndex step) {
  coordination::Traffic traffic{.vehicle = plan.vehicle,
                                .step = step,
                                .next_pose = {},
                                .next_trim = {},
                                .running = rest_of(plan.areas, step),
                                .reachable_area_m = {},
                                .silent = {}};
  std::vector<ConvexPolygon> areas = traffic.running.areas_m;
  areas.push_back(traffic.running.final_area_m);
  traffic.reachable_area_m = convex_hull(areas);
  return traffic;
}

/// Messages of the others in that step.
controller::ExternalMessages published_by(
    const std::vector<controller::Controller::AnnouncedPlan>& others, StepIndex step) {
  controller::ExternalMessages published;
  for (const controller::Controller::AnnouncedPlan& other : others) {
    published.traffic.push_back(traffic_of(other, step));
    published.predictions.push_back({.vehicle = other.vehicle,
                                     .step = step,
                                     .is_new = false,
                                     .areas = rest_of(other.areas, {step.value + 1})});
    published.outcomes.push_back({.vehicle = other.vehicle, .step = step, .wants_fallback = false});
  }
  return published;
}

coordination::Report step(controller::Controller& controller, StepIndex now,
                          const std::vector<controller::Controller::AnnouncedPlan>& others) {
  controller::Observation observation{.step = now,
                                      .active = {controller.options().vehicle},
                                      .states = {controller::on_its_plan(controller, now)},
                                      .present = {}};
  for (const controller::Controller::AnnouncedPlan& other : others)
    observation.active.push_back(other.vehicle);
  std::ranges::sort(observation.active);
  observation.present = observation.active;
  controller::Controller* const alone[]{&controller};
  return controller::joint_step(alone, observation, {.external = published_by(others, now)})
      .front();
}

double weighted(const automaton::Maneuver& maneuver,
                const std::vector<search::PlanningWeight>& weights) {
  double sum_m2 = 0.0;
  for (const search::PlanningWeight& weight : weights) {
    const auto value =
        std::ranges::find(maneuver.criteria, weight.criterion, &CriterionValue::name);
    if (value != maneuver.criteria.end()) sum_m2 += weight.weight_m2 * value->value;
  }
  return sum_m2;
}

}  // namespace

std::optional<double> rollout_cost_m2(const controller::Controller& controller,
                                      const LookAheadRolloutSettings& settings,
                                      const BeforeStep& before_step) {
  if (!controller.has_plan() || !controller.path_s_m()) return std::nullopt;
  const std::vector<controller::Controller::AnnouncedPlan> others = controller.announced_plans();
  const road::ReferencePath& path = controller.route().path;
  const double speed_mps = controller.options().reference_speed_mps;
  const double step_s = controller.subgraph().automaton().step_s;
  const double ahead_m = speed_mps * step_s;
  controller::Controller ahead = controller;
  ahead.set_max_expansions(settings.max_expansions);
  std::uint64_t expansions_left = settings.most_expansions;
  double s_m = *controller.path_s_m();
  double cost_m2 = 0.0;
  StepIndex now = controller.last_step();
  for (std::size_t i = 0; i < settings.steps; ++i) {
    ++now.value;
    before_step(ahead);
    const coordination::Report report = step(ahead, now, others);
    if (report.expanded > expansions_left) return std::nullopt;
    expansions_left -= report.expanded;
    const coordination::Plan& plan = ahead.plan_in_force();
    const StepIndex next{now.value + 1};
    const Point reached_m = plan.pose_at({next.value + 1}).position_m();
    s_m = path.project_within(plan.pose_at(next).position_m(), s_m - kProjection_m,
                              s_m + 2.0 * ahead_m + kProjection_m)
              .s_m;
    const double reference_mps = road::least_speed_mps(controller.route().speed_sections, path, s_m,
                                                       s_m + ahead_m, speed_mps);
    cost_m2 += (reached_m - path.at(s_m + reference_mps * step_s)).squaredNorm() +
               weighted(plan.maneuver_during(next), settings.criterion_weights);
  }
  return cost_m2;
}

}  // namespace hlc::policy
