// The inner loop of BranchAndBound. It is verbose for speed: four children at a time, their bounds
// for four steps at a time, branches where they are predictable. Like its preparation, collision
// test and vectors (separate files) it shares nothing with other files except the plain data of
// data.hpp. It is compiled three times, for any processor (portable.cpp), with AVX2 (avx2.cpp) and
// with AVX-512 (avx512.cpp); only these include it. The same operations in the same order, no
// contraction: all give the same bits. No function here may be visible outside, and none from
// elsewhere be used, or the linker could mix them.
//
// The algorithm is specified in branch_and_bound.hpp.
#pragma once

#include "planner/search/branch_and_bound/collision.hpp"
#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/branch_and_bound/preparation.hpp"
#include "planner/search/branch_and_bound/vectors.hpp"

namespace hlc::search::branch_and_bound {
namespace {

/// The lowest and highest 16-bit integers.
constexpr std::int16_t kLowest = -32768;
constexpr std::int16_t kHighest = 32767;

constexpr float kAxisCos = 0x1.d906bcp-1F;  // cos and sin of 22.5 degrees
constexpr float kAxisSin = 0x1.87de2ap-2F;
constexpr double kFarCos = 0x1.d906bcf328d46p-1;
constexpr double kFarSin = 0x1.87de2a6aea963p-2;

/// A vertex, seen from the plan's start.
HLC_INLINE Move move_from_start(const Plan& plan, const VertexData& vertex, float units_per_m) {
  const auto units = static_cast<double>(units_per_m);
  return {static_cast<float>((vertex.place[kX] - plan.origin_x) * units),
          static_cast<float>((vertex.place[kY] - plan.origin_y) * units),
          static_cast<float>(vertex.place[kCos]), static_cast<float>(vertex.place[kSin])};
}

/// The transformation to a vertex at this depth, reached by this edge of the one before.
HLC_INLINE const Move* move_to(const Search& search, VertexData& vertex, std::size_t depth,
                               const EdgeData& edge) {
  if (depth % kSeenInARow != 0) return &edge.move;
  vertex.from_start = move_from_start(*search.plan, vertex, search.tables->units_per_m);
  return &vertex.from_start;
}

/// Eight reference points, seen from a vertex [1 / Tables::units_per_m m]: numbers 0, 1, 4, 5, 2,
/// 3, 6 and 7.
struct Seen {
  Floats ahead;
  Floats aside;
};

/// The reference points from step `step` on, seen from a vertex at this depth. Beyond the horizon
/// they are arbitrary: the intervals of those steps hold every place.
HLC_INLINE Seen see(const Plan& plan, std::size_t depth, const Move& move, std::size_t step) {
  const std::size_t from = (depth % kSeenInARow == 0 ? 0 : depth * plan.seen_stride) + step;
  const std::size_t to = (depth + 1) * plan.seen_stride + step;
  const Floats x = middle_swapped(load(plan.seen_x + from)) - all(move.x);
  const Floats y = middle_swapped(load(plan.seen_y + from)) - all(move.y);
  const Seen seen{x * all(move.cos_heading) + y * all(move.sin_heading),
                  y * all(move.cos_heading) - x * all(move.sin_heading)};
  store(plan.seen_x + to, middle_swapped(seen.ahead));
  store(plan.seen_y + to, middle_swapped(seen.aside));
  return seen;
}

/// Eight reference points along two axes in each, in the order of `rounded`.
using Along = Shorts[kBoundAxes / 2];

HLC_INLINE void project(const Seen& seen, Along& along) {
  const Floats ahead_cos = seen.ahead * all(kAxisCos);
  const Floats ahead_sin = seen.ahead * all(kAxisSin);
  const Floats aside_cos = seen.aside * all(kAxisCos);
  const Floats aside_sin = seen.aside * all(kAxisSin);
  const Floats diagonal = all(static_cast<float>(kDiagonal));
  along[0] = rounded(seen.ahead, ahead_cos + aside_sin);
  along[1] = rounded((seen.ahead + seen.aside) * diagonal, ahead_sin + aside_cos);
  along[2] = rounded(seen.aside, aside_cos - ahead_sin);
  along[3] = rounded((seen.aside - seen.ahead) * diagonal, aside_sin - ahead_cos);
}

/// Squared distances of four reference points, the first or the second of eight, from the intervals
/// of four edges each, on the axis with the largest, 0 within them all; those of steps 0 and 1
/// added, edge by edge, and those of 2 and 3.
template <int kFour>
HLC_INLINE Floats squared_beyond(const BoundBlock& bound, const Along& along) {
  const auto beyond = [&](std::size_t axis, const Shorts& places) {
    return larger(difference(places, load(bound.high[axis])),
                  difference(load(bound.low[axis]), places));
  };
  const auto beyond_two = [&](std::size_t two) {
    return larger(beyond(2 * two, four_times_two<kFour>(along[two])),
                  beyond(2 * two + 1, four_times_two<kFour + 2>(along[two])));
  };
  // Pairwise: the largest of eight is found in three steps.
  const Shorts first = larger(beyond_two(0), beyond_two(1));
  const Shorts second = larger(beyond_two(2), beyond_two(3));
  return squares_of_two_added(larger(larger(first, second), all_shorts(0)));
}

/// As long as there is no path, costs-to-go only order the children. They do not consider
/// obstacles: if there is still no path after this many expansions, they are not worth their time.
constexpr std::uint64_t kPatience = 4096;

/// Inputs for the keys of a vertex' children.
struct Expansion {
  std::size_t first_group;
  std::size_t num_edges;  ///< with padding
  const double* penalty;  ///< these and the next of the first edge
  const double* displacement_x;
  const double* displacement_y;
  Doubles ahead;  ///< the next reference point, seen from the vertex
  Doubles aside;
  Doubles cost_to_come;
  Doubles contouring_ahead;  ///< HorizonProblem::contouring, seen from the vertex
  Doubles contouring_aside;
};

HLC_INLINE Expansion begin_expansion(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];
  const std::size_t first_group = tables.first_group[vertex.trim];
  const std::size_t first_edge = kLanes * first_group;
  const std::size_t num_edges = kLanes * (tables.first_group[vertex.trim + 1] - first_group);
  vertex.first_edge = static_cast<std::uint32_t>(first_edge);
  vertex.num_edges = static_cast<std::uint32_t>(num_edges);
  search.generated += level.permitted[vertex.trim];
  ++search.expanded;
  const double dx = plan.reference_x[depth] - vertex.place[kX];
  const double dy = plan.reference_y[depth] - vertex.place[kY];
  const double c = vertex.place[kCos];
  const double s = vertex.place[kSin];
  return {first_group,
          num_edges,
          level.penalty + first_edge,
          tables.displacement_x + first_edge,
          tables.displacement_y + first_edge,
          all(dx * c + dy * s),
          all(dy * c - dx * s),
          all(vertex.cost_to_come),
          all(plan.contouring_x[depth] * c + plan.contouring_y[depth] * s),
          all(plan.contouring_y[depth] * c - plan.contouring_x[depth] * s)};
}

/// Cost-to-come of four edges' ends and the certain cost after them.
HLC_INLINE Doubles cost_without_bound(const Expansion& expansion, std::size_t edge) {
  const Doubles beside_x = expansion.ahead - load(expansion.displacement_x + edge);
  const Doubles beside_y = expansion.aside - load(expansion.displacement_y + edge);
  const Doubles across =
      beside_x * expansion.contouring_ahead + beside_y * expansion.contouring_aside;
  return load(expansion.penalty + edge) + expansion.cost_to_come +
         ((beside_x * beside_x + beside_y * beside_y) + across * across);
}

HLC_INLINE Doubles keep_key(const Tables& tables, VertexData& vertex, std::size_t edge,
                            const Doubles& f) {
  const Doubles key = numbered(f, tables.index_mask, load(tables.numbers + edge));
  store(vertex.keys + edge, key);
  return key;
}

/// Writes the keys of a vertex' children without a bound for the steps after their edges. Returns
/// the least.
HLC_INLINE double expand_without_bound(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Expansion expansion = begin_expansion(search, vertex, depth);
  Doubles lowest = keep_key(tables, vertex, 0, cost_without_bound(expansion, 0));
  for (std::size_t edge = kLanes; edge < expansion.num_edges; edge += kLanes) {
    lowest = smaller(keep_key(tables, vertex, edge, cost_without_bound(expansion, edge)), lowest);
  }
  return least(lowest);
}

/// For a long horizon, the contribution of all steps except the last eight or fewer to the bounds
/// of a vertex' edges: writes Search::to_go. Returns the first remaining block.
[[gnu::noinline]] std::size_t bound_first_steps(const Search& search, const VertexData& vertex,
                                                std::size_t depth) {
  const Tables& tables = *search.tables;
  const Level& level = search.levels[depth];
  const BoundBlock* const first_bounds =
      tables.bounds + vertex.first_edge / kLanes * tables.bound_size;
  std::size_t block = 0;
  for (; block + 2 < level.num_blocks; block += 2) {
    Along along;
    project(see(*search.plan, depth, *vertex.move, depth + 1 + kBoundSteps * block), along);
    const std::uint32_t* const places = level.bounds + block;
    const BoundBlock* bounds = first_bounds;
    for (std::size_t edge = 0; edge < vertex.num_edges; edge += kLanes) {
      Floats to_go = squared_beyond<0>(bounds[places[0]], along);
      if (block != 0) to_go += load(search.to_go + 2 * edge);
      store(search.to_go + 2 * edge, to_go + squared_beyond<1>(bounds[places[1]], along));
      bounds += tables.bound_size;
    }
  }
  return block;
}

/// Writes the keys of a vertex' children. Returns the least.
HLC_INLINE double expand(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Level& level = search.levels[depth];
  const Expansion expansion = begin_expansion(search, vertex, depth);
  const bool is_long = level.num_blocks > 2;
  const std::size_t block = is_long ? bound_first_steps(search, vertex, depth) : 0;
  Along along;
  project(see(*search.plan, depth, *vertex.move, depth + 1 + kBoundSteps * block), along);
  const bool has_second = level.num_blocks > block + 1;
  const std::size_t bound_size = tables.bound_size;
  const BoundBlock* const bounds = tables.bounds + expansion.first_group * bound_size;
  const BoundBlock* first = bounds + level.bounds[block];
  const BoundBlock* second = bounds + level.bounds[has_second ? block + 1 : block];
  const Floats scale = all(kSurely * tables.squared_unit_m2);
  const auto key_of_four = [&](std::size_t edge) {
    Floats to_go = squared_beyond<0>(*first, along);
    if (is_long) to_go += load(search.to_go + 2 * edge);
    if (has_second) to_go += squared_beyond<1>(*second, along);
    const Doubles f = cost_without_bound(expansion, edge) + halves_added(to_go * scale);
    return keep_key(tables, vertex, edge, f);
  };
  Doubles lowest = key_of_four(0);
  for (std::size_t edge = kLanes; edge < expansion.num_edges; edge += kLanes) {
    for (Shorts& two_axes : along) stay_in_loop(two_axes);
    first += bound_size;
    second += bound_size;
    lowest = smaller(key_of_four(edge), lowest);
  }
  return least(lowest);
}

/// Coordinates of a reference point, seen from a vertex, along each axis and then against each [1 /
/// Tables::units_per_m m].
struct FarPoint {
  double along[2 * kBoundAxes];
};

HLC_INLINE FarPoint see_far(const Plan& plan, std::size_t step, const VertexData& vertex,
                            double units_per_m) {
  const double dx = (plan.reference_x[step] - vertex.place[kX]) * units_per_m;
  const double dy = (plan.reference_y[step] - vertex.place[kY]) * units_per_m;
  const double ahead = dx * vertex.place[kCos] + dy * vertex.place[kSin];
  const double aside = dy * vertex.place[kCos] - dx * vertex.place[kSin];
  const double along[kBoundAxes] = {ahead,
                                    ahead * kFarCos + aside * kFarSin,
                                    (ahead + aside) * kDiagonal,
                                    ahead * kFarSin + aside * kFarCos,
                                    aside,
                                    aside * kFarCos - ahead * kFarSin,
                                    (aside - ahead) * kDiagonal,
                                    aside * kFarSin - ahead * kFarCos};
  FarPoint point;
  for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
    point.along[axis] = along[axis];
    point.along[axis + kBoundAxes] = -along[axis];
  }
  return point;
}

