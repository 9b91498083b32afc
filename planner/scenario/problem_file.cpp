#include "planner/scenario/problem_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/common/atomic_write.hpp"
#include "planner/common/json_reader.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/named_subgraph.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/search_options.hpp"

namespace hlc {
namespace {

/// A vertex of a polygon may lie this far inside the line of its neighbours: rounding.
constexpr double kConvexTolerance_m = 1e-9;
constexpr double kSmallestArea_m2 = 1e-12;

// ---- writing

std::string number(double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument("a problem with a number that is not finite cannot be written");
  }
  std::string text = shortest_text(value);
  return text == "-0" ? "-0.0" : text;  // -0 reads back as the whole number 0
}

std::string point(const Point& at_m) {
  return "[" + number(at_m.x()) + ", " + number(at_m.y()) + "]";
}

template <class Items, class Write>
std::string list(const Items& items, const std::string& separator, Write write) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : separator) + write(item);
  return "[" + text + "]";
}

std::string polygon(const ConvexPolygon& area_m) { return list(area_m.vertices_m, ", ", point); }

std::string step_obstacles(const std::vector<ConvexPolygon>& areas_m) {
  std::vector<ConvexPolygon> there;
  std::ranges::remove_copy_if(areas_m, std::back_inserter(there), &ConvexPolygon::empty);
  return list(there, ", ", polygon);
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

// ---- reading

double read_coordinate(const JsonPlace& place) {
  const double value_m = place.number();
  if (std::abs(value_m) > HorizonProblem::kLargest_m) place.fail("numbers from -1e9 to 1e9");
  return value_m;
}

double read_heading(const JsonPlace& place) {
  const double value_rad = place.number();
  if (std::abs(value_rad) > HorizonProblem::kLargestHeading_rad) {
    place.fail("numbers from -1e6 to 1e6");
  }
  return value_rad;
}

Point read_point(const JsonPlace& place) {
  const auto xy = place.list("[x, y]", 2);
  return {read_coordinate(xy[0]), read_coordinate(xy[1])};
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double signed_area_m2(const ConvexPolygon::Vertices& vertices_m) {
  double twice_m2 = 0.0;
  for (std::size_t i = 2; i < vertices_m.size(); ++i) {
    twice_m2 += cross(vertices_m[i - 1] - vertices_m[0], vertices_m[i] - vertices_m[0]);
  }
  return 0.5 * twice_m2;
}

struct Turns {
  bool left{};
  bool right{};
  double sum_rad{};  ///< 2 pi: once around, counter-clockwise
};

Turns turns_of(const ConvexPolygon::Vertices& vertices_m) {
  const std::size_t n = vertices_m.size();
  Turns turns;
  for (std::size_t i = 0; i < n; ++i) {
    const Point to = vertices_m[(i + 1) % n] - vertices_m[i];
    const Point next = vertices_m[(i + 2) % n] - vertices_m[(i + 1) % n];
    const double turn = cross(to, next);
    const double tolerance = kConvexTolerance_m * std::max(to.norm(), next.norm());
    turns.left = turns.left || turn > tolerance;
    turns.right = turns.right || turn < -tolerance;
    turns.sum_rad += std::atan2(turn, to.dot(next));
  }
  return turns;
}

ConvexPolygon read_polygon(const JsonPlace& place) {
  ConvexPolygon area_m;
  ConvexPolygon::Vertices& vertices = area_m.vertices_m;
  for (const JsonPlace& vertex : place.list("a list of vertices [x, y]")) {
    vertices.push_back(read_point(vertex));
  }
  if (vertices.size() < 3) place.fail("a convex polygon of at least 3 vertices");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] == vertices[(i + 1) % vertices.size()]) {
      place.fail("a convex polygon whose vertices differ, the first not repeated at the end");
    }
  }
  const Turns turns = turns_of(vertices);
  if (turns.left && turns.right) {
    place.fail("a convex polygon, its vertices in order: this one turns both left and right");
  }
  const double area_m2 = signed_area_m2(vertices);
  if (!(std::abs(area_m2) >= kSmallestArea_m2)) {
    place.fail("a convex polygon with an area of at least 1e-12 m^2");
  }
  if (area_m2 < 0.0) std::ranges::reverse(vertices);
  if (std::abs(std::abs(turns.sum_rad) - 2.0 * std::numbers::pi) >= 1e-3) {
    place.fail("a convex polygon, its vertices in order: this one crosses itself");
  }
  return area_m;
}

