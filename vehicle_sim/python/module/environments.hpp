#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::python {

struct EnvironmentOptions {
  std::size_t num_environments{1};
  std::size_t episode_steps{150};  ///< after which an episode is truncated
  bool has_random_starts{true};    ///< otherwise those of the scenario
};

/// What a learner sees of one step of all environments; sizes in Environments.
struct Observed {
  std::vector<float> observations;        ///< [environment][car][feature]
  std::vector<float> rewards;             ///< [environment][car]
  std::vector<std::uint8_t> terminated;   ///< [environment][car]: it met something in this step
  std::vector<std::uint8_t> truncated;    ///< [environment]: the episode's steps are over
  std::vector<std::uint8_t> permitted;    ///< [environment][car][action]
  std::vector<float> final_observations;  ///< as observations, where an episode ended its last ones
};

/// E independent copies of a scenario's C cars in which a learner plans instead of the planner:
/// per step (step_s of the automaton) it chooses for each car the trim that comes next, and the car
/// follows the maneuver that leads there perfectly. No search, no messages.
///
/// **Action** of a car: number of a trim, from 0. If no edge of the subgraph leads there from the
/// car's trim, the slowest trim in reach is taken; of several edges (labels) the first.
///
/// **Reward** of a car: -||p - r||^2 [m^2], the planner's cost of one step: p the position after
/// the step, r the point of its route that is one step at the reference speed beyond its place
/// before the step; and -1 more if it is terminated.
///
/// **Terminated** is a car whose area of the step (footprint and safety margin) meets another
/// car's or an obstacle, or whose footprint crosses a bound of its lanes. The episode ends with the
/// first such car or after `episode_steps`, or at the end of a route that is not closed. The next
/// one begins at once: the observations of a step that ends an episode are those of the next begin,
/// its final observations those of the end, from which a learner computes the value of a truncated
/// episode. Where no episode ends, and after a reset, both are equal.
///
/// **Observation** of a car, kOwn + kOther (C - 1) numbers, lengths [m] and angles in its frame
/// (x forward, y to the left):
///
///     0      speed [m/s]
///     1      steering [rad]
///     2..9   x and y of the points of its route 0.2, 0.4, 0.8 and 1.6 m beyond its place
///     then of each other car, in the order of the scenario: x, y, cosine and sine of its relative
///     heading, speed [m/s]
class Environments {
 public:
  static constexpr std::size_t kOwn = 10;
  static constexpr std::size_t kOther = 5;

  /// @pre num_environments >= 1, episode_steps >= 1
  /// @throws std::invalid_argument with one line if the scenario has guests
  Environments(const scenario::Scenario& scenario, const EnvironmentOptions& options);

  [[nodiscard]] std::size_t num_environments() const { return environments_.size(); }
  [[nodiscard]] std::size_t num_cars() const { return routes_.size(); }
  [[nodiscard]] std::size_t num_actions() const { return edges_.front().size(); }
  [[nodiscard]] std::size_t num_features() const { return kOwn + kOther * (num_cars() - 1); }

  /// A new episode everywhere; environment i draws with seed + i. Before the first step.
  /// @throws std::invalid_argument with one line, also from `step`, if there is no room for a car
  void reset(std::uint64_t seed, Observed& observed);
  [[nodiscard]] bool has_begun() const { return !environments_.front().cars.empty(); }
  /// @param actions  [environment][car]. @pre has_begun, all are below num_actions
  void step(std::span<const std::int64_t> actions, Observed& observed);
  /// Poses of all cars, [environment][car].
  [[nodiscard]] std::vector<Pose> poses() const;

 private:
  /// A car's route, and of each place the bounds of its lanes nearby.
  struct Route {
    road::ReferencePath path;
    std::vector<std::vector<Segment>> bounds_m;  ///< of each kWindow_m of the path
    Pose start;
    double start_s_m{};
  };
  struct Car {
    Pose pose;
    std::size_t trim{};
    double s_m{};  ///< place on its route
    ConvexPolygon area_m;
    bool is_terminated{};
  };
  struct Environment {
    std::vector<Car> cars;
    std::mt19937_64 random;
    std::size_t step{};
  };
  static constexpr double kWindow_m = 0.2;

  void begin(Environment& environment) const;
  /// At its start, or a random one; terminated if it meets a bound, an obstacle or a car before it.
  void place(Environment& environment, std::size_t index) const;
  [[nodiscard]] bool leaves_lanes(const Route& route, double s_m,
                                  const ConvexPolygon& area_m) const;
  [[nodiscard]] bool meets_obstacle(const Car& car) const;
  void terminate_who_meet(Environment& environment) const;
  /// @return its reward without the one for termination
  double move(const Route& route, std::size_t action, Car& car) const;
  void observe(std::size_t index, Observed& observed) const;
  /// What was observed last of that environment is also its final observation.
  void keep_final(std::size_t index, Observed& observed) const;
  void prepare(Observed& observed) const;

  std::string file_;  ///< of the scenario, for messages
  std::shared_ptr<const automaton::Subgraph> subgraph_;
  EnvironmentOptions options_;
  double reference_m_;  ///< the way of one step at the reference speed
  std::vector<Route> routes_;
  std::vector<ConvexPolygon> obstacles_m_;
  /// [trim][action]: what is driven; permitted if it leads to that trim.
  std::vector<std::vector<const automaton::Maneuver*>> edges_;
  std::vector<Environment> environments_;
};

}  // namespace hlc::python
