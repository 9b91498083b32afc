// The inner loop of BranchAndBound. It is long-winded for speed: four children at a time, their
// bounds for four steps at a time, branches where they are foreseeable. Like its preparation,
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

/// The last numbers of 16 bits.
constexpr std::int16_t kLowest = -32768;
constexpr std::int16_t kHighest = 32767;

/// What a cost-to-go may be too large by: see TableStore::compute_bounds.
constexpr float kSurely = 1.0F - 0x5p-20F;

constexpr float kCos = 0x1.d906bcp-1F;  // cos and sin of 22.5 degrees
constexpr float kSin = 0x1.87de2ap-2F;

/// The reference points of four steps, seen from a vertex, along each axis [1 / Tables::units_per_m
/// m], each beside the intervals of a BoundBlock.
using Along = Shorts[kBoundAxes];

/// The reference points of eight steps, the second four only where asked for.
HLC_INLINE void project(const float* reference_dx, const float* reference_dy, const Placement& at,
                        float units_per_m, bool has_second, Along& first, Along& second) {
  const Floats dx = (load(reference_dx) - at.x) * all(units_per_m);
  const Floats dy = (load(reference_dy) - at.y) * all(units_per_m);
  const Floats ahead = dx * at.cos_heading + dy * at.sin_heading;
  const Floats aside = dy * at.cos_heading - dx * at.sin_heading;
  const Floats ahead_cos = ahead * all(kCos);
  const Floats ahead_sin = ahead * all(kSin);
  const Floats aside_cos = aside * all(kCos);
  const Floats aside_sin = aside * all(kSin);
  const Floats diagonal = all(static_cast<float>(kDiagonal));
  const Shorts along[kBoundAxes / 2] = {
      rounded(ahead, ahead_cos + aside_sin),
      rounded((ahead + aside) * diagonal, ahead_sin + aside_cos),
      rounded(aside, aside_cos - ahead_sin),
      rounded((aside - ahead) * diagonal, aside_sin - ahead_cos),
  };
#pragma GCC unroll 4
  for (std::size_t i = 0; i < kBoundAxes / 2; ++i) {
    first[2 * i] = four_times_four<0>(along[i]);
    first[2 * i + 1] = four_times_four<1>(along[i]);
  }
  if (!has_second) return;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < kBoundAxes / 2; ++i) {
    second[2 * i] = four_times_four<2>(along[i]);
    second[2 * i + 1] = four_times_four<3>(along[i]);
  }
}

/// Squared distances of four reference points from the intervals of four edges each, on the axis
/// that has most, 0 within them all; those of steps 0 and 1 added, edge by edge, and those of 2
/// and 3.
HLC_INLINE Floats squared_beyond(const BoundBlock& bound, const Along& along) {
  const auto beyond = [&](std::size_t axis) {
    return larger(difference(along[axis], load(bound.high[axis])),
                  difference(load(bound.low[axis]), along[axis]));
  };
  // By twos: a processor has the largest of eight after three steps.
  const Shorts first = larger(larger(beyond(0), beyond(1)), larger(beyond(2), beyond(3)));
  const Shorts second = larger(larger(beyond(4), beyond(5)), larger(beyond(6), beyond(7)));
  return squares_of_two_added(larger(larger(first, second), all_shorts(0)));
}

/// As long as there is no path, costs-to-go only order the children. They know nothing of what is
/// in the way: where after so many expansions there still is none, they are not worth their time.
constexpr std::uint64_t kPatience = 4096;

/// What the keys of a vertex' children are computed from.
struct Expansion {
  std::size_t first_group;
  std::size_t num_edges;  ///< with padding
  const double* penalty;  ///< these and the next of the first edge
  const double* displacement_x;
  const double* displacement_y;
  Doubles ahead;  ///< the next reference point, seen from the vertex
  Doubles aside;
  Doubles cost_to_come;
};

HLC_INLINE Expansion begin_expansion(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];
  const std::size_t first_group = tables.first_group[vertex.trim];
  const std::size_t first_edge = kLanes * first_group;
  const std::size_t num_edges = kLanes * (tables.first_group[vertex.trim + 1] - first_group);
  vertex.doubtful = Doubtful::kAll;
  vertex.first_edge = static_cast<std::uint32_t>(first_edge);
  vertex.num_edges = static_cast<std::uint32_t>(num_edges);
  search.generated += level.permitted[vertex.trim];
  ++search.expanded;
  const double dx = plan.reference_x[depth] - vertex.x;
  const double dy = plan.reference_y[depth] - vertex.y;
  return {first_group,
          num_edges,
          level.penalty + first_edge,
          tables.displacement_x + first_edge,
          tables.displacement_y + first_edge,
          all(dx * vertex.cos_heading + dy * vertex.sin_heading),
          all(dy * vertex.cos_heading - dx * vertex.sin_heading),
          all(vertex.cost_to_come)};
}

/// Cost-to-come of four edges' ends and what surely has to be paid after them.
HLC_INLINE Doubles cost_without_bound(const Expansion& expansion, std::size_t edge) {
  const Doubles beside_x = expansion.ahead - load(expansion.displacement_x + edge);
  const Doubles beside_y = expansion.aside - load(expansion.displacement_y + edge);
  return load(expansion.penalty + edge) + expansion.cost_to_come +
         (beside_x * beside_x + beside_y * beside_y);
}