Segment read_segment(const JsonPlace& place) {
  const auto ends = place.list("[[x1, y1], [x2, y2]]", 2);
  return {read_point(ends[0]), read_point(ends[1])};
}

TrimId read_trim(const JsonPlace& place, const Subgraph& subgraph) {
  return {place.whole(1, subgraph.automaton().trims.size()) - 1};
}

void read_start(const JsonPlace& place, const Subgraph& subgraph, HorizonProblem& problem) {
  place.check_keys({"x", "y", "psi", "trim"});
  problem.start.x_m = read_coordinate(place.at("x", "a finite number"));
  problem.start.y_m = read_coordinate(place.at("y", "a finite number"));
  problem.start.heading_rad = read_heading(place.at("psi", "a finite number"));
  problem.start_trim = read_trim(place.at("trim", "the number of a trim, from 1"), subgraph);
}

/// A maneuver of the whole automaton: a plan in force may hold what is off by now.
std::vector<const Maneuver*> read_incumbent(const JsonPlace& place, const Subgraph& subgraph,
                                            const HorizonProblem& problem) {
  std::vector<const Maneuver*> incumbent;
  TrimId from = problem.start_trim;
  for (const JsonPlace& entry : place.list("one {trim, label} per step", problem.horizon_steps())) {
    entry.check_keys({"trim", "label"});
    const TrimId to = read_trim(entry.at("trim", "the number of a trim, from 1"), subgraph);
    const std::string label =
        entry.at("label", "the label of a maneuver").text("the label of a maneuver");
    const Maneuver* maneuver = subgraph.automaton().find(from, to, label);
    if (maneuver == nullptr) {
      entry.fail("a maneuver of the automaton from trim " + std::to_string(from.index + 1));
    }
    incumbent.push_back(maneuver);
    from = to;
  }
  return incumbent;
}

std::vector<PlanningWeight> read_weights(const JsonPlace& place, const Subgraph& subgraph) {
  const std::vector<std::string> known = criteria_of(subgraph);
  std::vector<PlanningWeight> weights;
  for (const std::string& criterion : place.keys()) {
    const std::string range = "a number from 0 to 1e9";
    const JsonPlace weight = place.at(criterion, range);
    if (std::ranges::find(known, criterion) == known.end()) {
      std::string allowed = "criteria of the automaton's maneuvers:";
      for (const std::string& name : known) allowed += " " + name;
      weight.fail(allowed);
    }
    weights.push_back({criterion, weight.number(0.0, SearchOptions::kMostWeight_m2, range)});
  }
  return weights;
}

std::string weights_text(const std::vector<PlanningWeight>& weights) {
  std::string text;
  for (const auto& [criterion, weight_m2] : weights) {
    text += (text.empty() ? "" : ", ") + quoted(criterion) + ": " + shortest_text(weight_m2);
  }
  return "{" + text + "}";
}

SearchOptions read_search(const JsonPlace& place, const Subgraph& subgraph) {
  place.check_keys({"engine", "cost_to_go", "max_expansions", "criterion_weights"});
  SearchOptions search;
  if (const auto engine = place.find("engine")) {
    try {
      choose_engine(engine->text(kEngineChoices), search);
    } catch (const std::invalid_argument&) {
      engine->fail(kEngineChoices);
    }
  }
  if (const auto cost_to_go = place.find("cost_to_go")) {
    try {
      search.cost_to_go = cost_to_go_from_name(cost_to_go->text(kCostToGoNames));
    } catch (const std::invalid_argument&) {
      cost_to_go->fail(kCostToGoNames);
    }
  }
  if (const auto budget = place.find("max_expansions")) {
    search.max_expansions = budget->whole(1, SearchOptions::kMostExpansions);
  }
  if (const auto weights = place.find("criterion_weights")) {
    search.criterion_weights = read_weights(*weights, subgraph);
  }
  return search;
}

