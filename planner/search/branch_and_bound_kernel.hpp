// The inner loop of BranchAndBound. It is long-winded for speed: four children at a time, their
// bounds for two steps at a time, branches where they are foreseeable. Like its preparation,
// collision test and vectors (files of their own) it shares nothing with other files but the plain
// data of branch_and_bound_data.hpp. It is compiled twice, for any processor
// (branch_and_bound_portable.cpp) and with AVX2 (branch_and_bound_avx2.cpp); only these two include
// it. The same operations in the same order, no contraction: both give the same bits. No function
// here may be visible outside, and none from elsewhere be used, or the linker could mix the two.
//
// What it computes is said in branch_and_bound.hpp.
#pragma once

#include "planner/search/branch_and_bound_collision.hpp"
#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/branch_and_bound_preparation.hpp"
#include "planner/search/branch_and_bound_vectors.hpp"

namespace hlc::branch_and_bound {
namespace {

/// What a cost-to-go in single precision may be too large by: see TableStore::compute_bounds.
constexpr float kSurely = 1.0F - 0x5p-20F;

constexpr float kCos = 0x1.d906bcp-1F;  // cos and sin of 22.5 degrees
constexpr float kSin = 0x1.87de2ap-2F;

/// How far two reference points, the second and the third argument's `pair`, lie beyond the
/// intervals of four edges each, on the axis that has most; 0 within them all.
HLC_INLINE Floats distance_beyond(const BoundPair& bound, const float* along, std::size_t pair) {
  Floats beyond = all(0.0F);
#pragma GCC unroll 8
  for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
    const Floats from_centre =
        absolute(four_times_two(along + axis * kFloatLanes, pair) - load(bound.centre[axis]));
    beyond = larger(from_centre - load(bound.half_width[axis]), beyond);
  }
  return beyond;
}

/// As long as there is no path, costs-to-go only order the children. They know nothing of what is
/// in the way: where after so many expansions there still is none, they are not worth their time.
constexpr std::uint64_t kPatience = 4096;

/// How many of the level's pairs of steps the keys of its children look ahead.
HLC_INLINE std::size_t pairs_ahead(const Search& search, std::size_t depth, double best) {
  return best < kNoPath || search.expanded < kPatience ? search.levels[depth].num_pairs : 0;
}

/// Writes the keys of a vertex' children, with costs-to-go of the first `num_pairs` pairs of steps.
HLC_INLINE void expand(Search& search, VertexData& vertex, std::size_t depth,
                       std::size_t num_pairs) {
  constexpr std::size_t kPairs = kFloatLanes / 2;
  constexpr std::size_t kRow = kBoundAxes * kFloatLanes;
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];

  // The reference points after that of the edge, seen from the vertex, along each axis.
  const Placement at = placement_of(plan, vertex);
  float* along = search.projections;
  for (std::size_t pair = 0; pair < num_pairs; pair += kPairs) {
    const Floats dx = load(plan.reference_dx + depth + 1 + 2 * pair) - at.x;
    const Floats dy = load(plan.reference_dy + depth + 1 + 2 * pair) - at.y;
    const Floats ahead = dx * at.cos_heading + dy * at.sin_heading;
    const Floats aside = dy * at.cos_heading - dx * at.sin_heading;
    const Floats ahead_cos = ahead * all(kCos);
    const Floats ahead_sin = ahead * all(kSin);
    const Floats aside_cos = aside * all(kCos);
    const Floats aside_sin = aside * all(kSin);
    store(along, ahead);
    store(along + kFloatLanes, ahead_cos + aside_sin);
    store(along + 2 * kFloatLanes, (ahead + aside) * all(static_cast<float>(kDiagonal)));
    store(along + 3 * kFloatLanes, ahead_sin + aside_cos);
    store(along + 4 * kFloatLanes, aside);
    store(along + 5 * kFloatLanes, aside_cos - ahead_sin);
    store(along + 6 * kFloatLanes, (aside - ahead) * all(static_cast<float>(kDiagonal)));
    store(along + 7 * kFloatLanes, aside_sin - ahead_cos);
    along += kRow;
  }

