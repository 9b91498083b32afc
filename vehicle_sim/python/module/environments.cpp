#include "vehicle_sim/python/module/environments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "planner/common/demand.hpp"

namespace hlc::python {
namespace {

using automaton::Edge;
using automaton::Maneuver;

constexpr std::array<double, 4> kLookAhead_m{0.2, 0.4, 0.8, 1.6};
constexpr int kMostDraws = 1000;
constexpr double kHalfChord_m = 0.05;

bool meet(const ConvexPolygon& a, const ConvexPolygon& b) {
  return overlap(bounding_box(a), bounding_box(b)) && intersects(a, b);
}

/// In each row the edge to that trim, else the one to the slowest trim in reach.
std::vector<std::vector<const Maneuver*>> edge_table(const automaton::Subgraph& subgraph) {
  const std::vector<automaton::Trim>& trims = subgraph.automaton().trims;
  std::vector<std::vector<const Maneuver*>> table(
      trims.size(), std::vector<const Maneuver*>(trims.size(), nullptr));
  for (const TrimId from : subgraph.start_trims()) {
    std::vector<const Maneuver*>& row = table[from.index];
    const Maneuver* slowest = nullptr;
    for (const Edge& edge : subgraph.successors(from)) {
      const double speed_mps = trims[edge.to.index].speed_mps;
      if (row[edge.to.index] == nullptr) row[edge.to.index] = edge.maneuver;
      if (slowest == nullptr || speed_mps < trims[slowest->to.index].speed_mps)
        slowest = edge.maneuver;
    }
    std::ranges::replace(row, static_cast<const Maneuver*>(nullptr), slowest);
  }
  return table;
}

/// The place nearest to a car that was at `s_m` and has driven at most `way_m` since.
double place_of(const road::ReferencePath& path, const Point& position_m, double s_m,
                double way_m) {
  return path.project_within(position_m, s_m - 0.1, s_m + way_m + 0.1).s_m;
}

Point in_frame(const Point& point_m, const Pose& frame) {
  const double cosine = std::cos(frame.heading_rad);
  const double sine = std::sin(frame.heading_rad);
  const Point away_m = point_m - frame.position_m();
  return {cosine * away_m.x() + sine * away_m.y(), cosine * away_m.y() - sine * away_m.x()};
}

std::vector<std::vector<Segment>> bounds_along(const scenario::ScenarioVehicle& vehicle,
                                               double window_m, double reach_m) {
  std::vector<std::vector<Segment>> bounds(
      static_cast<std::size_t>(vehicle.path.length_m() / window_m) + 1);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double s_m = window_m * static_cast<double>(i);
    bounds[i] = vehicle.corridor.boundary_m(s_m - reach_m, s_m + window_m + reach_m);
  }
  return bounds;
}

}  // namespace

Environments::Environments(const scenario::Scenario& scenario, const EnvironmentOptions& options)
    : file_(scenario.file.string()),
      subgraph_(scenario.subgraph),
      options_(options),
      reference_m_(scenario.reference_speed_mps * scenario.subgraph->automaton().step_s),
      edges_(edge_table(*scenario.subgraph)),
      environments_(options.num_environments) {
  HLC_DEMAND(options.num_environments >= 1 && options.episode_steps >= 1, options.num_environments,
             options.episode_steps);
  if (!scenario.guests.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: guests = {}, must be 0 for learners", file_, scenario.guests.size()));
  }
  const automaton::UniversalAutomaton& all = subgraph_->automaton();
  const double reach_m =
      automaton::top_speed_mps(all) * all.step_s + all.vehicle.footprint.length_m;
  for (const scenario::ScenarioVehicle& one : scenario.vehicles) {
    routes_.push_back({.path = one.path,
                       .bounds_m = bounds_along(one, kWindow_m, reach_m),
                       .start = one.start,
                       .start_s_m = one.start_s_m});
  }
  for (const scenario::ScenarioObstacle& one : scenario.obstacles)
    obstacles_m_.push_back(one.area_m);
}

void Environments::place(Environment& environment, std::size_t index) const {
  const Route& route = routes_[index];
  Car& car = environment.cars[index];
  const std::size_t trim = subgraph_->standstill().index;
  const Maneuver& standing = *edges_[trim][trim];
  car = {.pose = route.start, .trim = trim, .s_m = route.start_s_m};
  if (options_.has_random_starts) {
    car.s_m = route.path.length_m() * (static_cast<double>(environment.random() >> 11U) * 0x1p-53);
    const Point position_m = route.path.at(car.s_m);
    car.pose = {position_m.x(), position_m.y(),
                chord_heading_rad(route.path, car.s_m, kHalfChord_m)};
  }
  car.area_m = transformed(standing.swept_area_m, car.pose);
  car.is_terminated = leaves_lanes(route, car.s_m, transformed(standing.lane_area_m, car.pose)) ||
                      meets_obstacle(car) ||
                      std::any_of(environment.cars.begin(),
                                  environment.cars.begin() + static_cast<std::ptrdiff_t>(index),
                                  [&](const Car& other) { return meet(car.area_m, other.area_m); });
}

void Environments::begin(Environment& environment) const {
  environment.cars.resize(num_cars());
  environment.step = 0;
  for (std::size_t i = 0; i < num_cars(); ++i) {
    int draws = 0;
    do {
      place(environment, i);
    } while (environment.cars[i].is_terminated && options_.has_random_starts &&
             ++draws < kMostDraws);
    if (!environment.cars[i].is_terminated) continue;
    throw std::invalid_argument(fmt::format(
        "{}: no start of car {} keeps clear of bounds, obstacles and the cars before it", file_,
        i + 1));
  }
}

