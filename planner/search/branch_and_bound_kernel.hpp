// The inner loop of BranchAndBound. It is long-winded for speed: everything four at a time,
// branches where they are foreseeable, nothing shared with other files but the plain data of
// branch_and_bound_data.hpp. It is compiled twice, for any processor
// (branch_and_bound_portable.cpp) and with AVX2 (branch_and_bound_avx2.cpp); only these two include
// it. The same operations in the same order, no contraction: both give the same bits. No function
// here may be visible outside, and none from elsewhere be used, or the linker could mix the two.
//
// What it computes is said in branch_and_bound.hpp.
#pragma once

#include "planner/search/branch_and_bound_collision.hpp"
#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/branch_and_bound_vectors.hpp"

namespace hlc::branch_and_bound {
namespace {

/// How far the reference point lies beyond each of four intervals, on the axis that has most; 0
/// within them all.
HLC_INLINE Doubles distance_beyond(const double* along, std::size_t stride,
                                   const double* intervals) {
  Doubles beyond = all(0.0);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const Doubles from_centre =
        absolute(all(along[axis * stride]) - load(intervals + 2 * axis * kLanes));
    beyond = larger(from_centre - load(intervals + (2 * axis + 1) * kLanes), beyond);
  }
  return beyond;
}

/// Writes the keys of a vertex' children.
HLC_INLINE void expand(Search& search, const VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];
  const std::size_t stride = search.projection_stride;
  double* const along = search.projections;

  // The reference points seen from the vertex, along each axis.
  const Doubles c = all(vertex.cos_heading);
  const Doubles s = all(vertex.sin_heading);
  const Doubles x = all(vertex.x);
  const Doubles y = all(vertex.y);
  for (std::size_t j = 0; j <= level.steps_left; j += kLanes) {
    const Doubles dx = load(plan.reference_x + depth + j) - x;
    const Doubles dy = load(plan.reference_y + depth + j) - y;
    const Doubles ahead = dx * c + dy * s;
    const Doubles aside = dy * c - dx * s;
    store(along + j, ahead);
    store(along + stride + j, (ahead + aside) * all(kDiagonal));
    store(along + 2 * stride + j, aside);
    store(along + 3 * stride + j, (aside - ahead) * all(kDiagonal));
  }

  const Doubles ahead = all(along[0]);
  const Doubles aside = all(along[2 * stride]);
  const Doubles cost_to_come = all(vertex.cost_to_come);
  const std::size_t first_edge = std::size_t{kLanes} * tables.first_group[vertex.trim];
  const std::size_t end_edge = std::size_t{kLanes} * tables.first_group[vertex.trim + 1];
  const double* bounds = tables.bounds + first_edge / kLanes * tables.bound_size;
  double* const keys = vertex.keys;
  for (std::size_t edge = first_edge; edge < end_edge; edge += kLanes) {
    const Doubles dx = ahead - load(tables.displacement_x + edge);
    const Doubles dy = aside - load(tables.displacement_y + edge);
    Doubles f = load(level.penalty + edge) + cost_to_come + (dx * dx + dy * dy);
    const double* reference = along + 1;
    const double* intervals = bounds + level.far;
    for (std::size_t i = 0; i < level.num_far; ++i) {
      const Doubles beyond = distance_beyond(reference++, stride, intervals);
      f += beyond * beyond;
      intervals += kBoundSize;
    }
    intervals = bounds + level.near;
    for (std::size_t i = 0; i < level.num_near; ++i) {
      const Doubles beyond = distance_beyond(reference++, stride, intervals);
      f += beyond * beyond;
      intervals -= tables.near_stride;
    }
    store(keys + (edge - first_edge),
          numbered(f, tables.index_mask, load(tables.numbers + (edge - first_edge))));
    bounds += tables.bound_size;
  }
  search.generated += level.permitted[vertex.trim];
  ++search.expanded;
}

/// The least key of a vertex' children.
HLC_INLINE double least_key(const Tables& tables, const VertexData& vertex) {
  const std::size_t groups = tables.first_group[vertex.trim + 1] - tables.first_group[vertex.trim];
  const double* const keys = vertex.keys;
  if (groups == 1) {
    // One by one: a key that has just been written cannot be read as part of a vector at once.
    const double low = keys[0] < keys[1] ? keys[0] : keys[1];
    const double high = keys[2] < keys[3] ? keys[2] : keys[3];
    return low < high ? low : high;
  }
  Doubles lowest = load(keys);
  for (std::size_t group = 1; group < groups; ++group) {
    lowest = smaller(load(keys + group * kLanes), lowest);
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
    const double open = least_key(*search.tables, search.path[k]);
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
  expand(search, search.path[0], 0);

  std::size_t depth = 0;
  double best = search.best_cost;
  for (;;) {
    VertexData& vertex = search.path[depth];
    const double key = least_key(tables, vertex);
    if (!(key < best)) {
      if (depth == 0) break;
      --depth;
      continue;
    }
    const auto number = static_cast<std::uint32_t>(bits(key) & tables.index_mask);
    vertex.keys[number] = kForbidden;
    vertex.taken = number;
    const std::uint32_t edge = tables.first_group[vertex.trim] * kLanes + number;
    if (!is_free(search, edge, depth + 1, vertex)) continue;

    const EdgeData& data = tables.edges[edge];
    const double c = vertex.cos_heading;
    const double s = vertex.sin_heading;
    VertexData& child = search.path[depth + 1];
    child.x = vertex.x + c * data.x - s * data.y;
    child.y = vertex.y + s * data.x + c * data.y;
    const double dx = child.x - plan.reference_x[depth];
    const double dy = child.y - plan.reference_y[depth];
    child.cost_to_come = vertex.cost_to_come + (dx * dx + dy * dy);
    if (depth + 1 == n) {
      if (!(child.cost_to_come < best)) continue;
      best = child.cost_to_come;
      for (std::size_t k = 0; k < n; ++k) {
        search.best_edges[k] =
            tables.first_group[search.path[k].trim] * kLanes + search.path[k].taken;
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
    expand(search, child, depth);
  }
  search.best_cost = best;
}

bool is_free_entry(const Search& search, std::uint32_t edge, std::size_t step,
                   const VertexData& vertex) {
  return is_free(search, edge, step, vertex);
}

#undef HLC_INLINE

}  // namespace
}  // namespace hlc::branch_and_bound