HLC_INLINE Doubles keep_key(const Tables& tables, VertexData& vertex, std::size_t edge,
                            const Doubles& f) {
  const Doubles key = numbered(f, tables.index_mask, load(tables.numbers + edge));
  store(vertex.keys + edge, key);
  return key;
}

/// Writes the keys of a vertex' children without what the steps after their edges cost at least.
/// Returns the least.
HLC_INLINE double expand_without_bound(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Expansion expansion = begin_expansion(search, vertex, depth);
  Doubles lowest = keep_key(tables, vertex, 0, cost_without_bound(expansion, 0));
  for (std::size_t edge = kLanes; edge < expansion.num_edges; edge += kLanes) {
    lowest = smaller(keep_key(tables, vertex, edge, cost_without_bound(expansion, edge)), lowest);
  }
  return least(lowest);
}

/// Writes the keys of a vertex' children. Returns the least.
HLC_INLINE double expand(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const std::size_t num_blocks = search.levels[depth].num_blocks;
  const Floats scale = all(kSurely * tables.squared_unit_m2);
  const Placement at = placement_of(plan, vertex);
  const Expansion expansion = begin_expansion(search, vertex, depth);
  Doubles lowest = all(kForbidden);
  for (std::size_t block = 0;; block += 2) {
    // Eight steps at a time; what those before add up to waits in memory.
    const bool is_last = num_blocks <= block + 2;
    const bool has_second = num_blocks > block + 1;
    const std::size_t step = depth + 1 + kBoundSteps * block;
    Along first;
    Along second;
    project(plan.reference_dx + step, plan.reference_dy + step, at, tables.units_per_m, has_second,
            first, second);
    const std::uint32_t* const places = search.levels[depth].bounds + block;
    const BoundBlock* bounds = tables.bounds + expansion.first_group * tables.bound_size;
    for (std::size_t edge = 0; edge < expansion.num_edges; edge += kLanes) {
      Floats to_go = squared_beyond(bounds[places[0]], first);
      if (block != 0) to_go += load(search.to_go + 2 * edge);
      if (has_second) to_go += squared_beyond(bounds[places[1]], second);
      bounds += tables.bound_size;
      if (is_last) {
        const Doubles f = cost_without_bound(expansion, edge) + halves_added(to_go * scale);
        lowest = smaller(keep_key(tables, vertex, edge, f), lowest);
      } else {
        store(search.to_go + 2 * edge, to_go);
      }
    }
    if (is_last) return least(lowest);
  }
}

/// Where a reference point, seen from a vertex, lies along each axis [1 / Tables::units_per_m m].
struct Seen {
  float along[kBoundAxes];
};

HLC_INLINE Seen see(const Plan& plan, std::size_t step, const VertexData& at, float units_per_m) {
  const auto c = static_cast<float>(at.cos_heading);
  const auto s = static_cast<float>(at.sin_heading);
  const float dx =
      (plan.reference_dx[step] - static_cast<float>(at.x - plan.origin_x)) * units_per_m;
  const float dy =
      (plan.reference_dy[step] - static_cast<float>(at.y - plan.origin_y)) * units_per_m;
  const float ahead = dx * c + dy * s;
  const float aside = dy * c - dx * s;
  const auto diagonal = static_cast<float>(kDiagonal);
  return {{ahead, ahead * kCos + aside * kSin, (ahead + aside) * diagonal,
           ahead * kSin + aside * kCos, aside, aside * kCos - ahead * kSin,
           (aside - ahead) * diagonal, aside * kSin - ahead * kCos}};
}

/// How far a reference point lies beyond an interval of a block, on the axis that has most. Ends
/// that are saturated bound nothing.
HLC_INLINE float beyond(const BoundBlock& bound, std::size_t interval, const Seen& seen) {
  constexpr float kMost = 1e18F;  // its square, and the sum of many, are still numbers
  float most = 0.0F;
  for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
    const std::int16_t low = bound.low[axis][interval];
    const std::int16_t high = bound.high[axis][interval];
    const float below = low == kLowest ? 0.0F : static_cast<float>(low) - seen.along[axis];
    const float above = high == kHighest ? 0.0F : seen.along[axis] - static_cast<float>(high);
    most = below > most ? below : most;
    most = above > most ? above : most;
  }
  return most < kMost ? most : kMost;
}