  const double dx = plan.reference_x[depth] - vertex.x;
  const double dy = plan.reference_y[depth] - vertex.y;
  const Doubles ahead = all(dx * vertex.cos_heading + dy * vertex.sin_heading);
  const Doubles aside = all(dy * vertex.cos_heading - dx * vertex.sin_heading);
  const Doubles cost_to_come = all(vertex.cost_to_come);
  const std::size_t first_group = tables.first_group[vertex.trim];
  const std::size_t first_edge = kLanes * first_group;
  const std::size_t end_edge = std::size_t{kLanes} * tables.first_group[vertex.trim + 1];
  vertex.first_edge = static_cast<std::uint32_t>(first_edge);
  vertex.num_edges = static_cast<std::uint32_t>(end_edge - first_edge);
  const BoundPair* bounds = tables.bounds + first_group * tables.bound_size;
  double* const keys = vertex.keys;
  for (std::size_t edge = first_edge; edge < end_edge; edge += kLanes) {
    const Doubles beside_x = ahead - load(tables.displacement_x + edge);
    const Doubles beside_y = aside - load(tables.displacement_y + edge);
    const Doubles f =
        load(level.penalty + edge) + cost_to_come + (beside_x * beside_x + beside_y * beside_y);
    Floats to_go = all(0.0F);
    along = search.projections;
    for (std::size_t pair = 0; pair < num_pairs; ++pair) {
      const Floats beyond =
          distance_beyond(bounds[level.bounds[pair]], along + pair / kPairs * kRow, pair % kPairs);
      to_go += beyond * beyond;
    }
    store(keys + (edge - first_edge),
          numbered(f + halves_added(to_go * all(kSurely)), tables.index_mask,
                   load(tables.numbers + (edge - first_edge))));
    bounds += tables.bound_size;
  }
  search.generated += level.permitted[vertex.trim];
  ++search.expanded;
}

/// The least key of a vertex' children.
HLC_INLINE double least_key(const VertexData& vertex) {
  const double* const keys = vertex.keys;
  if (vertex.num_edges == kLanes) {
    // One by one: a key that has just been written cannot be read as part of a vector at once.
    const double low = keys[0] < keys[1] ? keys[0] : keys[1];
    const double high = keys[2] < keys[3] ? keys[2] : keys[3];
    return low < high ? low : high;
  }
  Doubles lowest = load(keys);
  for (std::uint32_t i = kLanes; i < vertex.num_edges; i += kLanes) {
    lowest = smaller(load(keys + i), lowest);
  }
  return least(lowest);
}

HLC_INLINE std::uint64_t bits(double value) {
  std::uint64_t result;
  __builtin_memcpy(&result, &value, sizeof result);
  return result;
}

void give_up(Search& search, std::size_t depth, double bound) {
  for (std::size_t k = 0; k <= depth; ++k) {
    const double open = least_key(search.path[k]);
    bound = open < bound ? open : bound;
  }
  search.lower_bound = bound;
  search.gave_up = true;
}

HLC_INLINE bool may_expand(const Search& search) {
  constexpr std::uint64_t kStopInterval = 64;
  return search.expanded != search.max_expansions &&
         (search.expanded % kStopInterval != 0 || !search.stop(search.stop_context));
}

void run(Search& search) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const std::size_t n = plan.horizon_steps;
  if (!may_expand(search)) {
    search.gave_up = true;  // the caller knows a bound for the start
    return;
  }
  expand(search, search.path[0], 0, search.levels[0].num_pairs);

  VertexData* vertex = search.path;
  std::size_t depth = 0;
  double best = search.best_cost;
  for (;;) {
    const double key = least_key(*vertex);
    if (!(key < best)) {
      if (depth == 0) break;
      --depth;
      --vertex;
      continue;
    }
    const auto number = static_cast<std::uint32_t>(bits(key) & tables.index_mask);
    vertex->keys[number] = kForbidden;
    const std::uint32_t edge = vertex->first_edge + number;
    if (!is_free(search, edge, depth + 1, *vertex)) continue;

    const EdgeData& data = tables.edges[edge];
    const double c = vertex->cos_heading;
    const double s = vertex->sin_heading;
    VertexData& child = vertex[1];
    child.x = vertex->x + c * data.x - s * data.y;
    child.y = vertex->y + s * data.x + c * data.y;
    child.from_edge = edge;
    const double dx = child.x - plan.reference_x[depth];
    const double dy = child.y - plan.reference_y[depth];
    child.cost_to_come = vertex->cost_to_come + (dx * dx + dy * dy) + data.cost;
    if (depth + 1 == n) {
      if (!(child.cost_to_come < best)) continue;
      best = child.cost_to_come;
      for (std::size_t k = 0; k < n; ++k) {
        search.best_edges[k] = search.path[k + 1].from_edge;
        search.best_x[k] = search.path[k + 1].x;
        search.best_y[k] = search.path[k + 1].y;
      }
      continue;
    }
    child.cos_heading = c * data.cos_heading - s * data.sin_heading;
    child.sin_heading = s * data.cos_heading + c * data.sin_heading;
    child.trim = data.to;
    if (!may_expand(search)) {
      give_up(search, depth, key);
      break;
    }
    ++depth;
    ++vertex;
    expand(search, child, depth, pairs_ahead(search, depth, best));
  }
  search.best_cost = best;
}

void expand_start(Search& search) { expand(search, search.path[0], 0, search.levels[0].num_pairs); }

bool is_free_entry(const Search& search, std::uint32_t edge, std::size_t step,
                   const VertexData& vertex) {
  return is_free(search, edge, step, vertex);
}

#undef HLC_INLINE

}  // namespace
}  // namespace hlc::branch_and_bound
