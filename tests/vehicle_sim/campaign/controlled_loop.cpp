#include "tests/vehicle_sim/campaign/controlled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "hlc_bridge/core/command.hpp"
#include "planner/automaton/deviation.hpp"

namespace hlc::controlled_loop {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr std::uint64_t kTicksPerStep = kPeriod / kVehiclePeriod;
constexpr std::uint64_t kFirstStep = 5;
constexpr std::size_t kStateDelayTicks = 3;  ///< a state becomes valid 60 ms after its tick

/// How far the farthest of the points is outside the area, measured across its edges.
double outside_m(const ConvexPolygon& area, const std::vector<Point>& points) {
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

}  // namespace

Stray drive(Controller& controller, const Pose& start, std::size_t steps,
            std::optional<std::uint64_t> noise_seed,
            const std::function<bool(std::uint64_t step)>& gives_up) {
  const UniversalAutomaton& automaton = controller.subgraph().automaton();
  const VehicleId id = controller.options().vehicle;
  Pose yawed = start;
  yawed.heading_rad += yaw_minus_heading_rad(0.0, automaton.vehicle, automaton.identified);
  SimulatedVehicle vehicle({.vehicle_id = id.value,
                            .start = yawed,
                            .noise_seed = noise_seed,
                            .gains = {},
                            .vehicle = automaton.identified});
  Stray stray;
  std::deque<VehicleState> states;
  const auto observation_at = [&](std::uint64_t step) {
    const VehicleState& state = states.front();
    const double age_s = 1e-9 * static_cast<double>(step * kPeriod - state.create_stamp);
    return Observation{
        .step = {step},
        .active = {id},
        .states = {
            {.vehicle = id, .pose = state.pose, .speed_mps = state.speed_mps, .age_s = age_s}}};
  };
  for (std::uint64_t step = 0; step < kFirstStep + steps; ++step) {
    // What was told of this step before it began; the vehicle's first tick still follows that.
    std::optional<Plan> told;
    OccupiedAreas areas;
    std::optional<TrajectoryCommand> answer;
    if (step >= kFirstStep) {
      const Observation observation = observation_at(step);
      if (step == kFirstStep) {
        static_cast<void>(controller.stand_by(observation));
      } else {
        told = controller.plan_in_force();
        const Traffic traffic = controller.observe(observation);
        areas = traffic.running;
        controller.couple({});
        Report report;
        if (gives_up(step)) {
          report = controller.give_up(FallbackReason::kLate);
        } else {
          const Prediction prediction = controller.plan({});
          for (std::uint64_t k = step + 1; k < step + 10; ++k) {
            stray.beyond_reach_m = std::max(
                stray.beyond_reach_m,
                outside_m(traffic.reachable_area_m, prediction.areas.during({k}).vertices_m));
          }
          report = controller.settle({}, {});
        }
        stray.fallback_steps += report.status == StepStatus::kFallback ? 1U : 0U;
        stray.astray_steps += report.reason == FallbackReason::kDeviation ? 1U : 0U;
        for (const TrimId trim : {told->trim_at({step}), told->trim_at({step + 1})}) {
          if (is_at_steering_limit(automaton.trims[trim.index], automaton.vehicle,
                                   automaton.identified)) {
            ++stray.steps_at_limit;
            break;
          }
        }
      }
      answer = command_of(id, &controller.plan_in_force(), {step}, step * kPeriod + 1, kPeriod,
                          automaton.vehicle);
    }
    for (std::uint64_t i = 0; i < kTicksPerStep; ++i) {
      const Nanoseconds t = step * kPeriod + i * kVehiclePeriod;
      const SimulatedVehicle::Tick tick = vehicle.tick(t);
      if (i == 0 && answer) {
        vehicle.receive(*answer);
        vehicle.receive(copy_for_later(*answer));
      }
      states.push_back(tick.state);
      if (states.size() > kStateDelayTicks) states.pop_front();
      if (!told) continue;
      const State planned =
          told->state_at({step}, 1e-3 * 20.0 * static_cast<double>(i), automaton.vehicle);
      const Pose& driven = tick.driven.pose;
      const double deviation =
          footprint_deviation_m(driven, planned, automaton.vehicle, automaton.identified);
      stray.deviation_m = std::max(stray.deviation_m, deviation);
      stray.position_m =
          std::max(stray.position_m, (driven.position_m() - planned.pose.position_m()).norm());
      const double yaw =
          planned.pose.heading_rad +
          yaw_minus_heading_rad(planned.steering_rad, automaton.vehicle, automaton.identified);
      stray.yaw_rad = std::max(stray.yaw_rad, std::abs(wrap_angle(driven.heading_rad - yaw)));
      const double outside = outside_m(
          areas.during({step}), footprint_area(automaton.vehicle.footprint, driven).vertices_m);
      if (outside > stray.outside_m) {
        stray.outside_m = outside;
        stray.outside_tick = step * kTicksPerStep + i;
      }
    }
  }
  return stray;
}

}  // namespace hlc::controlled_loop
