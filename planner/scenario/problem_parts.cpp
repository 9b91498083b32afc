#include "planner/scenario/problem_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/common/yaml_text.hpp"
#include "planner/geometry/cross.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/named_subgraph.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/scenario/search_values.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {
namespace {

/// A vertex of a polygon may lie this far inside the line of its neighbours: rounding.
constexpr double kConvexTolerance_m = 1e-9;
constexpr double kSmallestArea_m2 = 1e-12;

// ---- writing

/// JSON has no number that is not finite.
double number(double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument("a problem with a number that is not finite cannot be written");
  }
  return value;
}

Json point(const Point& at_m) { return Json::array({number(at_m.x()), number(at_m.y())}); }

template <class Items, class Write>
Json list(const Items& items, Write write) {
  Json values = Json::array();
  for (const auto& item : items) values.push_back(write(item));
  return values;
}

Json step_obstacles(const std::vector<ConvexPolygon>& areas_m) {
  Json polygons = Json::array();
  for (const ConvexPolygon& area_m : areas_m) {
    if (!area_m.empty()) polygons.push_back(list(area_m.vertices_m, point));
  }
  return polygons;
}

// ---- reading

const Allowed kCoordinates =
    between(-search::HorizonProblem::kLargest_m, search::HorizonProblem::kLargest_m);
const Allowed kHeadings = between(-search::HorizonProblem::kLargestHeading_rad,
                                  search::HorizonProblem::kLargestHeading_rad);

Point read_point(const Node& node) {
  const auto xy = node.entries(2, "[x, y]");
  return {xy[0].as<double>(kCoordinates), xy[1].as<double>(kCoordinates)};
}

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

ConvexPolygon read_ordered_polygon(const Node& node) {
  ConvexPolygon area_m;
  ConvexPolygon::Vertices& vertices = area_m.vertices_m;
  for (const Node& vertex : node.entries()) {
    vertices.push_back(read_point(vertex));
  }
  if (vertices.size() < 3) node.fail("a convex polygon of at least 3 vertices");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] == vertices[(i + 1) % vertices.size()]) {
      node.fail("a convex polygon whose vertices differ, the first not repeated at the end");
    }
  }
  const Turns turns = turns_of(vertices);
  if (turns.left && turns.right) {
    node.fail("a convex polygon, its vertices in order: this one turns both left and right");
  }
  const double area_m2 = signed_area_m2(vertices);
  if (!(std::abs(area_m2) >= kSmallestArea_m2)) {
    node.fail("a convex polygon with an area of at least 1e-12 m^2");
  }
  if (area_m2 < 0.0) std::ranges::reverse(vertices);
  if (std::abs(std::abs(turns.sum_rad) - 2.0 * std::numbers::pi) >= 1e-3) {
    node.fail("a convex polygon, its vertices in order: this one crosses itself");
  }
  return area_m;
}

Segment read_segment(const Node& node) {
  const auto ends = node.entries(2, "[[x1, y1], [x2, y2]]");
  return {read_point(ends[0]), read_point(ends[1])};
}

TrimId read_trim(const Node& node, const automaton::Subgraph& subgraph) {
  const auto trims = static_cast<double>(subgraph.automaton().trims.size());
  return {node.required<std::size_t>("trim", between(1.0, trims)) - 1};
}

void read_start(const Node& node, const automaton::Subgraph& subgraph,
                search::HorizonProblem& problem) {
  node.check_keys({"x", "y", "psi", "trim"});
  problem.start.x_m = node.required<double>("x", kCoordinates);
  problem.start.y_m = node.required<double>("y", kCoordinates);
  problem.start.heading_rad = node.required<double>("psi", kHeadings);
  problem.start_trim = read_trim(node, subgraph);
}