/// As `expand`, for reference points so far away that places are no numbers of 16 bits: one edge
/// and step at a time.
double expand_far(Search& search, VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const Level& level = search.levels[depth];
  const Expansion expansion = begin_expansion(search, vertex, depth);
  const BoundBlock* bounds = tables.bounds + expansion.first_group * tables.bound_size;
  Doubles lowest = all(kForbidden);
  for (std::size_t edge = 0; edge < expansion.num_edges; edge += kLanes) {
    float to_go[kLanes] = {};
    for (std::size_t block = 0; block < level.num_blocks; ++block) {
      for (std::size_t step = 0; step < kBoundSteps; ++step) {
        const Seen seen =
            see(plan, depth + 1 + kBoundSteps * block + step, vertex, tables.units_per_m);
        for (std::size_t e = 0; e < kLanes; ++e) {
          const float distance =
              beyond(bounds[level.bounds[block]], 8 * (step / 2) + 2 * e + step % 2, seen);
          to_go[e] += distance * distance;
        }
      }
    }
    bounds += tables.bound_size;
    const float scale = kSurely * tables.squared_unit_m2;
    const Doubles costs_to_go{
        static_cast<double>(to_go[0] * scale), static_cast<double>(to_go[1] * scale),
        static_cast<double>(to_go[2] * scale), static_cast<double>(to_go[3] * scale)};
    const Doubles f = cost_without_bound(expansion, edge) + costs_to_go;
    lowest = smaller(keep_key(tables, vertex, edge, f), lowest);
  }
  return least(lowest);
}

/// Writes the keys of a vertex' children, with a bound or without. Returns the least.
HLC_INLINE double expand_by(Search& search, VertexData& vertex, std::size_t depth, bool has_bound) {
  if (!has_bound) return expand_without_bound(search, vertex, depth);
  return search.plan->is_far ? expand_far(search, vertex, depth) : expand(search, vertex, depth);
}

/// Takes away the child with this key, the vertex' least, and notes the least of the others. At
/// once, while the child is looked at: where the search comes back to the vertex, it knows how to
/// go on.
/// @pre denormal numbers are compared as they are: where f is 0 keys hold the child's number alone
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

HLC_INLINE std::uint64_t bits(double value) {
  std::uint64_t result;
  __builtin_memcpy(&result, &value, sizeof result);
  return result;
}

void give_up(Search& search, std::size_t depth, double bound) {
  for (std::size_t k = 0; k <= depth; ++k) {
    const double open = search.path[k].next_key;
    bound = open < bound ? open : bound;
  }
  search.lower_bound = bound;
  search.gave_up = true;
}

/// Expansions between two looks at whether to stop.
constexpr std::uint64_t kStopInterval = 64;

/// So many expansions may be done before the next look.
HLC_INLINE std::uint64_t next_look(const Search& search) {
  const std::uint64_t next = search.expanded + kStopInterval;
  return next < search.max_expansions ? next : search.max_expansions;
}

void run(Search& search) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const std::size_t n = plan.horizon_steps;
  if (search.max_expansions == 0 || search.stop(search.stop_context)) {
    search.gave_up = true;  // the caller knows a bound for the start
    return;
  }
  std::uint64_t look_at = next_look(search);
  VertexData* vertex = search.path;
  std::size_t depth = 0;
  double best = search.best_cost;
  bool has_patience = true;
  for (;;) {
    const bool has_bound = search.levels[depth].num_blocks != 0 && has_patience;
    double key = expand_by(search, *vertex, depth, has_bound);
    if (key < best) key = look_at_obstacles(search, depth + 1, *vertex, key, best);

    // The next vertex to expand: the first free child that is worth it, here or further back.
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
      if (!is_free(search, number, depth + 1, *vertex)) {
        key = vertex->next_key;
        continue;
      }

      const std::uint32_t edge = vertex->first_edge + number;
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
      if (depth + 1 < n) {
        child.cos_heading = c * data.cos_heading - s * data.sin_heading;
        child.sin_heading = s * data.cos_heading + c * data.sin_heading;
        child.trim = data.to;
        break;
      }
      if (child.cost_to_come < best) {
        best = child.cost_to_come;
        has_patience = true;
        for (std::size_t k = 0; k < n; ++k) {
          search.best_edges[k] = search.path[k + 1].from_edge;
          search.best_x[k] = search.path[k + 1].x;
          search.best_y[k] = search.path[k + 1].y;
        }
      }
      key = vertex->next_key;
    }

    if (search.expanded == look_at) {
      if (look_at == search.max_expansions || search.stop(search.stop_context)) {
        give_up(search, depth, key);
        search.best_cost = best;
        return;
      }
      look_at = next_look(search);
      has_patience = best < kNoPath || search.expanded < kPatience;
    }
    ++depth;
    ++vertex;
  }
}

void expand_start(Search& search) {
  static_cast<void>(expand_by(search, search.path[0], 0, search.levels[0].num_blocks != 0));
}

bool is_free_entry(const Search& search, std::uint32_t edge, std::size_t step, VertexData& vertex,
                   bool among_all) {
  const Tables& tables = *search.tables;
  vertex.first_edge = kLanes * tables.first_group[vertex.trim];
  vertex.num_edges = kLanes * tables.first_group[vertex.trim + 1] - vertex.first_edge;
  const std::uint32_t number = edge - vertex.first_edge;
  vertex.keys[number] = 0.0;
  vertex.doubtful = Doubtful::kAll;
  if (among_all) static_cast<void>(forbid_met(search, step, vertex, 0.0));
  return vertex.keys[number] < kForbidden && is_free(search, number, step, vertex);
}

#undef HLC_INLINE

}  // namespace
}  // namespace hlc::branch_and_bound
