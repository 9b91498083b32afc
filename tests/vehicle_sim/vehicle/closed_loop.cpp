#include "tests/vehicle_sim/vehicle/closed_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>

namespace hlc::simulated_vehicle::driven_vehicle {
namespace {

constexpr Nanoseconds kGrid = 10 * kMillisecond;
constexpr double kGrid_s = 0.010;
constexpr std::uint64_t kGridPerStep = kPeriod / kGrid;
constexpr Nanoseconds kPointInterval = 50 * kMillisecond;
constexpr std::size_t kHorizonSteps = 8;

/// Appends the maneuver from the last state's trim to `to`, which begins with that state.
void append_maneuver(std::vector<vehicle::State>& states, const Trim& from, const Trim& to) {
  const double duration_s = kGrid_s * static_cast<double>(kGridPerStep);
  const vehicle::Input input{
      .acceleration_mps2 = (to.speed_mps - from.speed_mps) / duration_s,
      .steering_rate_radps = (to.steering_rad - from.steering_rad) / duration_s};
  for (std::uint64_t i = 0; i < kGridPerStep; ++i) {
    states.push_back(
        vehicle::integrated(states.back(), input, kGrid_s, vehicle::VehicleParameters{}));
  }
  states.back().speed_mps = to.speed_mps;  // no rounding in what a trim fixes
  states.back().steering_rad = to.steering_rad;
}

TrajectoryPoint point_of(const vehicle::State& state, Nanoseconds t) {
  const double course_rad =
      state.pose.heading_rad +
      vehicle::slip_angle_rad(state.steering_rad, vehicle::VehicleParameters{});
  return {.t = t,
          .x_m = state.pose.x_m,
          .y_m = state.pose.y_m,
          .vx_mps = state.speed_mps * std::cos(course_rad),
          .vy_mps = state.speed_mps * std::sin(course_rad)};
}

}  // namespace

std::vector<Sample> drive(SimulatedVehicle& vehicle, const Mission& mission, Nanoseconds until,
                          Nanoseconds from) {
  std::vector<Sample> samples;
  std::uint64_t next_step = from / kPeriod;
  for (Nanoseconds t = from; t < until; t += kVehiclePeriod) {
    for (; next_step * kPeriod + 1 < t && next_step <= mission.last_step; ++next_step) {
      TrajectoryCommand command{.vehicle_id = 1,
                                .create_stamp = next_step * kPeriod + 1,
                                .valid_after_stamp = next_step * kPeriod + 1,
                                .points = mission.points(next_step)};
      vehicle.receive(command);
      command.valid_after_stamp += 800 * kMillisecond;
      vehicle.receive(std::move(command));
    }
    samples.push_back({.t = t, .planned_m = mission.planned(t), .tick = vehicle.tick(t)});
  }
  return samples;
}

TrackingError tracking_error(const std::vector<Sample>& samples, Nanoseconds from) {
  TrackingError result;
  std::size_t count = 0;
  for (const Sample& sample : samples) {
    if (sample.t >= from) {
      result.mean_m += sample.error_m();
      result.max_m = std::max(result.max_m, sample.error_m());
      ++count;
    }
  }
  result.mean_m /= static_cast<double>(std::max<std::size_t>(1, count));
  return result;
}

std::string to_string(const TrackingError& error) {
  std::ostringstream text;
  text << "mean " << 1e3 * error.mean_m << " mm, max " << 1e3 * error.max_m << " mm";
  return text.str();
}

const Trim& trim(std::size_t number) {
  static constexpr std::array<Trim, 13> kTrims = {{{},
                                                   {0.0, 0.0},
                                                   {0.4, -0.60},
                                                   {0.5, -0.48},
                                                   {0.6, -0.36},
                                                   {0.7, -0.24},
                                                   {0.8, -0.12},
                                                   {0.8, 0.0},
                                                   {0.8, 0.12},
                                                   {0.7, 0.24},
                                                   {0.6, 0.36},
                                                   {0.5, 0.48},
                                                   {0.4, 0.60}}};
  return kTrims.at(number);
}

TrimWalk::TrimWalk(const Pose& start, std::vector<std::size_t> trims, std::uint64_t seed)
    : trims_(std::move(trims)), states_{vehicle::State{.pose = start}}, seed_(seed) {
  for (std::size_t i = 1; i < trims_.size(); ++i) {
    append_maneuver(states_, trim(trims_[i - 1]), trim(trims_[i]));
  }
}

vehicle::State TrimWalk::state_at(Nanoseconds t) const {
  const Nanoseconds start = kFirstStep * kPeriod;
  const std::uint64_t index = t <= start ? 0 : (t - start) / kGrid;
  return states_[std::min<std::size_t>(index, states_.size() - 1)];
}

std::vector<TrajectoryPoint> TrimWalk::points(std::uint64_t step) const {
  const Nanoseconds begin = step * kPeriod;
  const Nanoseconds fixed_until = begin + 2 * kPeriod;
  const Nanoseconds walk_begin = kFirstStep * kPeriod;

  // What follows the two fixed steps: other trims, at last standstill.
  std::vector<vehicle::State> detour{state_at(fixed_until)};
  if (fixed_until >= walk_begin) {
    std::mt19937_64 random(seed_ * 1'000 + step);
    const std::size_t index = (fixed_until - walk_begin) / kPeriod;
    std::size_t at = trims_[std::min(index, trims_.size() - 1)];
    for (std::size_t j = 2; j < kHorizonSteps; ++j) {
      const bool must_stop = j + 1 == kHorizonSteps;
      std::size_t next = 1;
      if (!must_stop && at == 1) {
        next = 5 + random() % 5;
      } else if (!must_stop) {
        next = std::clamp<std::size_t>(at - 1 + random() % 3, 2, 12);
      }
      append_maneuver(detour, trim(at), trim(next));
      at = next;
    }
  }

  const Nanoseconds end = begin + kHorizonSteps * kPeriod + 1'000 * kMillisecond;
  std::vector<TrajectoryPoint> points;
  for (Nanoseconds t = begin >= kPointInterval ? begin - kPointInterval : 0; t <= end;
       t += kPointInterval) {
    if (t <= fixed_until) {
      points.push_back(point_of(state_at(t), t));
    } else {
      const std::size_t index = (t - fixed_until) / kGrid;
      points.push_back(point_of(detour[std::min(index, detour.size() - 1)], t));
    }
  }
  return points;
}

Mission TrimWalk::mission() const {
  return {.points = [this](std::uint64_t step) { return points(step); },
          .planned = [this](Nanoseconds t) { return state_at(t).pose.position_m(); }};
}

}  // namespace hlc::simulated_vehicle::driven_vehicle
