#include "planner/maneuver_design/feasibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/maneuver_design/shooting.hpp"

namespace hlc::maneuver_design {
namespace {

struct Words {
  const char* state;
  const char* state_unit;
  const char* input;
  const char* input_unit;
};

Words words_of(const Channel& channel) {
  return channel.index == 0 ? Words{"speed", " m/s", "acceleration", " m/s^2"}
                            : Words{"steering", " rad", "steering rate", " rad/s"};
}

/// True if each trim alone satisfies every g_i.
bool trims_satisfy_path_constraints(const ManeuverProblem& problem, std::string& reason) {
  bool good = true;
  for (const automaton::Trim& trim : {problem.from, problem.to}) {
    const vehicle::State state{Pose{}, trim.speed_mps, trim.steering_rad};
    for (const auto& constraint : problem.path_constraints) {
      if (constraint->value(vehicle::to_vector(state), vehicle::Input{}) > kPathTolerance) {
        reason += fmt::format("trim of speed {:g} m/s and steering {:g} rad violates the {}; ",
                              trim.speed_mps, trim.steering_rad, constraint->name());
        good = false;
      }
    }
  }
  return good;
}

bool trims_are_within_bounds(const Channel& channel, std::string& reason) {
  bool good = true;
  const Words words = words_of(channel);
  for (const double value : {channel.from, channel.to}) {
    if (value < channel.state_min || value > channel.state_max) {
      reason +=
          fmt::format("{} of a trim = {:g}{}, must be in {:g} ... {:g}{}; ", words.state, value,
                      words.state_unit, channel.state_min, channel.state_max, words.state_unit);
      good = false;
    }
  }
  return good;
}

}  // namespace

Feasibility feasibility_of(const ManeuverProblem& problem) {
  const double longest_s =
      problem.free_duration ? problem.free_duration->max_s : problem.duration_s;
  Feasibility result;
  bool trims_are_good = trims_satisfy_path_constraints(problem, result.reason);
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    const Words words = words_of(channel);
    trims_are_good = trims_are_within_bounds(channel, result.reason) && trims_are_good;
    const double shortest_s = std::abs(channel.change()) / channel.input_max;
    result.shortest_duration_s = std::max(result.shortest_duration_s, shortest_s);
    if (shortest_s > longest_s * (1.0 + kFeasibilityTolerance)) {
      result.reason +=
          fmt::format("{} {:g} -> {:g}{} in {:g} s needs {} {:g}{}, must be <= {:g}{}; ",
                      words.state, channel.from, channel.to, words.state_unit, longest_s,
                      words.input, std::abs(channel.change()) / longest_s, words.input_unit,
                      channel.input_max, words.input_unit);
    }
  }
  if (!trims_are_good) {
    result.shortest_duration_s = std::numeric_limits<double>::infinity();
  }
  if (!result.reason.empty()) {
    result.reason += fmt::format("shortest feasible duration {:g} s", result.shortest_duration_s);
  }
  return result;
}

ConstraintResiduals residuals_of(const ManeuverProblem& problem,
                                 const std::vector<vehicle::Input>& inputs,
                                 const std::vector<vehicle::State>& states, double duration_s) {
  const vehicle::VehicleLimits& limits = problem.limits;
  ConstraintResiduals r;
  r.end_speed_mps = std::abs(states.back().speed_mps - problem.to.speed_mps);
  r.end_steering_rad = std::abs(states.back().steering_rad - problem.to.steering_rad);
  for (const vehicle::Input& u : inputs) {
    r.acceleration_mps2 =
        std::max(r.acceleration_mps2, std::abs(u.acceleration_mps2) - limits.acceleration_mps2);
    r.steering_rate_radps = std::max(r.steering_rate_radps,
                                     std::abs(u.steering_rate_radps) - limits.steering_rate_radps);
  }
  for (const vehicle::State& x : states) {
    r.speed_mps = std::max(
        {r.speed_mps, x.speed_mps - limits.speed_max_mps, limits.speed_min_mps - x.speed_mps});
    r.steering_rad = std::max(r.steering_rad, std::abs(x.steering_rad) - limits.steering_max_rad);
  }
  for (const auto& constraint : problem.path_constraints) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      r.path = std::max({r.path, constraint->value(vehicle::to_vector(states[k]), inputs[k]),
                         constraint->value(vehicle::to_vector(states[k + 1]), inputs[k])});
    }
  }
  for (const CostBound& bound : problem.cost_bounds) {
    const double value =
        shoot(states.front(), inputs, duration_s, *bound.cost, problem.vehicle, WithGradient::kNo)
            .cost;
    r.cost_bound = std::max(r.cost_bound, (value - bound.max) / bound.scale());
  }
  return r;
}

bool within_tolerance(const ConstraintResiduals& r, const vehicle::VehicleLimits& limits) {
  const double t = kFeasibilityTolerance;
  return r.end_speed_mps <= t * limits.speed_max_mps &&
         r.end_steering_rad <= t * limits.steering_max_rad &&
         r.acceleration_mps2 <= t * limits.acceleration_mps2 &&
         r.steering_rate_radps <= t * limits.steering_rate_radps &&
         r.speed_mps <= t * limits.speed_max_mps && r.steering_rad <= t * limits.steering_max_rad &&
         r.path <= kPathTolerance && r.cost_bound <= kPathTolerance;
}

}  // namespace hlc::maneuver_design
