#include "planner/policy/rehearsal.hpp"

#include <algorithm>
#include <utility>

#include "planner/controller/followed_plan.hpp"

namespace hlc {
namespace {

/// Where a vehicle is looked for on its path, around where it may have got in a step.
constexpr double kProjection_m = 0.5;

/// What another vehicle drives from the last step on: its new plan if it told one.
struct ToldPlan {
  VehicleId vehicle;
  OccupiedAreas areas;
};

std::vector<ToldPlan> told_plans(const HeardInStep& heard, const Controller& controller) {
  const StepIndex step = controller.last_step();
  const bool strict = controller.options().settle_rule == SettleRule::kStrict;
  const std::vector<VehicleId>& awaited = strict ? controller.coupled() : controller.predecessors();
  std::vector<ToldPlan> plans;
  for (const Traffic& traffic : heard.traffic) {
    if (traffic.step != step || traffic.vehicle == controller.options().vehicle) continue;
    plans.push_back({traffic.vehicle, traffic.running});
  }
  for (const Prediction& prediction : heard.predictions) {
    const auto its = std::ranges::find(plans, prediction.vehicle, &ToldPlan::vehicle);
    const bool is_awaited = std::ranges::find(awaited, prediction.vehicle) != awaited.end();
    if (its == plans.end() || !is_awaited || prediction.step != step || !prediction.is_new)
      continue;
    its->areas = prediction.areas;
  }
  std::ranges::sort(plans, {}, &ToldPlan::vehicle);
  return plans;
}

/// What is left of it from t(step) on. @pre step >= areas.first
OccupiedAreas rest_of(const OccupiedAreas& areas, StepIndex step) {
  const std::size_t past = std::min(step.value - areas.first.value, areas.areas_m.size());
  OccupiedAreas rest{.first = step, .areas_m = {}, .final_area_m = areas.final_area_m};
  rest.areas_m.assign(areas.areas_m.begin() + static_cast<std::ptrdiff_t>(past),
                      areas.areas_m.end());
  if (rest.areas_m.empty()) rest.areas_m.push_back(areas.final_area_m);
  return rest;
}

Traffic traffic_of(const ToldPlan& plan, StepIndex step) {
  Traffic traffic{.vehicle = plan.vehicle,
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

/// One step of the controller among the others.
void step(Controller& controller, StepIndex now, const std::vector<ToldPlan>& others) {
  Observation observation{.step = now, .active = {}, .states = {}, .present = {}};
  observation.active.push_back(controller.options().vehicle);
  observation.states.push_back(on_its_plan(controller, now));
  std::vector<Traffic> traffic;
  std::vector<Prediction> predictions;
  std::vector<Outcome> outcomes;
  for (const ToldPlan& other : others) {
    observation.active.push_back(other.vehicle);
    traffic.push_back(traffic_of(other, now));
    predictions.push_back({.vehicle = other.vehicle,
                           .step = now,
                           .is_new = false,
                           .areas = rest_of(other.areas, {now.value + 1})});
    outcomes.push_back({.vehicle = other.vehicle, .step = now, .wants_fallback = false});
  }
  std::ranges::sort(observation.active);
  observation.present = observation.active;
  static_cast<void>(controller.observe(observation));
  controller.couple(traffic);
  static_cast<void>(controller.plan(predictions));
  static_cast<void>(controller.settle(predictions, outcomes));
}

double weighted(const Maneuver& maneuver, const std::vector<PlanningWeight>& weights) {
  double sum_m2 = 0.0;
  for (const PlanningWeight& weight : weights) {
    const auto value =
        std::ranges::find(maneuver.criteria, weight.criterion, &CriterionValue::name);
    if (value != maneuver.criteria.end()) sum_m2 += weight.weight_m2 * value->value;
  }
  return sum_m2;
}

}  // namespace

double rehearsed_cost_m2(const Controller& controller, const HeardInStep& heard,
                         const RehearsalSettings& settings, const BeforeStep& before_step) {
  if (!controller.has_plan() || !controller.path_s_m()) return 0.0;
  const std::vector<ToldPlan> others = told_plans(heard, controller);
  const ReferencePath& path = controller.route().path;
  const double ahead_m =
      controller.options().reference_speed_mps * controller.subgraph().automaton().step_s;
  const std::unique_ptr<Controller> rehearsing = controller.clone(settings.max_expansions);
  double s_m = *controller.path_s_m();
  double cost_m2 = 0.0;
  StepIndex now = controller.last_step();
  for (std::size_t i = 0; i < settings.steps; ++i) {
    ++now.value;
    before_step(*rehearsing);
    step(*rehearsing, now, others);
    const Plan& plan = rehearsing->plan_in_force();
    const StepIndex next{now.value + 1};
    const Point reached_m = plan.pose_at({next.value + 1}).position_m();
    s_m = path.project_within(plan.pose_at(next).position_m(), s_m - kProjection_m,
                              s_m + 2.0 * ahead_m + kProjection_m)
              .s_m;
    cost_m2 += (reached_m - path.at(s_m + ahead_m)).squaredNorm() +
               weighted(plan.maneuver_during(next), settings.criterion_weights);
  }
  return cost_m2;
}

}  // namespace hlc
