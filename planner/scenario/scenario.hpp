#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/controller.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/road/corridor.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/placement.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/scenario/guest_values.hpp"
#include "planner/scenario/profile.hpp"

namespace hlc::scenario {

/// One vehicle of a scenario.
struct ScenarioVehicle {
  VehicleId id;
  std::string name;
  Pose start;                       ///< planned pose at the start, standing
  double start_s_m{};               ///< arc length of its place on the path
  road::LaneletId start_lanelet{};  ///< in which the start lies; 0 without lanes
  road::ReferencePath path;         ///< closed: a lap can be driven; open: it ends at the goal
  road::Corridor corridor;
  road::DrivingLine driving_line{};  ///< these two as in DrivableRoute
  std::uint32_t route_number{};
  std::optional<road::Goal> goal{};             ///< in which the path ends
  std::optional<double> reference_speed_mps{};  ///< its own; none: the scenario's
  std::vector<road::SpeedSection> speed_sections{};
};

/// Something that is no vehicle, and stands for good.
struct ScenarioObstacle {
  std::string name;
  ConvexPolygon area_m;
};

/// A run: its vehicles and routes, automaton and rules.
struct Scenario {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path automaton_file;
  std::optional<std::filesystem::path> map_file;  ///< none: open ground without lanes
  std::optional<std::filesystem::path> lab_file;  ///< none: no limits
  std::optional<vehicle::LabLimits> lab;
  std::size_t steps{};
  std::size_t horizon_steps{};
  double reference_speed_mps{};
  double contouring_weight{};                         ///< ControllerOptions
  std::optional<double> held_up_contouring_weight{};  ///< none: the same
  Profile profile;
  controller::Rounds rounds{};
  /// Engine: the command line's, else the file's, else the profile's
  search::SearchOptions search;
  /// The automaton holds all that its configuration declares: other subgraphs may be requested.
  bool is_reconfigurable{};
  /// The policies of its controllers by name, and the one in force.
  std::map<std::string, policy::ReconfigurationSettings> policies;
  std::string policy;  ///< kNoPolicy: none
  policy::ReconfigurationSettings reconfiguration;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::vector<ScenarioVehicle> vehicles;  ///< sorted by id
  std::vector<ScenarioObstacle> obstacles;
  std::vector<ScenarioGuest> guests;
  /// For vehicles that the scenario does not name: its routes by name, or on a circle and with
  /// random routes those of its cars.
  std::vector<road::DrivableRoute> routes;
  /// Width of the map's narrowest lane, with `right_of_way`; otherwise none.
  std::optional<double> shared_lane_width_m;
  std::shared_ptr<const right_of_way::ConflictMap> conflicts;  ///< ControllerOptions
  /// What the cars of a scenario with `draw` are drawn from; otherwise empty.
  std::vector<ScenarioVehicle> candidates;
  /// The same at the begins of their routes' other lanelets, if they are too few; otherwise empty.
  std::vector<ScenarioVehicle> further_candidates;
  std::shared_ptr<const road::LaneletMap> random_routes_on;  ///< none: no random routes
  std::uint64_t seed{};  ///< of the drawn cars and the random routes
};

/// Choices of the command line instead of the file's.
struct ScenarioChoices {
  std::filesystem::path file;
  std::string profile{"default"};
  std::optional<std::string> engine;      ///< see engines(); default: the scenario's
  std::optional<std::string> priorities;  ///< name of a strategy; default: the scenario's
  std::optional<std::string> subgraph;
  std::optional<std::string> policy;  ///< kNoPolicy for none; default: the scenario's
  std::optional<std::filesystem::path> map_file;
  std::optional<std::size_t> steps;
  std::optional<std::size_t> cars;    ///< scenarios on a circle or with `draw` only
  std::optional<std::uint64_t> seed;  ///< scenarios with `draw` or random routes only
  std::optional<std::string> routes;  ///< kRandomRoutes; default: the scenario's
};

inline constexpr char kRandomRoutes[] = "random";
inline constexpr std::uint64_t kMaxSeed = 1'000'000'000;
/// Most cars of a scenario on a circle.
inline constexpr std::size_t kMaxCarsOnCircle = 20;

/// Reads the scenario in three stages: the values of its file (scenario_values.hpp), the files that
/// it names (scenario_inputs.hpp: map, lab and automaton), and their combination
/// (scenario_assembly.hpp). The automaton is read from a file of build_automaton, or from a
/// configuration, of which the part needed by the chosen subgraph is built, or with
/// `reconfigurable: true` or `policies` all (maneuvers are solved). Checks that the scenario can be
/// driven: routes exist and close, start poses overlap neither each other nor an obstacle (with
/// right of way, no route does either), standstill is within the horizon,
/// and the lab's vehicles, if it names a lab, can follow the automaton.
/// @throws std::invalid_argument, std::runtime_error with one line: file, place, value, bound
[[nodiscard]] Scenario read_scenario(const ScenarioChoices& choices);

/// The same with a given subgraph of the automaton: for programs that read many scenarios.
[[nodiscard]] Scenario read_scenario(const ScenarioChoices& choices,
                                     std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                                     const std::vector<automaton::SubgraphSpec>& subgraphs);

/// The files that a scenario was read from: its own, automaton, map, lab.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const Scenario& scenario);

/// @throws std::invalid_argument if the scenario has no such vehicle
[[nodiscard]] const ScenarioVehicle& vehicle_of(const Scenario& scenario, VehicleId id);

/// The controller of one vehicle, with the scenario's obstacles. A vehicle that the scenario names
/// takes its own route; any other takes the scenario's route that fits best at its pose.
[[nodiscard]] std::unique_ptr<controller::Controller> make_controller(const Scenario& scenario,
                                                                      VehicleId id);
/// The same on the scenario's subgraph, prepared once for many controllers.
[[nodiscard]] std::unique_ptr<controller::Controller> make_controller(
    const Scenario& scenario, VehicleId id, controller::PreparedSubgraph on);
[[nodiscard]] controller::PreparedSubgraph prepare_subgraph_of(const Scenario& scenario);

/// True if poses lie ahead of their stamps where the scenario is driven (LabLimits::pose_lead_s):
/// as those of the lab's vehicles, which the simulated ones are to be like then.
[[nodiscard]] inline bool has_early_stamps(const Scenario& scenario) {
  return scenario.lab && scenario.lab->pose_lead_s > 0.0;
}

/// Yaw of a vehicle that stands at a planned pose (the lab's vehicles point slightly aside of their
/// course).
[[nodiscard]] Pose measured_start(const Scenario& scenario, const ScenarioVehicle& vehicle);

}  // namespace hlc::scenario
