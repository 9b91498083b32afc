#include "planner/scenario/commonroad_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "planner/common/text_file.hpp"
#include "planner/common/value_tree.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/lanelets_for_cars.hpp"
#include "planner/road/map_obstacles.hpp"
#include "planner/road/planning_problem.hpp"
#include "planner/road/way_to_goal.hpp"
#include "planner/scenario/scenario_assembly.hpp"
#include "planner/scenario/scenario_inputs.hpp"
#include "planner/scenario/scenario_values.hpp"

namespace hlc::scenario {
namespace {

/// As many as the lab has ids for.
constexpr std::size_t kMostProblems = 30;

/// Keys of a scenario that hold its places and vehicles, or that the import sets.
constexpr std::array kNotTaken{"name",     "steps",  "automaton",    "lab",
                               "map",      "routes", "vehicles",     "draw",
                               "circle",   "seed",   "guests",       "obstacles",
                               "policies", "policy", "right_of_way", "right_of_way_order"};

/// A value of a YAML file in one line. Its reader takes a text of digits for a number.
std::string flow_text(const Value& value) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < value.values.size(); ++i) {
    const std::string part = flow_text(value.values[i]);
    parts.push_back(value.kind == Value::Kind::kMap ? quoted_yaml(value.keys[i]) + ": " + part
                                                    : part);
  }
  if (value.kind == Value::Kind::kMap) return fmt::format("{{{}}}", fmt::join(parts, ", "));
  if (value.kind == Value::Kind::kList) return fmt::format("[{}]", fmt::join(parts, ", "));
  if (value.kind == Value::Kind::kNothing) return "null";
  constexpr std::string_view kPlain = "._+-";
  const bool is_plain =
      !value.text.empty() && value.text != "-" && std::ranges::all_of(value.text, [&](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || kPlain.find(c) != kPlain.npos;
      });
  return is_plain ? value.text : quoted_yaml(value.text);
}

std::string taken_keys(const std::filesystem::path& like) {
  const Value keys = parse_yaml(read_file(like, kMostInputBytes), like.string());
  std::string text;
  for (std::size_t i = 0; i < keys.keys.size(); ++i) {
    const std::string& key = keys.keys[i];
    if (std::ranges::find(kNotTaken, key) != kNotTaken.end()) continue;
    text += fmt::format("{}: {}\n", key, flow_text(keys.values[i]));
  }
  return text;
}

/// Relative to the scenario's folder if the file lies in it or beside it: they can move together.
std::string quoted_path(const std::filesystem::path& file, const std::filesystem::path& scenario) {
  const std::filesystem::path full = std::filesystem::absolute(file).lexically_normal();
  const std::filesystem::path folder =
      std::filesystem::absolute(scenario).lexically_normal().parent_path();
  const std::filesystem::path near = full.lexically_relative(folder);
  return quoted_yaml((near.string().starts_with("../..") ? full : near).string());
}

/// Text of a goal's corners.
std::string corners_text(const ConvexPolygon& area_m) {
  std::vector<std::string> corners;
  for (const Point& corner : area_m.vertices_m) {
    corners.push_back(
        fmt::format("[{}, {}]", shortest_text(corner.x()), shortest_text(corner.y())));
  }
  return fmt::format("[{}]", fmt::join(corners, ", "));
}

/// Reads and checks one file.
class Importer {
 public:
  explicit Importer(const CommonRoadImport& import)
      : import_(import),
        xml_(read_regular_file(import.file, "a CommonRoad file (2020a or 2018b)")),
        name_(import.file.string()),
        for_cars_(road::parse_lanelets_for_cars(xml_, name_)),
        map_(road::parse_lanelet_map(xml_, name_)),
        problems_(road::parse_planning_problems(xml_, name_)),
        like_(read_scenario({.file = import.like})) {
    static_cast<void>(road::parse_map_obstacles(xml_, name_));
    if (problems_.size() > kMostProblems) {
      fail(fmt::format("planning problems = {}, must be <= {}", problems_.size(), kMostProblems));
    }
    for (const road::PlanningProblem& problem : problems_) {
      check_standing(problem);
      try {
        ways_.push_back(road::way_to_goal(map_, for_cars_, problem,
                                          like_.subgraph->automaton().vehicle.footprint));
      } catch (const std::runtime_error& error) {
        fail(error.what());
      }
    }
  }

  /// Of the vehicles.
  [[nodiscard]] const automaton::Subgraph& subgraph() const { return *like_.subgraph; }

