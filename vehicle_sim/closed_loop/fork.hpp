#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::closed_loop {

/// What is different from a step of a run on: a "what if". Before, the run is the same.
struct Fork {
  /// PriorityRule::first of all controllers.
  struct Priorities {
    std::vector<VehicleId> first;
    friend bool operator==(const Priorities&, const Priorities&) = default;
  };
  /// Of all controllers.
  struct Coordination {
    controller::CoordinationRule rule;
    friend bool operator==(const Coordination&, const Coordination&) = default;
  };
  /// A request to a vehicle's controller, as an operator's (policy::SubgraphSelector). Later
  /// changes add to it.
  struct Labels {
    VehicleId vehicle;
    std::vector<std::string> labels;
    friend bool operator==(const Labels&, const Labels&) = default;
  };
  struct MaxSpeed {
    VehicleId vehicle;
    double max_speed_mps{};
    friend bool operator==(const MaxSpeed&, const MaxSpeed&) = default;
  };
  /// The vehicle is gone with all its processes; the others' lists no longer contain it.
  struct Without {
    VehicleId vehicle;
    friend bool operator==(const Without&, const Without&) = default;
  };
  /// All messages of one controller to another one are lost in this many steps.
  struct Lost {
    VehicleId from;
    VehicleId to;
    std::uint64_t steps{1};
    friend bool operator==(const Lost&, const Lost&) = default;
  };
  /// A rectangle that stands there for good; all controllers know of it.
  struct Obstacle {
    Pose pose;          ///< of its centre
    double length_m{};  ///< along the heading
    double width_m{};
    friend bool operator==(const Obstacle&, const Obstacle&) = default;
  };
  /// One of the scenario's routes instead of the vehicle's.
  struct Route {
    VehicleId vehicle;
    std::string name;
    friend bool operator==(const Route&, const Route&) = default;
  };
  using Change =
      std::variant<Priorities, Coordination, Labels, MaxSpeed, Without, Lost, Obstacle, Route>;

  std::uint64_t from{};  ///< step of the experiment, from 0
  std::vector<Change> changes;
};

/// One line for each form of a change.
inline constexpr char kChangeForms[] =
    "priorities=3,1: these plan before all others, in this order\n"
    "coordination=agreed: cooperative, strict or agreed\n"
    "criteria=3:J2+J3: maneuvers on which vehicle 3 plans\n"
    "speed=3:0.4: most that vehicle 3 may drive [m/s]\n"
    "without=3: vehicle 3 is gone\n"
    "lost=1>3:5: what vehicle 1 sends to 3 is lost for 5 steps (without a number: 1)\n"
    "obstacle=2.4,1.8,0.3,0.1,0.8: a rectangle stands at x = 2.4 m, y = 1.8 m, 0.3 m long and "
    "0.1 m wide, turned by 0.8 rad (without: 0)\n"
    "route=3:blue: vehicle 3 drives on along the scenario's route blue";

/// @throws std::invalid_argument with one line: the text and what is allowed; vehicles are the
/// scenario's
[[nodiscard]] Fork::Change change_from_text(const std::string& text,
                                            const scenario::Scenario& scenario);

/// Whether such a run can be driven.
/// @param steps  of the run
/// @throws std::invalid_argument with one line: a fork from beyond its end, `Without` from step 0
/// (the scenario is another one then) or of the last vehicle, a change of one that is gone; with
/// two rounds a coordination that needs votes
void check_forks(const std::vector<Fork>& forks, const scenario::Scenario& scenario,
                 std::uint64_t steps);

}  // namespace hlc::closed_loop
