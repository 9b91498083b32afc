#include "planner/search/branch_and_bound/branch_and_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/common/demand.hpp"
#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/branch_and_bound/prepared_obstacles.hpp"
#include "planner/search/branch_and_bound/tables.hpp"
#include "planner/search/collision.hpp"
#include "planner/search/cost_to_go.hpp"
#include "planner/search/search_tables.hpp"

namespace hlc::search {
namespace {

using branch_and_bound::kCos;
using branch_and_bound::kFloatLanes;
using branch_and_bound::kNoPath;
using branch_and_bound::kSin;
using branch_and_bound::kX;
using branch_and_bound::kY;
using branch_and_bound::Question;
using branch_and_bound::TableStore;
using branch_and_bound::VertexData;

using Instructions = BranchAndBound::Instructions;

/// The most advanced instruction set up to `most` that the processor has.
Instructions available(Instructions most) {
#ifdef HLC_AVX_KERNELS
  const bool has_avx2 = __builtin_cpu_supports("avx2");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                          __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (has_avx512) return most;
  if (has_avx2) return std::min(most, Instructions::kAvx2);
#endif
  static_cast<void>(most);
  return Instructions::kPortable;
}

branch_and_bound::Kernel kernel_of(Instructions instructions) {
#ifdef HLC_AVX_KERNELS
  if (instructions == Instructions::kAvx512) return branch_and_bound::avx512_kernel();
  if (instructions == Instructions::kAvx2) return branch_and_bound::avx2_kernel();
#endif
  static_cast<void>(instructions);
  return branch_and_bound::portable_kernel();
}

void put(VertexData& vertex, const Frame& at) {
  vertex.place[kX] = at.origin_m.x();
  vertex.place[kY] = at.origin_m.y();
  vertex.place[kCos] = at.cos_heading;
  vertex.place[kSin] = at.sin_heading;
}

Frame frame_of(const VertexData& vertex) {
  return {{vertex.place[kX], vertex.place[kY]}, vertex.place[kCos], vertex.place[kSin]};
}

}  // namespace

/// Tables, memory of a search, and the kernel's view of both.
class BranchAndBound::Core {
 public:
  Core(const automaton::Subgraph& subgraph, std::shared_ptr<const SearchTables> shared,
       Instructions most)
      : shared_(std::move(shared)),
        costs(shared_->costs),
        tables(shared_->store),
        obstacles(tables),
        instructions(available(most)),
        kernel(kernel_of(instructions)) {
    std::size_t most_corners = 0;
    for (const TrimId trim : subgraph.start_trims()) {
      for (const automaton::Edge& edge : subgraph.successors(trim)) {
        most_corners = std::max({most_corners, edge.maneuver->swept_area_m.vertices_m.size(),
                                 edge.maneuver->lane_area_m.vertices_m.size()});
      }
    }
    placed_.vertices_m.reserve(most_corners);
    search.tables = &tables.view();
    search.plan = &plan;
    to_go_.resize(2 * tables.most_edges());
    search.to_go = to_go_.data();
    search.decides = [](const void* core, const Question& question) {
      return static_cast<const Core*>(core)->decides(question);
    };
    search.decides_context = this;
    search.stop = [](const void* stop) {
      return (*static_cast<const std::function<bool()>*>(stop))();
    };
  }

