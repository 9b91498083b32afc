#include "tests/benchmarks/plain_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>
#include <span>

namespace hlc::test {
namespace {

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `vector` turned by the angle whose cosine and sine are `turn`.
Point turned(const Point& vector, const Point& turn) {
  return {turn.x() * vector.x() - turn.y() * vector.y(),
          turn.y() * vector.x() + turn.x() * vector.y()};
}

/// True if all of `points_m` lie outside one edge of the convex polygon `corners_m`.
template <class Points>
bool is_beyond_an_edge(std::span<const Point> corners_m, const Points& points_m) {
  const Point* from = &corners_m.back();
  for (const Point& to : corners_m) {
    const Point edge = to - *from;
    const auto is_outside = [&](const Point& point) { return cross(edge, point - *from) <= 0.0; };
    if (std::ranges::all_of(points_m, is_outside)) return true;
    from = &to;
  }
  return false;
}

bool meet(std::span<const Point> a_m, std::span<const Point> b_m) {
  return !is_beyond_an_edge(a_m, b_m) && !is_beyond_an_edge(b_m, a_m);
}

bool meet(std::span<const Point> corners_m, const Segment& segment) {
  const Point along = segment.to_m - segment.from_m;
  const auto side = [&](const Point& corner) { return cross(along, corner - segment.from_m); };
  // A segment of one point has no sides; only the edges can keep it out.
  const bool has_sides = along != Point::Zero();
  if (has_sides &&
      (std::ranges::all_of(corners_m, [&](const Point& corner) { return side(corner) <= 0.0; }) ||
       std::ranges::all_of(corners_m, [&](const Point& corner) { return side(corner) >= 0.0; }))) {
    return false;
  }
  const Point ends_m[] = {segment.from_m, segment.to_m};
  return !is_beyond_an_edge(corners_m, ends_m);
}

struct Obstacle {
  Box box;
  std::span<const Point> corners_m;
};

struct BoundaryPiece {
  Box box;
  Segment segment;
};

}  // namespace

/// One search.
class PlainRun {
 public:
  PlainRun(const PlainSearch& search, const search::HorizonProblem& problem);
  PlainResult run();

 private:
  using Step = PlainSearch::Step;

  struct Vertex {
    Point position_m;
    Point heading;  ///< cosine and sine
    double cost_to_come{};
    const Step* step{};  ///< of the edge into this vertex; nullptr for the root
    const Vertex* parent{};
    TrimId trim;
    std::size_t depth{};
  };

  struct OpenEntry {
    double cost_estimate{};
    std::size_t depth{};
    std::size_t number{};  ///< in the order of generation
    const Vertex* vertex{};
  };
  /// std::priority_queue hands out its largest element.
  struct ComesLater {
    bool operator()(const OpenEntry& a, const OpenEntry& b) const {
      if (a.cost_estimate != b.cost_estimate) return a.cost_estimate > b.cost_estimate;
      if (a.depth != b.depth) return a.depth < b.depth;
      return a.number > b.number;
    }
  };

  using OpenList = std::priority_queue<OpenEntry, std::vector<OpenEntry>, ComesLater>;

  static constexpr std::size_t kReserved = 4096;

  void add(const Vertex& vertex);
  void expand(const Vertex& parent);
  [[nodiscard]] double cost_to_go(const Point& position_m, std::size_t depth) const;
  [[nodiscard]] bool incoming_edge_is_free(const Vertex& vertex);
  [[nodiscard]] bool meets_obstacle(const Vertex& vertex);
  [[nodiscard]] bool crosses_boundary(const Vertex& vertex);
  /// Moves an area to the parent of the vertex, into `placed_m_`, and returns its box.
  Box place(const ConvexPolygon& area_m, const Vertex& parent);