  [[nodiscard]] std::string text() const {
    std::string text = fmt::format(
        "# The planning problems of {}, driven by the vehicles of {}.\n"
        "name: {}\nsteps: {}\nmap: {}\nautomaton: {}\n",
        one_line(name_), one_line(import_.like.string()), quoted_yaml(map_.benchmark_id), steps(),
        quoted_path(import_.file, import_.out), quoted_path(like_.automaton_file, import_.out));
    if (like_.lab_file) text += fmt::format("lab: {}\n", quoted_path(*like_.lab_file, import_.out));
    text += taken_keys(import_.like) + "\nroutes:\n";
    for (std::size_t i = 0; i < ways_.size(); ++i) text += route_text(i);
    text += "\nvehicles:\n";
    for (std::size_t i = 0; i < ways_.size(); ++i) text += vehicle_text(i);
    return text;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}: {}", name_, what));
  }

  void check_standing(const road::PlanningProblem& problem) const {
    if (import_.from_standstill) return;
    const auto check = [&](const char* what, double value, const char* unit) {
      if (value == 0.0) return;
      fail(
          fmt::format("planning problem {}: {} of the initial state is {} {}, must be 0: vehicles "
                      "begin standing; with --from_standstill true this one does, too",
                      problem.id, what, value, unit));
    };
    check("velocity", problem.speed_mps, "m/s");
    check("acceleration", problem.acceleration_mps2, "m/s^2");
    check("yawRate", problem.yaw_rate_radps, "rad/s");
    check("slipAngle", problem.slip_angle_rad, "rad");
  }

  [[nodiscard]] const road::GoalState& goal_of(std::size_t i) const {
    return problems_[i].goals[ways_[i].goal_state];
  }

  [[nodiscard]] std::size_t steps() const {
    const double step_s = like_.subgraph->automaton().step_s;
    double end_s = static_cast<double>(kMostImportedSteps) * step_s;
    for (std::size_t i = 0; i < ways_.size(); ++i) end_s = std::min(end_s, goal_of(i).time_s.to);
    const double steps = std::floor(end_s / step_s + kRounding);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const road::Interval time_s = goal_of(i).time_s;
      const double run_s = steps * step_s;
      if (steps >= 1.0 && time_s.from <= run_s + kRounding) continue;
      fail(
          fmt::format("planning problem {}: time of the goal state is in {} ... {} s, must end "
                      "after the first step of {} s and begin before the run's end, {} s: the "
                      "earliest end of all goals and {} steps",
                      problems_[i].id, time_s.from, time_s.to, step_s, run_s, kMostImportedSteps));
    }
    return static_cast<std::size_t>(steps);
  }

  [[nodiscard]] std::string name_of(std::size_t i) const {
    return fmt::format("\"problem {}\"", problems_[i].id);
  }

  [[nodiscard]] std::string route_text(std::size_t i) const {
    return fmt::format("  - {{name: {}, closed: false, lanelets: {{{}: [{}]}}}}\n", name_of(i),
                       quoted_yaml(map_.benchmark_id), fmt::join(ways_[i].lanelets, ", "));
  }

  [[nodiscard]] std::string vehicle_text(std::size_t i) const {
    const road::WayToGoal& way = ways_[i];
    return fmt::format(
        "  - {{id: {}, name: {}, route: {}, start_m: {}, start_left_m: {}, start_turned_rad: {},\n"
        "     goal: {{polygon: {}}}}}\n",
        i + 1, name_of(i), name_of(i), shortest_text(way.start_s_m),
        shortest_text(way.start_left_m), shortest_text(way.start_turned_rad),
        corners_text(way.goal_m));
  }

  /// A time is a multiple of a step up to this.
  static constexpr double kRounding = 1e-9;

  CommonRoadImport import_;
  std::string xml_;
  std::string name_;
  std::set<road::LaneletId> for_cars_;
  road::LaneletMap map_;
  std::vector<road::PlanningProblem> problems_;
  Scenario like_;
  std::vector<road::WayToGoal> ways_;
};

}  // namespace

ImportedScenario scenario_from_commonroad(const CommonRoadImport& import) {
  const Importer importer(import);
  ImportedScenario imported{.text = importer.text(), .scenario = {}};
  const ScenarioChoices choices{.file = import.out};
  try {
    const ScenarioValues values =
        parse_scenario(Node::parse_yaml(imported.text, "as a scenario"), import.out);
    const automaton::Subgraph& subgraph = importer.subgraph();
    imported.scenario = assemble_scenario(
        values, load_inputs(values, choices, subgraph.shared_automaton(), {subgraph.spec()}),
        choices);
  } catch (const std::exception& error) {
    throw std::invalid_argument(fmt::format("{}: {}", import.file.string(), error.what()));
  }
  return imported;
}

}  // namespace hlc::scenario