HorizonProblem read_problem(const JsonPlace& root, const Subgraph& subgraph) {
  HorizonProblem problem;
  const std::size_t n =
      root.at("horizon_steps", "a whole number from 1 to 64").whole(1, kMaxProblemSteps);
  const std::string per_step = "one per step, " + std::to_string(n) + " of them (horizon_steps)";
  const std::string step_s = shortest_text(subgraph.automaton().step_s) + ", the automaton's";
  const JsonPlace step = root.at("step_s", step_s);
  if (step.number() != subgraph.automaton().step_s) step.fail(step_s);
  read_start(root.at("start", "{x, y, psi, trim}"), subgraph, problem);
  for (const JsonPlace& entry : root.at("reference", per_step).list(per_step, n)) {
    problem.reference_m.push_back(read_point(entry));
  }
  if (const auto speeds = root.find("reference_speed")) {
    for (const JsonPlace& entry : speeds->list(per_step, n)) {
      problem.reference_speed_mps.push_back(
          entry.number(0.0, std::numeric_limits<double>::max(), "a finite number, at least 0"));
    }
  }
  if (const auto obstacles = root.find("obstacles")) {
    for (const JsonPlace& entry : obstacles->list(per_step, n)) {
      auto& areas_m = problem.obstacles_m.emplace_back();
      for (const JsonPlace& area : entry.list("a list of polygons")) {
        areas_m.push_back(read_polygon(area));
      }
    }
  }
  if (const auto corridor = root.find("corridor")) {
    for (const JsonPlace& entry : corridor->list("a list of segments [[x1, y1], [x2, y2]]")) {
      problem.boundary_m.push_back(read_segment(entry));
    }
  }
  if (const auto avoids = root.find("avoids_steering_limit")) {
    problem.avoids_steering_limit = avoids->truth();
  }
  if (const auto incumbent = root.find("incumbent")) {
    problem.incumbent = read_incumbent(*incumbent, subgraph, problem);
  }
  return problem;
}

void check_keys(const JsonPlace& root) {
  root.check_keys({"automaton", "subgraph", "horizon_steps", "step_s", "start", "reference",
                   "reference_speed", "obstacles", "corridor", "avoids_steering_limit", "incumbent",
                   "search"});
}

std::filesystem::path automaton_of(const JsonPlace& root, const std::filesystem::path& path) {
  const std::string allowed = "the path of an automaton or configuration file";
  const JsonPlace place = root.at("automaton", allowed);
  const std::string written = place.text(allowed);
  if (written.empty()) place.fail(allowed);
  return (path.parent_path() / written).lexically_normal();
}

ProblemFile read_rest(const JsonPlace& root, std::filesystem::path automaton_file,
                      std::shared_ptr<const Subgraph> subgraph) {
  ProblemFile file;
  file.automaton_file = std::move(automaton_file);
  file.subgraph = std::move(subgraph);
  file.problem = read_problem(root, *file.subgraph);
  if (const auto search = root.find("search")) file.search = read_search(*search, *file.subgraph);
  return file;
}

}  // namespace

