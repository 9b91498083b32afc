#include "planner/search/best_first/best_first_search.hpp"

#include <ompl/datastructures/BinaryHeap.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/common/demand.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::search {
namespace {

/// For programmer's mistakes only; see the preconditions in the header.
bool is_well_formed(const HorizonProblem& problem, const automaton::ReachableSets& reachable,
                    CostToGo kind) {
  const std::size_t n = problem.horizon_steps();
  const bool speeds_match = problem.reference_speed_mps.size() == n ||
                            (!needs_reference_speeds(kind) && problem.reference_speed_mps.empty());
  const auto matches = [n](const std::vector<std::vector<ConvexPolygon>>& areas_m) {
    return areas_m.empty() || areas_m.size() == n;
  };
  const bool obstacles_match = matches(problem.obstacles_m) && matches(problem.avoided_in_motion_m);
  const bool contouring_matches = problem.contouring.empty() || problem.contouring.size() == n;
  return n <= reachable.max_steps() && speeds_match && obstacles_match && contouring_matches &&
         problem.start.position_m().allFinite() && std::isfinite(problem.start.heading_rad);
}

}  // namespace

bool BestFirstSearch::Before::operator()(const OpenEntry& a, const OpenEntry& b) const {
  if (a.cost_estimate != b.cost_estimate) return a.cost_estimate < b.cost_estimate;
  if (a.depth != b.depth) return a.depth > b.depth;
  return a.vertex < b.vertex;
}

BestFirstSearch::BestFirstSearch(const automaton::Subgraph& subgraph,
                                 const automaton::ReachableSets& reachable, SearchOptions options)
    : subgraph_(subgraph),
      reachable_(reachable),
      options_(options),
      collision_(subgraph, reachable),
      costs_(subgraph, options.criterion_weights, reachable.max_steps()),
      steps_(subgraph.automaton().trims.size()) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  for (const TrimId trim : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      steps_[trim.index].push_back(
          {edge.maneuver, to_frame(edge.maneuver->displacement), edge.to,
           subgraph.distance_to_standstill(edge.to),
           automaton::is_at_steering_limit(automaton.trims[edge.to.index], automaton.vehicle,
                                           automaton.identified),
           turns_in_place(*edge.maneuver), costs_.reduced_cost(*edge.maneuver)});
    }
  }
}

void BestFirstSearch::record_in(SearchTree* tree) {
  HLC_DEMAND(tree == nullptr || is_admissible(options_.cost_to_go));
  tree_ = tree;
}

void BestFirstSearch::search(const HorizonProblem& problem, const std::function<bool()>& stop,
                             SearchResult& result) {
  HLC_DEMAND(is_well_formed(problem, reachable_, options_.cost_to_go));
  const std::size_t n = problem.horizon_steps();

  reset(result);
  result.generated = 1;
  vertices_.clear();
  vertices_.push_back({to_frame(problem.start), 0.0, nullptr, problem.start_trim, 0, 0});
  if (tree_ != nullptr) tree_->vertices.clear();
  if (subgraph_.distance_to_standstill(problem.start_trim) > n) {
    record(0, std::numeric_limits<double>::infinity(), n);
    return;
  }

  collision_.prepare(problem);
  const CostToGoFunction cost_to_go(subgraph_, reachable_, problem, options_.cost_to_go);
  const bool has_incumbent = write_incumbent(problem, result);

  ompl::BinaryHeap<OpenEntry, Before> open;
  open.insert({cost_to_go(problem.start_trim, 0, vertices_.front().frame), 0, 0});
  record(0, open.top()->data.cost_estimate, n);

  while (!open.empty()) {
    const OpenEntry taken = open.top()->data;
    open.pop();
    if (!incoming_edge_is_free(vertices_[taken.vertex])) {
      record(taken.vertex, Fate::kCollision);
      continue;
    }
    if (vertices_[taken.vertex].depth == n) {
      record(taken.vertex, Fate::kGoal);
      end_at_goal(taken.vertex, problem, has_incumbent, result);
      break;
    }
    const bool is_stop_requested = result.expanded % kExpansionsPerStop == 0 && stop();
    if (result.expanded == options_.max_expansions || is_stop_requested) {
      // Every other entry of the open list has no smaller f.
      const double open_cost = taken.cost_estimate + static_cast<double>(n) * costs_.least();
      stop_early(has_incumbent, lower_bound(open_cost, problem), result);
      break;
    }
    expand(taken.vertex, problem, cost_to_go, open);
    record(taken.vertex, Fate::kExpanded);
    ++result.expanded;
  }
  result.generated = vertices_.size();
  end_record(result);
}

void BestFirstSearch::record(VertexId id, double estimate, std::size_t horizon_steps) {
  if (tree_ == nullptr) return;
  const Vertex& vertex = vertices_[id];
  const double least_m2 = static_cast<double>(horizon_steps) * costs_.least();
  tree_->vertices.push_back({.frame = vertex.frame,
                             .maneuver = vertex.maneuver,
                             .trim = vertex.trim,
                             .parent = vertex.parent,
                             .depth = vertex.depth,
                             .cost_so_far_m2 = vertex.cost_to_come + least_m2,
                             .estimate_m2 = estimate + least_m2});
}

void BestFirstSearch::record(VertexId id, Fate fate) {
  if (tree_ != nullptr) tree_->vertices[id].fate = fate;
}