/// A maneuver of the whole automaton: a plan in force may hold disabled ones.
std::vector<const automaton::Maneuver*> read_incumbent(const Node& root,
                                                       const automaton::Subgraph& subgraph,
                                                       const search::HorizonProblem& problem) {
  std::vector<const automaton::Maneuver*> incumbent;
  TrimId from = problem.start_trim;
  for (const Node& entry :
       root.optional_list("incumbent", problem.horizon_steps(), "one {trim, label} per step")) {
    entry.check_keys({"trim", "label"});
    const TrimId to = read_trim(entry, subgraph);
    const automaton::Maneuver* maneuver =
        subgraph.automaton().find(from, to, entry.required<std::string>("label"));
    if (maneuver == nullptr) {
      entry.fail(fmt::format("a maneuver of the automaton from trim {}", from.index + 1));
    }
    incumbent.push_back(maneuver);
    from = to;
  }
  return incumbent;
}

search::SearchOptions read_search(const Node& node, const automaton::Subgraph& subgraph) {
  node.check_keys({"engine", "cost_to_go", "max_expansions", "criterion_weights"});
  search::SearchOptions search;
  if (const auto engine = read_engine(node)) choose_engine(*engine, search);
  if (node.has("cost_to_go")) {
    search.cost_to_go =
        read_named(node, "cost_to_go", search::cost_to_go_from_name, search::kCostToGoNames);
  }
  search.max_expansions = read_max_expansions(node);
  search.criterion_weights = read_criterion_weights(node);
  check_criterion_weights(node, search.criterion_weights, subgraph);
  return search;
}

std::filesystem::path automaton_of(const Node& root, const std::filesystem::path& path) {
  const auto written = root.required<std::string>("automaton");
  if (written.empty()) root.fail("automaton", "the path of an automaton or configuration file");
  return (path.parent_path() / written).lexically_normal();
}

/// After `automaton_file` and `subgraph`.
void read_steps_and_search(const Node& root, ProblemFrame& frame) {
  frame.horizon_steps = root.required<std::size_t>("horizon_steps", between(1.0, kMaxProblemSteps));
  const double step_s = frame.subgraph->automaton().step_s;
  if (root.required<double>("step_s") != step_s) {
    root.fail("step_s", shortest_text(step_s) + ", the automaton's");
  }
  if (root.has("search")) frame.search = read_search(root.map("search"), *frame.subgraph);
}

std::shared_ptr<const automaton::Subgraph> read_named_subgraph(
    const Node& root, const std::filesystem::path& path, const std::filesystem::path& automaton,
    bool is_given) {
  const auto wanted = root.required<std::string>("subgraph");
  bool is_unknown = false;
  const auto choose =
      [&](const std::vector<automaton::SubgraphSpec>& offered) -> const automaton::SubgraphSpec& {
    const automaton::SubgraphSpec* spec = find_subgraph(offered, wanted);
    is_unknown = spec == nullptr;
    if (is_unknown) root.fail("subgraph", "one of " + names_of(offered));
    return *spec;
  };
  try {
    return read_subgraph(automaton, choose);
  } catch (const std::invalid_argument& error) {
    if (is_unknown) throw;  // names the problem's file
    throw std::invalid_argument(fmt::format(
        "{}: {}",
        is_given ? fmt::format("{}: with the automaton of {}", path.string(), automaton.string())
                 : root.place("automaton"),
        error.what()));
  }
}

}  // namespace

ProblemFrame read_frame(const Node& root, const std::filesystem::path& path,
                        const std::optional<std::filesystem::path>& automaton_file) {
  ProblemFrame frame;
  frame.automaton_file = automaton_file ? *automaton_file : automaton_of(root, path);
  frame.subgraph =
      read_named_subgraph(root, path, frame.automaton_file, automaton_file.has_value());
  read_steps_and_search(root, frame);
  return frame;
}

ProblemFrame read_frame(const Node& root, const std::filesystem::path& path,
                        std::shared_ptr<const automaton::Subgraph> subgraph) {
  static_cast<void>(root.required<std::string>("subgraph", one_of({subgraph->spec().name})));
  ProblemFrame frame{.automaton_file = automaton_of(root, path), .subgraph = std::move(subgraph)};
  read_steps_and_search(root, frame);
  return frame;
}