/// Squared distance of a reference point from an interval of a block, on all axes together: from
/// the half-plane that it lies farthest beyond or, if that is farther, from the intersection of its
/// border with that of a neighbour. Saturated ends bound nothing.
HLC_INLINE double squared_beyond_far(const BoundBlock& bound, std::size_t interval,
                                     const FarPoint& point) {
  constexpr double kMost = 1e36;  // the sum of many is still a number
  constexpr std::size_t kDirections = 2 * kBoundAxes;
  double beyond[kDirections];
  for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
    const std::int16_t low = bound.low[axis][interval];
    const std::int16_t high = bound.high[axis][interval];
    beyond[axis] = high == kHighest ? -1.0 : point.along[axis] - high;
    beyond[axis + kBoundAxes] = low == kLowest ? -1.0 : point.along[axis + kBoundAxes] + low;
  }
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < kDirections; ++i) {
    farthest = beyond[i] > beyond[farthest] ? i : farthest;
  }
  const double a = beyond[farthest];
  if (!(a > 0.0)) return 0.0;
  double squared = a * a;
  const std::size_t neighbours[] = {farthest + 1, farthest + kDirections - 1};
  for (const std::size_t next : neighbours) {
    const double b = beyond[next % kDirections];
    if (!(b > kFarCos * a)) continue;
    const double of_corner = (a * a + b * b - 2.0 * kFarCos * a * b) / (kFarSin * kFarSin);
    squared = of_corner > squared ? of_corner : squared;
  }
  return squared < kMost ? squared : kMost;
}