bool Environments::leaves_lanes(const Route& route, double s_m, const ConvexPolygon& area_m) const {
  const std::size_t window =
      std::min(static_cast<std::size_t>(s_m / kWindow_m), route.bounds_m.size() - 1);
  const Box box = bounding_box(area_m);
  return std::ranges::any_of(route.bounds_m[window], [&](const Segment& bound) {
    return overlap(box, bounding_box(bound)) && intersects(area_m, bound);
  });
}

bool Environments::meets_obstacle(const Car& car) const {
  return std::ranges::any_of(obstacles_m_,
                             [&](const ConvexPolygon& area_m) { return meet(car.area_m, area_m); });
}

void Environments::terminate_who_meet(Environment& environment) const {
  std::vector<Car>& cars = environment.cars;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    if (meets_obstacle(cars[i])) cars[i].is_terminated = true;
    for (std::size_t j = 0; j < i; ++j) {
      if (!meet(cars[i].area_m, cars[j].area_m)) continue;
      cars[i].is_terminated = true;
      cars[j].is_terminated = true;
    }
  }
}

double Environments::move(const Route& route, std::size_t action, Car& car) const {
  const Maneuver& maneuver = *edges_[car.trim][action];
  const Point reference_m = route.path.at(car.s_m + reference_m_);
  car.area_m = transformed(maneuver.swept_area_m, car.pose);
  car.is_terminated = leaves_lanes(route, car.s_m, transformed(maneuver.lane_area_m, car.pose));
  car.pose = compose(car.pose, maneuver.displacement);
  car.trim = maneuver.to.index;
  car.s_m = place_of(route.path, car.pose.position_m(), car.s_m,
                     maneuver.displacement.position_m().norm());
  return -(car.pose.position_m() - reference_m).squaredNorm();
}

void Environments::step(std::span<const std::int64_t> actions, Observed& observed) {
  HLC_DEMAND(actions.size() == num_environments() * num_cars(), actions.size());
  prepare(observed);
  for (std::size_t e = 0; e < environments_.size(); ++e) {
    Environment& environment = environments_[e];
    bool is_at_end = false;
    for (std::size_t i = 0; i < num_cars(); ++i) {
      const std::size_t at = e * num_cars() + i;
      const Route& route = routes_[i];
      const auto action = static_cast<std::size_t>(actions[at]);
      observed.rewards[at] = static_cast<float>(move(route, action, environment.cars[i]));
      is_at_end = is_at_end || (!route.path.is_closed() &&
                                environment.cars[i].s_m + reference_m_ >= route.path.length_m());
    }
    terminate_who_meet(environment);
    bool is_terminated = false;
    for (std::size_t i = 0; i < num_cars(); ++i) {
      if (!environment.cars[i].is_terminated) continue;
      observed.terminated[e * num_cars() + i] = 1;
      observed.rewards[e * num_cars() + i] -= 1.0F;
      is_terminated = true;
    }
    const bool is_last = ++environment.step >= options_.episode_steps || is_at_end;
    observed.truncated[e] = static_cast<std::uint8_t>(is_last && !is_terminated);
    observe(e, observed);
    keep_final(e, observed);
    if (!is_last && !is_terminated) continue;
    begin(environment);
    observe(e, observed);
  }
}

void Environments::reset(std::uint64_t seed, Observed& observed) {
  prepare(observed);
  for (std::size_t e = 0; e < environments_.size(); ++e) {
    environments_[e].random.seed(seed + e);
    begin(environments_[e]);
    observe(e, observed);
    keep_final(e, observed);
  }
}

void Environments::prepare(Observed& observed) const {
  const std::size_t num = num_environments() * num_cars();
  observed.observations.resize(num * num_features());
  observed.final_observations.resize(num * num_features());
  observed.rewards.assign(num, 0.0F);
  observed.terminated.assign(num, 0);
  observed.truncated.assign(num_environments(), 0);
  observed.permitted.assign(num * num_actions(), 0);
}

void Environments::keep_final(std::size_t index, Observed& observed) const {
  const auto num = static_cast<std::ptrdiff_t>(num_cars() * num_features());
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(index) * num;
  std::copy_n(observed.observations.begin() + at, num, observed.final_observations.begin() + at);
}

void Environments::observe(std::size_t index, Observed& observed) const {
  const std::vector<Car>& cars = environments_[index].cars;
  const std::vector<automaton::Trim>& trims = subgraph_->automaton().trims;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const std::size_t at = index * cars.size() + i;
    const Car& car = cars[i];
    float* next = &observed.observations[at * num_features()];
    const auto put = [&next](double number) { *next++ = static_cast<float>(number); };
    put(trims[car.trim].speed_mps);
    put(trims[car.trim].steering_rad);
    for (const double ahead_m : kLookAhead_m) {
      const Point point_m = in_frame(routes_[i].path.at(car.s_m + ahead_m), car.pose);
      put(point_m.x());
      put(point_m.y());
    }
    for (std::size_t j = 0; j < cars.size(); ++j) {
      if (j == i) continue;
      const Point point_m = in_frame(cars[j].pose.position_m(), car.pose);
      const double turned_rad = cars[j].pose.heading_rad - car.pose.heading_rad;
      put(point_m.x());
      put(point_m.y());
      put(std::cos(turned_rad));
      put(std::sin(turned_rad));
      put(trims[cars[j].trim].speed_mps);
    }
    for (std::size_t action = 0; action < num_actions(); ++action) {
      observed.permitted[at * num_actions() + action] =
          static_cast<std::uint8_t>(edges_[car.trim][action]->to.index == action);
    }
  }
}

std::vector<Pose> Environments::poses() const {
  std::vector<Pose> poses;
  for (const Environment& environment : environments_) {
    for (const Car& car : environment.cars) poses.push_back(car.pose);
  }
  return poses;
}

}  // namespace hlc::python