search::HorizonProblem read_problem(const Node& node, const ProblemFrame& frame) {
  const std::size_t n = frame.horizon_steps;
  const std::string per_step = fmt::format("one per step, {} of them (horizon_steps)", n);
  search::HorizonProblem problem;
  read_start(node.map("start"), *frame.subgraph, problem);
  for (const Node& entry : node.list("reference", n, per_step)) {
    problem.reference_m.push_back(read_point(entry));
  }
  for (const Node& entry : node.optional_list("contouring", n, per_step)) {
    problem.contouring.push_back(read_point(entry));
  }
  for (const Node& entry : node.optional_list("reference_speed", n, per_step)) {
    problem.reference_speed_mps.push_back(entry.as<double>(at_least(0.0)));
  }
  for (const Node& entry : node.optional_list("obstacles", n, per_step)) {
    auto& areas_m = problem.obstacles_m.emplace_back();
    for (const Node& area : entry.entries()) areas_m.push_back(read_ordered_polygon(area));
  }
  for (const Node& entry : node.optional_list("avoided_in_motion", n, per_step)) {
    auto& areas_m = problem.avoided_in_motion_m.emplace_back();
    for (const Node& area : entry.entries()) areas_m.push_back(read_ordered_polygon(area));
  }
  for (const Node& entry : node.optional_list("corridor")) {
    problem.boundary_m.push_back(read_segment(entry));
  }
  problem.avoids_steering_limit = node.optional<bool>("avoids_steering_limit", false);
  problem.incumbent = read_incumbent(node, *frame.subgraph, problem);
  return problem;
}

void write_frame(const ProblemFrame& frame, Json& root) {
  root["automaton"] = frame.automaton_file.string();
  root["subgraph"] = frame.subgraph->spec().name;
  root["horizon_steps"] = frame.horizon_steps;
  root["step_s"] = number(frame.subgraph->automaton().step_s);
}

void write_problem(const search::HorizonProblem& problem, Json& root) {
  root["start"] = {{"x", number(problem.start.x_m)},
                   {"y", number(problem.start.y_m)},
                   {"psi", number(problem.start.heading_rad)},
                   {"trim", problem.start_trim.index + 1}};
  root["reference"] = list(problem.reference_m, point);
  if (!problem.contouring.empty()) root["contouring"] = list(problem.contouring, point);
  if (!problem.reference_speed_mps.empty()) {
    root["reference_speed"] = list(problem.reference_speed_mps, number);
  }
  if (!problem.obstacles_m.empty()) root["obstacles"] = list(problem.obstacles_m, step_obstacles);
  if (!problem.avoided_in_motion_m.empty()) {
    root["avoided_in_motion"] = list(problem.avoided_in_motion_m, step_obstacles);
  }
  if (!problem.boundary_m.empty()) {
    root["corridor"] = list(problem.boundary_m, [](const Segment& segment) {
      return Json::array({point(segment.from_m), point(segment.to_m)});
    });
  }
  if (problem.avoids_steering_limit) root["avoids_steering_limit"] = true;
  for (const automaton::Maneuver* maneuver : problem.incumbent) {
    root["incumbent"].push_back({{"trim", maneuver->to.index + 1}, {"label", maneuver->label}});
  }
}

void write_search(const search::SearchOptions& search, Json& root) {
  Json& options = root["search"];
  options = {{"engine", engine_name(search)},
             {"cost_to_go", search::to_string(search.cost_to_go)},
             {"max_expansions", search.max_expansions}};
  for (const auto& [criterion, weight_m2] : search.criterion_weights) {
    options["criterion_weights"][criterion] = number(weight_m2);
  }
}

std::string text_of(const Json& root) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : root.items()) {
    lines.push_back(fmt::format("  \"{}\": {}", key, value.dump()));
  }
  return fmt::format("{{\n{}\n}}\n", fmt::join(lines, ",\n"));
}

}  // namespace hlc::scenario