/// As `expand`, for reference points so far away that coordinates exceed 16 bits, and that sixteen
/// directions miss too much of the distance: one edge and step at a time, in double precision.
double expand_far(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];
  const Expansion expansion = begin_expansion(search, vertex, depth);
  const auto units_per_m = static_cast<double>(tables.units_per_m);
  const Doubles scale = all(kSurelyFar / (units_per_m * units_per_m));
  const BoundBlock* bounds = tables.bounds + expansion.first_group * tables.bound_size;
  Doubles lowest = all(kForbidden);
  for (std::size_t edge = 0; edge < expansion.num_edges; edge += kLanes) {
    double to_go[kLanes] = {};
    for (std::size_t step = depth + 1; step < plan.horizon_steps; ++step) {
      const std::size_t after = step - depth - 1;
      const std::size_t of_four = after % kBoundSteps;
      const BoundBlock& bound = bounds[level.bounds[after / kBoundSteps]];
      const FarPoint point = see_far(plan, step, vertex, units_per_m);
      for (std::size_t e = 0; e < kLanes; ++e) {
        to_go[e] += squared_beyond_far(bound, 8 * (of_four / 2) + 2 * e + of_four % 2, point);
      }
    }
    bounds += tables.bound_size;
    const Doubles costs_to_go = scale * Doubles{to_go[0], to_go[1], to_go[2], to_go[3]};
    const Doubles f = cost_without_bound(expansion, edge) + costs_to_go;
    lowest = smaller(keep_key(tables, vertex, edge, f), lowest);
  }
  return least(lowest);
}

