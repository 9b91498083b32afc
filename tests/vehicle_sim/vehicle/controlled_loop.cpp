#include "tests/vehicle_sim/vehicle/controlled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/automaton/deviation.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::simulated_vehicle::controlled_loop {
namespace {

/// How far the farthest of the points is outside the area, measured across its edges.
double outside_m(const ConvexPolygon& area, const ConvexPolygon::Vertices& points) {
  double result = 0.0;
  for (const Point& point : points) {
    for (std::size_t i = 0; i < area.vertices_m.size(); ++i) {
      const Point& from = area.vertices_m[i];
      const Point way = area.vertices_m[(i + 1) % area.vertices_m.size()] - from;
      const Point off = point - from;
      result = std::max(result, (way.y() * off.x() - way.x() * off.y()) / way.norm());
    }
  }
  return result;
}

/// What a controller announced at the beginning of a step.
struct Announced {
  coordination::Plan plan;  ///< that the step began with
  ConvexPolygon area_m;
};

std::size_t steps_at_limit(const std::map<std::uint64_t, Announced>& announced,
                           const automaton::UniversalAutomaton& automaton) {
  return static_cast<std::size_t>(std::ranges::count_if(announced, [&](const auto& one) {
    const auto& [step, what] = one;
    const auto is_at_limit = [&](TrimId trim) {
      return automaton::is_at_steering_limit(automaton.trims[trim.index], automaton.vehicle,
                                             automaton.identified);
    };
    return is_at_limit(what.plan.trim_at({step})) || is_at_limit(what.plan.trim_at({step + 1}));
  }));
}

void compare(const result::Drive& drive, Nanoseconds period,
             const std::map<std::uint64_t, Announced>& announced,
             const automaton::UniversalAutomaton& automaton, Stray& stray) {
  for (const result::DrivenSample& sample : drive) {
    const auto now = announced.find(sample.t / period);
    if (now == announced.end()) continue;
    const auto& [step, what] = *now;
    const double since_s = 1e-9 * static_cast<double>(sample.t - step * period);
    const vehicle::State planned = what.plan.state_at({step}, since_s, automaton.vehicle);
    stray.deviation_m = std::max(
        stray.deviation_m, automaton::footprint_deviation_m(sample.pose, planned, automaton.vehicle,
                                                            automaton.identified));
    const double outside =
        outside_m(what.area_m, footprint_area(automaton.vehicle.footprint, sample.pose).vertices_m);
    if (outside > stray.outside_m) {
      stray.outside_m = outside;
      stray.outside_tick = sample.t / kVehiclePeriod;
    }
  }
}

}  // namespace

Stray drive(const scenario::Scenario& scenario, std::optional<std::uint64_t> noise_seed,
            const std::function<bool()>& is_late) {
  Stray stray;
  std::map<std::uint64_t, Announced> announced;
  ConvexPolygon reachable_m;
  controller::JointStepRules rules;
  rules.on_traffic = [&](const controller::Controller& controller,
                         const coordination::Traffic& traffic) {
    announced.emplace(traffic.step.value,
                      Announced{controller.plan_in_force(), traffic.running.during(traffic.step)});
    reachable_m = traffic.reachable_area_m;
  };
  rules.is_late = [&](const controller::Controller&) { return is_late(); };
  rules.on_prediction = [&](const controller::Controller&,
                            const coordination::Prediction& prediction) {
    for (std::uint64_t k = prediction.step.value + 1; k < prediction.step.value + 10; ++k) {
      stray.beyond_reach_m = std::max(
          stray.beyond_reach_m, outside_m(reachable_m, prediction.areas.during({k}).vertices_m));
    }
  };
  const closed_loop::Experiment experiment = closed_loop::drive_experiment(
      scenario, {.steps = scenario.steps, .noise_seed = noise_seed, .rules = rules});
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  compare(experiment.drives.at(scenario.vehicles.front().id.value), experiment.facts.period,
          announced, automaton, stray);
  stray.steps_at_limit = steps_at_limit(announced, automaton);
  stray.fallback_steps = static_cast<std::size_t>(
      std::ranges::count_if(experiment.reports, [](const ReportRecord& record) {
        return record.report.status == coordination::StepStatus::kFallback;
      }));
  return stray;
}

}  // namespace hlc::simulated_vehicle::controlled_loop