std::string to_text(const ProblemFile& file) {
  const HorizonProblem& problem = file.problem;
  std::string text = "{";
  const auto add = [&text](const char* key, const std::string& value) {
    text += (text.size() == 1 ? "\n  \"" : ",\n  \"") + std::string(key) + "\": " + value;
  };
  add("automaton", quoted(file.automaton_file.string()));
  add("subgraph", quoted(file.subgraph->spec().name));
  add("horizon_steps", std::to_string(problem.horizon_steps()));
  add("step_s", number(file.subgraph->automaton().step_s));
  add("start", "{\"x\": " + number(problem.start.x_m) + ", \"y\": " + number(problem.start.y_m) +
                   ", \"psi\": " + number(problem.start.heading_rad) +
                   ", \"trim\": " + std::to_string(problem.start_trim.index + 1) + "}");
  add("reference", list(problem.reference_m, ", ", point));
  if (!problem.reference_speed_mps.empty()) {
    add("reference_speed", list(problem.reference_speed_mps, ", ", number));
  }
  if (!problem.obstacles_m.empty()) {
    add("obstacles", list(problem.obstacles_m, ",\n    ", step_obstacles));
  }
  if (!problem.boundary_m.empty()) {
    add("corridor", list(problem.boundary_m, ",\n    ", [](const Segment& segment) {
          return "[" + point(segment.from_m) + ", " + point(segment.to_m) + "]";
        }));
  }
  if (problem.avoids_steering_limit) add("avoids_steering_limit", "true");
  if (!problem.incumbent.empty()) {
    add("incumbent", list(problem.incumbent, ", ", [](const Maneuver* maneuver) {
          return "{\"trim\": " + std::to_string(maneuver->to.index + 1) +
                 ", \"label\": " + quoted(maneuver->label) + "}";
        }));
  }
  add("search",
      std::string("{\"engine\": \"") + engine_name(file.search) + "\", \"cost_to_go\": \"" +
          to_string(file.search.cost_to_go) +
          "\", \"max_expansions\": " + std::to_string(file.search.max_expansions) +
          (file.search.criterion_weights.empty()
               ? ""
               : ", \"criterion_weights\": " + weights_text(file.search.criterion_weights)) +
          "}");
  return text + "\n}\n";
}

void write_problem_file(const ProblemFile& file, const std::filesystem::path& path) {
  write_atomically(to_text(file), path);
}

ProblemFile read_problem_file(const std::filesystem::path& path,
                              const std::optional<std::filesystem::path>& automaton_file) {
  const std::string name = path.string();
  const nlohmann::json document = read_json(path);
  const JsonPlace root(name, "", document);
  check_keys(root);
  const std::filesystem::path automaton =
      automaton_file ? *automaton_file : automaton_of(root, path);
  const std::string allowed = "the name of a subgraph of the automaton";
  const JsonPlace subgraph = root.at("subgraph", allowed);
  const std::string wanted = subgraph.text(allowed);
  bool is_unknown = false;
  const auto choose = [&](const std::vector<SubgraphSpec>& offered) -> const SubgraphSpec& {
    const SubgraphSpec* spec = find_subgraph(offered, wanted);
    is_unknown = spec == nullptr;
    if (is_unknown) subgraph.fail(names_of(offered));
    return *spec;
  };
  const auto read = [&] {
    try {
      return read_subgraph(automaton, choose);
    } catch (const std::invalid_argument& error) {
      if (is_unknown) throw;  // names the problem's file
      if (!automaton_file) root.at("automaton", "").fail_because(error.what());
      throw std::invalid_argument(name + ": with the automaton of " + automaton.string() + ": " +
                                  error.what());
    }
  };
  return read_rest(root, automaton, read());
}

ProblemFile read_problem_file(const std::filesystem::path& path,
                              std::shared_ptr<const Subgraph> subgraph) {
  const std::string name = path.string();
  const nlohmann::json document = read_json(path);
  const JsonPlace root(name, "", document);
  check_keys(root);
  const JsonPlace written = root.at("subgraph", subgraph->spec().name);
  if (written.text(subgraph->spec().name) != subgraph->spec().name) {
    written.fail(subgraph->spec().name);
  }
  return read_rest(root, automaton_of(root, path), std::move(subgraph));
}

void check_can_be_searched(const ProblemFile& file) {
  check_search_options(file.search);
  if (needs_reference_speeds(file.search.cost_to_go) && file.problem.reference_speed_mps.empty()) {
    throw std::invalid_argument(
        std::string("reference_speed is missing, allowed one per step: the cost-to-go ") +
        to_string(file.search.cost_to_go) + " needs them");
  }
}

}  // namespace hlc