/// Writes the keys of a vertex' children, with a bound or without. Returns the least.
HLC_INLINE double expand_by(Search& search, VertexData& vertex, std::size_t depth, bool has_bound) {
  const Plan& plan = *search.plan;
  if (has_bound) {
    return plan.is_far ? expand_far(search, vertex, depth) : expand(search, vertex, depth);
  }
  if (!plan.is_far) {  // children may be bounded again, and see from here
    for (std::size_t step = depth + 1; step < plan.horizon_steps; step += kFloatLanes) {
      static_cast<void>(see(plan, depth, *vertex.move, step));
    }
  }
  return expand_without_bound(search, vertex, depth);
}

/// Removes the child with this key, the vertex' least, and stores the least of the others. Done at
/// once, while the child is checked, so that it is ready when the search returns to the vertex.
/// @pre denormal numbers are compared exactly: where f is 0 keys hold the child's number alone
HLC_INLINE void take(VertexData& vertex, double key) {
  const auto take_of_four = [&](std::uint32_t first) {
    const Doubles keys = load(vertex.keys + first);
    const Doubles left = if_equal(keys, all(key), all(kForbidden), keys);
    store(vertex.keys + first, left);
    return left;
  };
  Doubles lowest = take_of_four(0);
  for (std::uint32_t first = kLanes; first < vertex.num_edges; first += kLanes) {
    lowest = smaller(take_of_four(first), lowest);
  }
  vertex.next_key = least(lowest);
}