  /// Obstacles, references and room for a path.
  void prepare(const HorizonProblem& problem) {
    const std::size_t n = problem.horizon_steps();
    if (reference_x_.size() < n) {
      reference_x_.resize(n);
      reference_y_.resize(n);
      contouring_x_.resize(n);
      contouring_y_.resize(n);
      seen_stride_ = n + kFloatLanes;
      seen_x_.resize(n * seen_stride_);
      seen_y_.resize(n * seen_stride_);
      path.resize(n + 1);
      keys_.resize((n + 1) * tables.most_edges());
      best_edges.resize(n + 1);
      best_x.resize(n + 1);
      best_y.resize(n + 1);
      for (std::size_t k = 0; k <= n; ++k) {
        path[k].keys = &keys_[k * tables.most_edges()];
      }
    }
    // Largest distance of reference points from the start for which coordinates seen from a vertex
    // are used.
    const double far_m = tables.counted_m() - static_cast<double>(n) * tables.longest_m();
    const double squared_far_m2 = far_m > 0.0 ? far_m * far_m : -1.0;
    plan.is_far = false;
    const auto units_per_m = static_cast<double>(tables.view().units_per_m);
    for (std::size_t j = 0; j < n; ++j) {
      reference_x_[j] = problem.reference_m[j].x();
      reference_y_[j] = problem.reference_m[j].y();
      const Point contouring = problem.contouring.empty() ? Point::Zero() : problem.contouring[j];
      contouring_x_[j] = contouring.x();
      contouring_y_[j] = contouring.y();
      const double dx_m = reference_x_[j] - problem.start.x_m;
      const double dy_m = reference_y_[j] - problem.start.y_m;
      seen_x_[j] = static_cast<float>(dx_m * units_per_m);
      seen_y_[j] = static_cast<float>(dy_m * units_per_m);
      plan.is_far |= dx_m * dx_m + dy_m * dy_m > squared_far_m2;
    }
    plan.reference_x = reference_x_.data();
    plan.reference_y = reference_y_.data();
    plan.contouring_x = contouring_x_.data();
    plan.contouring_y = contouring_y_.data();
    plan.seen_x = seen_x_.data();
    plan.seen_y = seen_y_.data();
    plan.seen_stride = seen_stride_;

    if (levels_.size() < n) levels_.resize(n);
    for (std::size_t depth = 0; depth < n; ++depth) {
      levels_[depth] = tables.level(n - depth - 1,
                                    {.at_limit = problem.avoids_steering_limit,
                                     .turning_in_place = depth > 0 || !problem.may_turn_in_place});
    }
    search.levels = levels_.data();
    search.path = path.data();
    search.best_cost = kNoPath;
    search.best_edges = best_edges.data();
    search.best_x = best_x.data();
    search.best_y = best_y.data();
    search.generated = 1;
    search.expanded = 0;
    search.stopped_early = false;
    search.lower_bound = 0.0;

    const Frame start = to_frame(problem.start);
    put(path[0], start);
    path[0].cost_to_come = 0.0;
    path[0].from_start = {0.0F, 0.0F, static_cast<float>(start.cos_heading),
                          static_cast<float>(start.sin_heading)};
    path[0].move = &path[0].from_start;
    path[0].trim = static_cast<std::uint32_t>(problem.start_trim.index);

    obstacles.list(problem, plan);
    for (std::size_t k = 0; k <= n; ++k) {
      path[k].near = obstacles.near(k);
      path[k].near_blocks = obstacles.near_blocks(k);
    }
    kernel.prepare(plan, path[0]);
  }

  /// The test of CollisionCheck, for cases that are too close for the kernel.
  [[nodiscard]] bool decides(const Question& question) const {
    const automaton::Maneuver& maneuver = *tables.maneuver(question.edge);
    const Frame start = frame_of(*question.vertex);
    if (question.is_segment) {
      const Segment& segment = obstacles.segment(question.item);
      return overlap(place(maneuver.lane_area_m, start, placed_), bounding_box(segment)) &&
             intersects(placed_, segment);
    }
    const ConvexPolygon& obstacle_m = obstacles.obstacle(question.item);
    return overlap(place(maneuver.swept_area_m, start, placed_), bounding_box(obstacle_m)) &&
           intersects(placed_, obstacle_m);
  }

 private:
  std::shared_ptr<const SearchTables> shared_;  // first: others refer to it

 public:
  const EdgeCosts& costs;
  const TableStore& tables;
  branch_and_bound::PreparedObstacles obstacles;
  Instructions instructions;
  branch_and_bound::Kernel kernel;
  branch_and_bound::Plan plan{};
  branch_and_bound::Search search{};
  std::vector<VertexData> path;
  std::vector<std::uint32_t> best_edges;
  std::vector<double> best_x;
  std::vector<double> best_y;

