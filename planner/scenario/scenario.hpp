#pragma once

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
#include "planner/road/placement.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/scenario/profile.hpp"

namespace hlc {

/// One vehicle of a scenario.
struct ScenarioVehicle {
  VehicleId id;
  std::string name;
  Pose start;          ///< planned pose at the start, standing
  double start_s_m{};  ///< arc length on the path at which it stands, or beside which
  ReferencePath path;  ///< closed: a lap can be driven
  Corridor corridor;
};

/// What a run is: who drives where, on which automaton, by which rules.
struct Scenario {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path automaton_file;
  std::optional<std::filesystem::path> map_file;  ///< none: open ground without lanes
  std::optional<std::filesystem::path> lab_file;  ///< none: nothing is said of what can be followed
  std::optional<LabLimits> lab;
  std::size_t steps{};
  std::size_t horizon_steps{};
  double reference_speed_mps{};
  Profile profile;
  SearchOptions search;  ///< engine: the command line's, else the file's, else the profile's
  /// Its automaton holds all that its configuration declares: other subgraphs may be asked for.
  bool is_reconfigurable{};
  /// What its controllers choose to plan on by themselves, by name, and which of it they do.
  std::map<std::string, ReconfigurationSettings> policies;
  std::string policy;  ///< kNoPolicy: nothing
  ReconfigurationSettings reconfiguration;
  std::shared_ptr<const Subgraph> subgraph;
  std::vector<ScenarioVehicle> vehicles;  ///< sorted by id
  /// For vehicles that the scenario does not name: its routes by name, or on a circle those of its
  /// cars.
  std::vector<DrivableRoute> routes;
};

/// What the command line chooses instead of the file.
struct ScenarioChoices {
  std::filesystem::path file;
  std::string profile{"default"};
  std::optional<std::string> engine;  ///< see kEngineChoices; default: the scenario's
  std::optional<std::string> subgraph;
  std::optional<std::string> policy;  ///< kNoPolicy for none; default: the scenario's
  std::optional<std::filesystem::path> map_file;
  std::optional<std::size_t> steps;
  std::optional<std::size_t> cars;  ///< scenarios on a circle only
};

/// Most cars of a scenario on a circle.
inline constexpr std::size_t kMaxCarsOnCircle = 20;

/// Reads the scenario in three stages: what its file says (scenario_values.hpp), the files that it
/// names (scenario_inputs.hpp: map, lab and automaton), and the two put together
/// (scenario_assembly.hpp). The automaton is read from a file that build_automaton has written, or
/// from a configuration, of which it builds what the chosen subgraph needs, or with
/// `reconfigurable: true` or `policies` all (maneuvers are solved);
/// and checks that it can be driven: routes exist and close, start poses do not overlap, standstill
/// is within the horizon, and the lab's vehicles, if it names a lab, can follow the automaton.
/// @throws std::invalid_argument, std::runtime_error with one line: file, place, value, what is
/// allowed
[[nodiscard]] Scenario read_scenario(const ScenarioChoices& choices);

/// The same with the automaton's subgraph at hand: for programs that read many scenarios.
[[nodiscard]] Scenario read_scenario(const ScenarioChoices& choices,
                                     std::shared_ptr<const UniversalAutomaton> automaton,
                                     const std::vector<SubgraphSpec>& subgraphs);

/// The files that a scenario was read from: its own, automaton, map, lab.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const Scenario& scenario);

/// @throws std::invalid_argument if the scenario has no such vehicle
[[nodiscard]] const ScenarioVehicle& vehicle_of(const Scenario& scenario, VehicleId id);

/// The controller of one vehicle. One that the scenario names takes its own route; any other takes
/// the route of the scenario that it fits best where it stands.
[[nodiscard]] std::unique_ptr<Controller> make_controller(const Scenario& scenario, VehicleId id);

/// Yaw of the vehicle that stands at a planned pose (the lab's vehicles point a little aside of
/// their course).
[[nodiscard]] Pose measured_start(const Scenario& scenario, const ScenarioVehicle& vehicle);

}  // namespace hlc