/// Of a place its position, with zeros for the heading.
HLC_INLINE Doubles position_of(const double* place) {
  return where_set(0b0011, load(place), all(0.0));
}

HLC_INLINE std::uint64_t bits(double value) {
  std::uint64_t result;
  __builtin_memcpy(&result, &value, sizeof result);
  return result;
}

void stop_early(Search& search, std::size_t depth, double bound) {
  for (std::size_t k = 0; k <= depth; ++k) {
    const double open = search.path[k].next_key;
    bound = open < bound ? open : bound;
  }
  search.lower_bound = bound;
  search.stopped_early = true;
}

/// kExpansionsPerStop of search_engine.hpp, which this file cannot include.
constexpr std::uint64_t kStopInterval = 64;

/// Number of expansions before the next check.
HLC_INLINE std::uint64_t next_look(const Search& search) {
  const std::uint64_t next = search.expanded + kStopInterval;
  return next < search.max_expansions ? next : search.max_expansions;
}

void run(Search& search) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const std::size_t n = plan.horizon_steps;
  if (search.max_expansions == 0 || search.stop(search.stop_context)) {
    search.stopped_early = true;  // the caller knows a bound for the start
    return;
  }
  std::uint64_t next_check = next_look(search);
  VertexData* vertex = search.path;
  std::size_t depth = 0;
  double best = search.best_cost;
  bool has_patience = true;
  for (;;) {
    const bool has_bound = search.levels[depth].num_blocks != 0 && has_patience;
    double key = expand_by(search, *vertex, depth, has_bound);
    // A vertex without free edges is left for good: it needs no next key.
    if (key < best && !look_around(search, depth + 1, *vertex)) key = kForbidden;

    // The next vertex to expand: the first free child worth it, here or further back.
    for (;;) {
      if (!(key < best)) {
        if (depth == 0) {
          search.best_cost = best;
          return;
        }
        --depth;
        --vertex;
        key = vertex->next_key;
        continue;
      }
      const auto number = static_cast<std::uint32_t>(bits(key) & tables.index_mask);
      take(*vertex, key);
      const std::uint32_t edge = vertex->first_edge + number;
      if (!is_free(search, edge, *vertex)) {
        key = vertex->next_key;
        continue;
      }

      const EdgeData& data = tables.edges[edge];
      VertexData& child = vertex[1];
      store(child.place,
            position_of(vertex->place) + (all(vertex->place[kCos]) * load(data.displacement) +
                                          all(vertex->place[kSin]) * load(data.turned)));
      child.from_edge = edge;
      const double dx = child.place[kX] - plan.reference_x[depth];
      const double dy = child.place[kY] - plan.reference_y[depth];
      const double across = dx * plan.contouring_x[depth] + dy * plan.contouring_y[depth];
      child.cost_to_come =
          vertex->cost_to_come + ((dx * dx + dy * dy) + across * across) + data.cost;
      if (depth + 1 < n) {
        child.trim = data.to;
        child.move = move_to(search, child, depth + 1, data);
        break;
      }
      if (child.cost_to_come < best) {
        best = child.cost_to_come;
        has_patience = true;
        for (std::size_t k = 0; k < n; ++k) {
          search.best_edges[k] = search.path[k + 1].from_edge;
          search.best_x[k] = search.path[k + 1].place[kX];
          search.best_y[k] = search.path[k + 1].place[kY];
        }
      }
      key = vertex->next_key;
    }

    if (search.expanded == next_check) {
      if (next_check == search.max_expansions || search.stop(search.stop_context)) {
        stop_early(search, depth, key);
        search.best_cost = best;
        return;
      }
      next_check = next_look(search);
      has_patience = best < kNoPath || search.expanded < kPatience;
    }
    ++depth;
    ++vertex;
  }
}

void expand_start(Search& search) {
  static_cast<void>(expand_by(search, search.path[0], 0, search.levels[0].num_blocks != 0));
}

bool is_free_entry(const Search& search, std::uint32_t edge, std::size_t step, VertexData& vertex) {
  return look_around(search, step, vertex) && is_free(search, edge, vertex);
}

#undef HLC_INLINE

}  // namespace
}  // namespace hlc::search::branch_and_bound
