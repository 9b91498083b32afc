#include "planner/maneuver_design/automaton_configuration.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/automaton/subgraph_yaml.hpp"
#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/demand.hpp"
#include "planner/common/node.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/vehicle/lateral_acceleration.hpp"
#include "planner/vehicle/path_curvature.hpp"

namespace hlc::maneuver_design {
namespace {

std::vector<automaton::Trim> listed_trims(const Node& file,
                                          const vehicle::VehicleParameters& vehicle,
                                          const vehicle::VehicleLimits& limits) {
  std::vector<automaton::Trim> trims;
  for (const Node& entry : file.list("trims")) {
    const automaton::Trim trim = automaton::read_trim(entry, vehicle, limits);
    entry.check_no_unknown_keys();
    if (std::find(trims.begin(), trims.end(), trim) != trims.end()) {
      entry.fail("different from the other trims");
    }
    trims.push_back(trim);
  }
  if (std::none_of(trims.begin(), trims.end(),
                   [](const automaton::Trim& trim) { return trim.is_equilibrium(); })) {
    file.fail("trims", "a list with at least one trim of speed 0");
  }
  return trims;
}

std::vector<double> increasing_numbers(const Node& map, const std::string& key,
                                       const Allowed& allowed) {
  std::vector<double> numbers;
  for (const Node& entry : map.list(key)) {
    numbers.push_back(entry.as<double>(allowed));
    if (numbers.size() > 1 && numbers.back() <= numbers[numbers.size() - 2]) {
      entry.fail("larger than the number before");
    }
  }
  if (numbers.empty()) map.fail(key, "a list with at least one number");
  return numbers;
}

/// Standstill, then every speed with every steering angle that friction circle and curvature limit
/// permit.
std::vector<automaton::Trim> grid_trims(const Node& file, const vehicle::VehicleParameters& vehicle,
                                        const vehicle::VehicleLimits& limits) {
  const Node grid = file.map("trims");
  const std::vector<double> speeds =
      increasing_numbers(grid, "speeds_mps", above(0.0, limits.speed_max_mps));
  const std::vector<double> steering = increasing_numbers(
      grid, "steering_rad", between(-limits.steering_max_rad, limits.steering_max_rad));
  grid.check_no_unknown_keys();
  std::vector<automaton::Trim> trims{{}};
  for (const double speed_mps : speeds) {
    for (const double steering_rad : steering) {
      if (vehicle::is_within_friction({{}, speed_mps, steering_rad}, {}, vehicle, limits) &&
          vehicle::is_within_curvature({{}, speed_mps, steering_rad}, {}, vehicle, limits)) {
        trims.push_back({speed_mps, steering_rad});
      }
    }
  }
  return trims;
}

std::vector<automaton::Trim> read_trims(const Node& file, const vehicle::VehicleParameters& vehicle,
                                        const vehicle::VehicleLimits& limits) {
  if (file.is_list("trims")) return listed_trims(file, vehicle, limits);
  if (!file.has("trims") || file.is_value("trims") || limits.speed_min_mps > 0.0) {
    file.fail("trims",
              "a list of {speed_mps, steering_rad}, one of speed 0 among them, or, with "
              "limits.speed_min_mps = 0, a grid {speeds_mps, steering_rad}");
  }
  return grid_trims(file, vehicle, limits);
}

void read_front_point(const Node& entry, LabelledCriterion& criterion) {
  FrontPoint point;
  point.minimised = entry.required<std::string>("minimise", one_of(criterion_names()));
  point.bounded = entry.required<std::string>("bound", one_of(criterion_names()));
  if (point.bounded == point.minimised) entry.fail("bound", "another criterion than `minimise`");
  point.share = entry.required<double>("share", between(0.0, 1.0));
  if (point.share == 0.0 || point.share == 1.0) {
    entry.fail("share", "a number between 0 and 1; the ends of the front are the criteria alone");
  }
  entry.check_no_unknown_keys();
  criterion.front_point = point;
}

LabelledCriterion read_criterion(const Node& entry) {
  LabelledCriterion criterion;
  if (!entry.is_map()) {
    criterion.label = entry.as<std::string>(one_of(criterion_names()));
    return criterion;
  }
  criterion.label = entry.required<std::string>("name");
  const std::vector<std::string> names = criterion_names();
  if (criterion.label.empty() || criterion.label == automaton::kSelfLoopLabel ||
      has_control_characters(criterion.label) ||
      std::find(names.begin(), names.end(), criterion.label) != names.end()) {
    entry.fail("name", fmt::format("one line of text and unique: neither empty, nor '{}', "
                                   "nor a criterion's",
                                   automaton::kSelfLoopLabel));
  }
  if (entry.has("minimise")) {
    read_front_point(entry, criterion);
    return criterion;
  }
  const Node weights = entry.map("weights");
  std::size_t positive = 0;
  for (const std::string& name : names) {
    if (!weights.has(name)) continue;
    criterion.weights.push_back({name, weights.required<double>(name, at_least(0.0))});
    if (criterion.weights.back().weight > 0.0) ++positive;
  }
  weights.check_no_unknown_keys();
  if (positive == 0) entry.fail("weights", "a map with at least one weight > 0");
  criterion.normalised = entry.optional("normalised", false);
  if (criterion.normalised && positive < 2) {
    entry.fail("normalised", "false with a single weight > 0");
  }
  entry.check_no_unknown_keys();
  return criterion;
}

std::vector<LabelledCriterion> read_criteria(const Node& file) {
  std::vector<LabelledCriterion> criteria;
  for (const Node& entry : file.list("criteria")) {
    LabelledCriterion criterion = read_criterion(entry);
    if (std::any_of(criteria.begin(), criteria.end(), [&](const LabelledCriterion& other) {
          return other.label == criterion.label;
        })) {
      entry.fail("unique");
    }
    criteria.push_back(std::move(criterion));
  }
  if (criteria.empty()) {
    file.fail("criteria", "a list with at least one criterion");
  }
  return criteria;
}

std::vector<std::string> labels_of(const std::vector<LabelledCriterion>& criteria) {
  std::vector<std::string> labels;
  for (const LabelledCriterion& criterion : criteria) labels.push_back(criterion.label);
  return labels;
}

ConfigurationPlaces places_of(const Node& file, const AutomatonConfiguration& configuration) {
  ConfigurationPlaces places;
  places.intervals = file.place("intervals");
  if (!file.has("intervals")) places.intervals += fmt::format(" = {}", configuration.intervals);
  for (const Node& entry : file.list("subgraphs")) {
    places.subgraphs.push_back(
        {entry.place("trims"), entry.has("max_speed_mps") ? entry.place("max_speed_mps") : ""});
  }
  return places;
}

}  // namespace

SelfLoops self_loops_named(const std::string& name) {
  const auto found = std::ranges::find(kSelfLoopNames, name);
  HLC_DEMAND(found != kSelfLoopNames.end());
  return static_cast<SelfLoops>(found - kSelfLoopNames.begin());
}

AutomatonConfiguration read_automaton_configuration(const std::filesystem::path& path) {
  const Node file = Node::read_yaml(path);
  AutomatonConfiguration configuration;
  configuration.source = path.string();
  const Node vehicle = file.map("vehicle");
  configuration.vehicle = automaton::read_vehicle(vehicle);
  configuration.limits = automaton::read_limits(file.map("limits"));
  configuration.identified =
      automaton::read_identified(vehicle, configuration.vehicle, configuration.limits);
  vehicle.check_no_unknown_keys();
  configuration.trims = read_trims(file, configuration.vehicle, configuration.limits);
  configuration.step_s = file.required<double>("step_s", above(0.0, 100.0));
  configuration.intervals =
      file.optional("intervals", configuration.intervals, between(10.0, 1000.0));
  configuration.horizon_steps =
      file.optional("horizon_steps", configuration.horizon_steps, between(1.0, 64.0));
  configuration.edges =
      file.optional<std::string>("edges", "subgraphs", one_of({"subgraphs", "all"})) == "all"
          ? EdgeChoice::kAll
          : EdgeChoice::kSubgraphs;
  configuration.self_loops = self_loops_named(
      file.optional<std::string>("own_steps", kSelfLoopNames.front(), one_of(kSelfLoopNames)));
  configuration.criteria = read_criteria(file);
  configuration.subgraphs = automaton::read_subgraphs(
      file, {configuration.trims, configuration.vehicle, configuration.limits, configuration.step_s,
             configuration.horizon_steps, labels_of(configuration.criteria)});
  configuration.places = places_of(file, configuration);
  file.check_no_unknown_keys();
  return configuration;
}

bool uses(const automaton::SubgraphSpec& subgraph, const std::string& label) {
  const auto holds = [&label](const std::vector<std::string>& labels) {
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  };
  return holds(subgraph.labels) ||
         std::any_of(subgraph.edges.begin(), subgraph.edges.end(),
                     [&](const automaton::EdgeLabels& edge) { return holds(edge.labels); });
}

AutomatonConfiguration needed_by(const automaton::SubgraphSpec& subgraph,
                                 AutomatonConfiguration configuration) {
  configuration.edges = EdgeChoice::kSubgraphs;
  std::erase_if(configuration.criteria, [&](const LabelledCriterion& criterion) {
    return !uses(subgraph, criterion.label);
  });
  std::vector<ConfigurationPlaces::Subgraph> places;
  for (std::size_t i = 0; i < configuration.places.subgraphs.size(); ++i) {
    const bool is_it = configuration.subgraphs[i].name == subgraph.name;
    if (is_it) places.push_back(configuration.places.subgraphs[i]);
  }
  configuration.places.subgraphs = std::move(places);
  configuration.subgraphs = {subgraph};
  return configuration;
}

}  // namespace hlc::maneuver_design