/// A plan rules out every vertex that promises nothing better, also if the search stopped early.
void BestFirstSearch::end_record(const SearchResult& result) {
  if (tree_ == nullptr || result.status == SearchStatus::kFallback) return;
  for (TreeVertex& vertex : tree_->vertices) {
    if (vertex.fate == Fate::kOpen && vertex.estimate_m2 >= result.cost) vertex.fate = Fate::kBound;
  }
}

/// With the goal's path, unless the incumbent costs no more.
void BestFirstSearch::end_at_goal(VertexId goal, const HorizonProblem& problem, bool has_incumbent,
                                  SearchResult& result) const {
  if (!has_incumbent || cost_of(goal, problem.horizon_steps()) < result.cost) {
    write_path(goal, problem, result);
  }
  result.lower_bound = std::min(lower_bound(result.cost, problem), result.cost);
  const bool is_proven = result.lower_bound == result.cost;
  result.status = is_proven ? SearchStatus::kOptimal : SearchStatus::kUnproven;
  result.reason = NoPath::kNone;
}

/// Least cost of any path, given its `estimate` by the cost-to-go.
double BestFirstSearch::lower_bound(double estimate, const HorizonProblem& problem) const {
  if (is_admissible(options_.cost_to_go)) return estimate;
  return least_cost_of_problem(subgraph_, reachable_, costs_, problem);
}

bool BestFirstSearch::write_incumbent(const HorizonProblem& problem, SearchResult& result) {
  const std::size_t n = problem.horizon_steps();
  if (problem.incumbent.empty() || problem.incumbent.size() != n) return false;
  Frame frame = to_frame(problem.start);
  Pose pose = problem.start;
  TrimId trim = problem.start_trim;
  double cost = 0.0;
  bool is_path = true;
  for (std::size_t depth = 0; depth < n && is_path; ++depth) {
    const automaton::Maneuver* const maneuver = problem.incumbent[depth];
    const Step* const step = find_step(trim, maneuver);
    is_path = step != nullptr && permits(problem, *step, depth) &&
              collision_.is_free(*maneuver, depth + 1, frame);
    if (!is_path) break;
    frame = compose(frame, step->displacement);
    pose = {frame.origin_m.x(), frame.origin_m.y(),
            pose.heading_rad + maneuver->displacement.heading_rad};
    cost += problem.position_cost_m2(depth, frame.origin_m) + step->cost;
    trim = step->to;
    result.maneuvers.push_back(maneuver);
    result.poses.push_back(pose);
  }
  if (!is_path) {
    reset(result);
    result.generated = 1;
    return false;
  }
  result.cost = cost + static_cast<double>(n) * costs_.least();
  return true;
}

const BestFirstSearch::Step* BestFirstSearch::find_step(TrimId trim,
                                                        const automaton::Maneuver* maneuver) const {
  for (const Step& step : steps_[trim.index]) {
    if (step.maneuver == maneuver) return &step;
  }
  return nullptr;
}

bool BestFirstSearch::permits(const HorizonProblem& problem, const Step& step, std::size_t depth) {
  return step.distance_to_standstill <= problem.horizon_steps() - (depth + 1) &&
         !(step.ends_at_limit && problem.avoids_steering_limit) &&
         !(step.turns_in_place && (depth > 0 || !problem.may_turn_in_place));
}

template <typename OpenList>
void BestFirstSearch::expand(VertexId vertex, const HorizonProblem& problem,
                             const CostToGoFunction& cost_to_go, OpenList& open) {
  const Vertex parent = vertices_[vertex];  // a copy: `vertices_` grows below
  const std::uint32_t depth = parent.depth + 1;
  const std::size_t steps_left = problem.horizon_steps() - depth;

  for (const Step& step : steps_[parent.trim.index]) {
    if (!permits(problem, step, parent.depth)) continue;
    const Frame frame = compose(parent.frame, step.displacement);
    const double cost_to_come =
        parent.cost_to_come + problem.position_cost_m2(depth - 1, frame.origin_m) + step.cost;
    const auto child = static_cast<VertexId>(vertices_.size());
    vertices_.push_back({frame, cost_to_come, step.maneuver, step.to, vertex, depth});
    const double to_go = cost_to_go(step.to, depth, frame) + costs_.to_go(step.to, steps_left);
    open.insert({cost_to_come + to_go, child, depth});
    record(child, cost_to_come + to_go, problem.horizon_steps());
  }
}

bool BestFirstSearch::incoming_edge_is_free(const Vertex& vertex) {
  return vertex.depth == 0 ||
         collision_.is_free(*vertex.maneuver, vertex.depth, vertices_[vertex.parent].frame);
}

double BestFirstSearch::cost_of(VertexId vertex, std::size_t steps) const {
  return vertices_[vertex].cost_to_come + static_cast<double>(steps) * costs_.least();
}

void BestFirstSearch::write_path(VertexId goal, const HorizonProblem& problem,
                                 SearchResult& result) const {
  const std::size_t n = problem.horizon_steps();
  result.cost = cost_of(goal, n);
  result.maneuvers.resize(n);
  result.poses.resize(n);
  for (VertexId id = goal; vertices_[id].depth > 0; id = vertices_[id].parent) {
    const Vertex& vertex = vertices_[id];
    result.maneuvers[vertex.depth - 1] = vertex.maneuver;
    result.poses[vertex.depth - 1] = {vertex.frame.origin_m.x(), vertex.frame.origin_m.y(), 0.0};
  }
  double heading_rad = problem.start.heading_rad;
  for (std::size_t j = 0; j < n; ++j) {
    heading_rad += result.maneuvers[j]->displacement.heading_rad;
    result.poses[j].heading_rad = heading_rad;
  }
}

}  // namespace hlc::search