 private:
  std::vector<double> reference_x_;
  std::vector<double> reference_y_;
  std::vector<double> contouring_x_;
  std::vector<double> contouring_y_;
  std::vector<float> seen_x_;
  std::vector<float> seen_y_;
  std::size_t seen_stride_{};
  std::vector<float> to_go_;
  std::vector<double> keys_;
  std::vector<branch_and_bound::Level> levels_;
  mutable ConvexPolygon placed_;  ///< its capacity holds the largest area
};

BranchAndBound::BranchAndBound(const automaton::Subgraph& subgraph,
                               const automaton::ReachableSets& reachable, SearchOptions options,
                               Instructions most, std::shared_ptr<const SearchTables> tables)
    : subgraph_(subgraph), reachable_(reachable), options_(std::move(options)) {
  if (options_.cost_to_go != CostToGo::kReachable) {
    throw std::invalid_argument(
        "search: engine branch_and_bound has the cost-to-go 'reachable' alone; "
        "for another one choose engine best_first");
  }
  if (!tables) tables = std::make_shared<const SearchTables>(subgraph, reachable, options_);
  core_ = std::make_unique<Core>(subgraph, std::move(tables), most);
}

BranchAndBound::~BranchAndBound() = default;

void BranchAndBound::search(const HorizonProblem& problem, const std::function<bool()>& stop,
                            SearchResult& result) {
  const std::size_t n = problem.horizon_steps();
  HLC_DEMAND(n <= reachable_.max_steps(), n, reachable_.max_steps());
  HLC_DEMAND(problem.contouring.empty() || problem.contouring.size() == n,
             problem.contouring.size(), n);
  HLC_DEMAND(problem.obstacles_m.empty() || problem.obstacles_m.size() == n,
             problem.obstacles_m.size(), n);
  HLC_DEMAND(problem.avoided_in_motion_m.empty() || problem.avoided_in_motion_m.size() == n,
             problem.avoided_in_motion_m.size(), n);
  HLC_DEMAND(problem.start.position_m().allFinite() && std::isfinite(problem.start.heading_rad),
             problem.start.x_m, problem.start.y_m, problem.start.heading_rad);

  reset(result);
  result.generated = 1;
  if (subgraph_.distance_to_standstill(problem.start_trim) > n) return;
  if (n == 0) {
    result.status = SearchStatus::kOptimal;
    result.reason = NoPath::kNone;
    return;
  }
  core_->prepare(problem);
  branch_and_bound::Search& search = core_->search;
  search.stop_context = &stop;
  search.max_expansions = options_.max_expansions;
  place_incumbent(problem);
  core_->kernel.search(search);

  result.generated = search.generated;
  result.expanded = search.expanded;
  const bool has_path = search.best_cost < kNoPath;
  if (has_path) write_best(problem, result);
  if (search.stopped_early) {
    // Keys equal f except for their last bits, which number the children.
    constexpr double kLastBit = std::numeric_limits<double>::epsilon();
    search.lower_bound *= 1.0 - kLastBit * static_cast<double>(core_->tables.view().index_mask + 1);
    const EdgeCosts& costs = core_->costs;
    const double of_open = search.lower_bound + static_cast<double>(n) * costs.least();
    // The start's own bound is sometimes tighter than that of some of its children.
    const double of_start = least_cost_of_problem(subgraph_, reachable_, costs, problem);
    stop_early(has_path, std::max(of_open, of_start), result);
  } else if (has_path) {
    result.status = SearchStatus::kOptimal;
    result.reason = NoPath::kNone;
    result.lower_bound = result.cost;
  }
}

/// Makes the incumbent the best path so far, if it is a free path.
void BranchAndBound::place_incumbent(const HorizonProblem& problem) {
  const std::size_t n = problem.horizon_steps();
  if (problem.incumbent.size() != n) return;
  Core& core = *core_;
  const branch_and_bound::Tables& tables = core.tables.view();
  VertexData vertex = core.path[0];
  for (std::size_t depth = 0; depth < n; ++depth) {
    const std::uint32_t edge = core.tables.find({vertex.trim}, problem.incumbent[depth]);
    if (edge == TableStore::kNoEdge) return;
    if (core.search.levels[depth].penalty[edge] >= branch_and_bound::kForbidden) return;
    if (!core.kernel.is_free(core.search, edge, depth + 1, vertex)) return;
    const branch_and_bound::EdgeData& data = tables.edges[edge];
    const Frame next = compose(frame_of(vertex), {{data.displacement[kX], data.displacement[kY]},
                                                  data.displacement[kCos],
                                                  data.displacement[kSin]});
    put(vertex, next);
    vertex.cost_to_come += problem.position_cost_m2(depth, next.origin_m) + data.cost;
    vertex.trim = data.to;
    core.best_edges[depth] = edge;
    core.best_x[depth] = vertex.place[kX];
    core.best_y[depth] = vertex.place[kY];
  }
  core.search.best_cost = vertex.cost_to_come;
}

void BranchAndBound::write_best(const HorizonProblem& problem, SearchResult& result) const {
  const std::size_t n = problem.horizon_steps();
  result.cost = core_->search.best_cost + static_cast<double>(n) * core_->costs.least();
  result.maneuvers.resize(n);
  result.poses.resize(n);
  double heading_rad = problem.start.heading_rad;
  for (std::size_t j = 0; j < n; ++j) {
    const automaton::Maneuver* const maneuver = core_->tables.maneuver(core_->best_edges[j]);
    heading_rad += maneuver->displacement.heading_rad;
    result.maneuvers[j] = maneuver;
    result.poses[j] = {core_->best_x[j], core_->best_y[j], heading_rad};
  }
}

std::vector<double> BranchAndBound::estimates(const HorizonProblem& problem) {
  core_->prepare(problem);
  core_->kernel.expand(core_->search);
  const std::size_t num_edges = subgraph_.successors(problem.start_trim).size();
  std::vector<double> estimates(core_->path[0].keys, core_->path[0].keys + num_edges);
  for (double& f : estimates) {
    if (f >= kNoPath) f = std::numeric_limits<double>::infinity();
  }
  return estimates;
}

BranchAndBound::Instructions BranchAndBound::instructions() const { return core_->instructions; }

void BranchAndBound::prepare(const HorizonProblem& problem) { core_->prepare(problem); }

bool BranchAndBound::is_free(const automaton::Maneuver& maneuver, std::size_t step,
                             const Frame& start) const {
  VertexData vertex = core_->path[0];
  put(vertex, start);
  vertex.trim = static_cast<std::uint32_t>(maneuver.from.index);
  const std::uint32_t edge = core_->tables.find(maneuver.from, &maneuver);
  HLC_DEMAND(edge != TableStore::kNoEdge, maneuver.from.index, maneuver.to.index);
  return core_->kernel.is_free(core_->search, edge, step, vertex);
}

}  // namespace hlc::search