  const PlainSearch& search_;
  const search::HorizonProblem& problem_;
  std::size_t horizon_steps_;
  std::vector<std::vector<Obstacle>> obstacles_;
  std::vector<BoundaryPiece> boundary_;
  std::vector<Point> placed_m_;
  std::vector<std::unique_ptr<const Vertex>> vertices_;
  OpenList open_;
};

PlainRun::PlainRun(const PlainSearch& search, const search::HorizonProblem& problem)
    : search_(search), problem_(problem), horizon_steps_(problem.horizon_steps()) {
  for (const auto& areas_m : problem.obstacles_m) {
    auto& obstacles = obstacles_.emplace_back();
    for (const ConvexPolygon& area_m : areas_m) {
      if (area_m.empty()) continue;
      obstacles.push_back(
          {bounding_box(area_m), {area_m.vertices_m.data(), area_m.vertices_m.size()}});
    }
  }
  for (const Segment& segment : problem.boundary_m) {
    boundary_.push_back({bounding_box(segment), segment});
  }
  vertices_.reserve(kReserved);
  std::vector<OpenEntry> open;
  open.reserve(kReserved);
  open_ = OpenList(ComesLater{}, std::move(open));
}

PlainResult PlainRun::run() {
  PlainResult result;
  add({.position_m = problem_.start.position_m(),
       .heading = {std::cos(problem_.start.heading_rad), std::sin(problem_.start.heading_rad)},
       .trim = problem_.start_trim});
  if (search_.distance_to_standstill_[problem_.start_trim.index] > horizon_steps_)
    open_ = OpenList();
  while (!open_.empty()) {
    const Vertex& vertex = *open_.top().vertex;
    open_.pop();
    if (!incoming_edge_is_free(vertex)) continue;
    if (vertex.depth == horizon_steps_) {
      result.feasible = true;
      result.cost = vertex.cost_to_come;
      for (const Vertex* on = &vertex; on->step != nullptr; on = on->parent) {
        result.maneuvers.push_back(on->step->maneuver);
      }
      std::ranges::reverse(result.maneuvers);
      break;
    }
    expand(vertex);
    ++result.expanded;
  }
  result.generated = vertices_.size();
  return result;
}

void PlainRun::add(const Vertex& vertex) {
  const double cost_estimate = vertex.cost_to_come + cost_to_go(vertex.position_m, vertex.depth);
  const std::size_t number = vertices_.size();
  vertices_.push_back(std::make_unique<const Vertex>(vertex));
  open_.push({cost_estimate, vertex.depth, number, vertices_.back().get()});
}

void PlainRun::expand(const Vertex& parent) {
  const std::size_t depth = parent.depth + 1;
  const std::size_t steps_left = horizon_steps_ - depth;
  const Point& reference_m = problem_.reference_m[depth - 1];
  for (const Step& step : search_.steps_[parent.trim.index]) {
    if (step.distance_to_standstill > steps_left) continue;
    if (step.ends_at_limit && problem_.avoids_steering_limit) continue;
    const Point position_m = parent.position_m + turned(step.shift_m, parent.heading);
    add({.position_m = position_m,
         .heading = turned(step.turn, parent.heading),
         .cost_to_come = parent.cost_to_come + (position_m - reference_m).squaredNorm(),
         .step = &step,
         .parent = &parent,
         .trim = step.to,
         .depth = depth});
  }
}

double PlainRun::cost_to_go(const Point& position_m, std::size_t depth) const {
  double sum = 0.0;
  double reach_m = 0.0;
  for (std::size_t j = depth; j < horizon_steps_; ++j) {
    reach_m += search_.longest_m_;
    const double squared_m2 = (position_m - problem_.reference_m[j]).squaredNorm();
    if (squared_m2 <= reach_m * reach_m) continue;
    const double excess_m = std::sqrt(squared_m2) - reach_m;
    sum += excess_m * excess_m;
  }
  return sum;
}

bool PlainRun::incoming_edge_is_free(const Vertex& vertex) {
  return vertex.step == nullptr || !(meets_obstacle(vertex) || crosses_boundary(vertex));
}

bool PlainRun::meets_obstacle(const Vertex& vertex) {
  if (obstacles_.empty() || obstacles_[vertex.depth - 1].empty()) return false;
  const Box box = place(vertex.step->maneuver->swept_area_m, *vertex.parent);
  return std::ranges::any_of(obstacles_[vertex.depth - 1], [&](const Obstacle& obstacle) {
    return overlap(box, obstacle.box) && meet(placed_m_, obstacle.corners_m);
  });
}

bool PlainRun::crosses_boundary(const Vertex& vertex) {
  if (boundary_.empty()) return false;
  const Box box = place(vertex.step->maneuver->lane_area_m, *vertex.parent);
  return std::ranges::any_of(boundary_, [&](const BoundaryPiece& piece) {
    return overlap(box, piece.box) && meet(placed_m_, piece.segment);
  });
}

Box PlainRun::place(const ConvexPolygon& area_m, const Vertex& parent) {
  Box box;
  placed_m_.clear();
  for (const Point& corner_m : area_m.vertices_m) {
    const Point& placed_m =
        placed_m_.emplace_back(parent.position_m + turned(corner_m, parent.heading));
    box.min_m = box.min_m.cwiseMin(placed_m);
    box.max_m = box.max_m.cwiseMax(placed_m);
  }
  return box;
}

PlainSearch::PlainSearch(const automaton::Subgraph& subgraph)
    : steps_(subgraph.automaton().trims.size()),
      distance_to_standstill_(steps_.size(), automaton::Subgraph::kNever) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  for (const TrimId trim : subgraph.start_trims()) {
    distance_to_standstill_[trim.index] = subgraph.distance_to_standstill(trim);
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      const Pose& displacement = edge.maneuver->displacement;
      steps_[trim.index].push_back(
          {.maneuver = edge.maneuver,
           .shift_m = displacement.position_m(),
           .turn = {std::cos(displacement.heading_rad), std::sin(displacement.heading_rad)},
           .to = edge.to,
           .distance_to_standstill = subgraph.distance_to_standstill(edge.to),
           .ends_at_limit = automaton::is_at_steering_limit(
               automaton.trims[edge.to.index], automaton.vehicle, automaton.identified)});
      longest_m_ = std::max(longest_m_, displacement.position_m().norm());
    }
  }
}

PlainResult PlainSearch::search(const search::HorizonProblem& problem) const {
  return PlainRun(*this, problem).run();
}

}  // namespace hlc::test
