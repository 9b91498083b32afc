// The inner loop of BranchAndBound. It is long-winded for speed: everything four at a time,
// branches where they are foreseeable, nothing shared with other files but the plain data of
// branch_and_bound_data.hpp. It is compiled twice, for any processor
// (branch_and_bound_portable.cpp) and with AVX2 (branch_and_bound_avx2.cpp); only these two include
// it. The same operations in the same order, no contraction: both give the same bits. No function
// here may be visible outside, and none from elsewhere be used, or the linker could mix the two.
//
// What it computes is said in branch_and_bound.hpp.

#include "planner/search/branch_and_bound_data.hpp"

namespace hlc::branch_and_bound {
namespace {

using Vector = double __attribute__((vector_size(32)));
using Bits = long long __attribute__((vector_size(32)));
/// The same in memory, at any address of a double.
using VectorInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
using BitsInMemory = long long __attribute__((vector_size(32), aligned(8), may_alias));

#define HLC_INLINE [[gnu::always_inline]] inline

HLC_INLINE Vector load(const double* from) {
  return *reinterpret_cast<const VectorInMemory*>(from);
}
HLC_INLINE void store(double* to, const Vector& value) {
  *reinterpret_cast<VectorInMemory*>(to) = value;
}
HLC_INLINE Vector all(double value) { return Vector{value, value, value, value}; }
HLC_INLINE Vector smaller(const Vector& a, const Vector& b) { return a < b ? a : b; }
HLC_INLINE Vector larger(const Vector& a, const Vector& b) { return a > b ? a : b; }
HLC_INLINE Vector absolute(const Vector& a) {
  constexpr long long kNoSign = 0x7fff'ffff'ffff'ffff;
  return reinterpret_cast<Vector>(reinterpret_cast<Bits>(a) &
                                  Bits{kNoSign, kNoSign, kNoSign, kNoSign});
}
HLC_INLINE double least(const Vector& a) {
  const double low = a[0] < a[1] ? a[0] : a[1];
  const double high = a[2] < a[3] ? a[2] : a[3];
  return low < high ? low : high;
}
HLC_INLINE double largest(const Vector& a) {
  const double low = a[0] > a[1] ? a[0] : a[1];
  const double high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

enum class Answer { kApart, kMeet, kTooClose };

/// Separating-axis test of an area and an obstacle in the area's frame.
HLC_INLINE Answer compare(const Search& search, const Area& area, const ObstacleData& obstacle,
                          const VertexData& vertex) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const double tolerance = plan.tolerance;
  const double c = vertex.cos_heading;
  const double s = vertex.sin_heading;
  const double* const area_x = tables.area_x + area.first;
  const double* const area_y = tables.area_y + area.first;
  Vector most_apart = all(-kForbidden);

  // The obstacle's normals, four at a time, against the corners of the area.
  for (std::uint32_t i = 0; i < obstacle.size; i += kLanes) {
    const Vector world_x = load(plan.obstacle_normal_x + obstacle.first + i);
    const Vector world_y = load(plan.obstacle_normal_y + obstacle.first + i);
    const Vector offset = load(plan.obstacle_offset + obstacle.first + i) -
                          (world_x * all(vertex.x) + world_y * all(vertex.y));
    const Vector normal_x = world_x * all(c) + world_y * all(s);
    const Vector normal_y = world_y * all(c) - world_x * all(s);
    Vector nearest = all(kForbidden);
    for (std::uint32_t a = 0; a < area.size; ++a) {
      nearest = smaller(normal_x * all(area_x[a]) + normal_y * all(area_y[a]), nearest);
    }
    most_apart = larger(nearest - offset, most_apart);
    if (largest(most_apart) > tolerance) return Answer::kApart;
  }

  // The obstacle's corners seen from the vertex, against the area's normals.
  double* const corner_x = search.corners;
  double* const corner_y = search.corners + search.corner_stride;
  for (std::uint32_t i = 0; i < obstacle.size; i += kLanes) {
    const Vector dx = load(plan.obstacle_x + obstacle.first + i) - all(vertex.x);
    const Vector dy = load(plan.obstacle_y + obstacle.first + i) - all(vertex.y);
    store(corner_x + i, dx * all(c) + dy * all(s));
    store(corner_y + i, dy * all(c) - dx * all(s));
  }
  for (std::uint32_t i = 0; i < area.size; i += kLanes) {
    const Vector normal_x = load(tables.area_normal_x + area.first + i);
    const Vector normal_y = load(tables.area_normal_y + area.first + i);
    Vector nearest = all(kForbidden);
    for (std::uint32_t b = 0; b < obstacle.size; ++b) {
      nearest = smaller(normal_x * all(corner_x[b]) + normal_y * all(corner_y[b]), nearest);
    }
    most_apart = larger(nearest - load(tables.area_offset + area.first + i), most_apart);
  }
  const double apart = largest(most_apart);
  if (apart > tolerance) return Answer::kApart;
  return apart < -tolerance ? Answer::kMeet : Answer::kTooClose;
}

/// The same for a boundary segment, with its ends seen from the vertex.
HLC_INLINE Answer compare_segment(const Search& search, const Area& area, double from_x,
                                  double from_y, double to_x, double to_y) {
  const Tables& tables = *search.tables;
  const double tolerance = search.plan->tolerance;
  Vector most_apart = all(-kForbidden);
  for (std::uint32_t i = 0; i < area.size; i += kLanes) {
    const Vector normal_x = load(tables.area_normal_x + area.first + i);
    const Vector normal_y = load(tables.area_normal_y + area.first + i);
    const Vector nearest = smaller(normal_x * all(from_x) + normal_y * all(from_y),
                                   normal_x * all(to_x) + normal_y * all(to_y));
    most_apart = larger(nearest - load(tables.area_offset + area.first + i), most_apart);
  }
  const double along_x = to_x - from_x;
  const double along_y = to_y - from_y;
  Vector leftmost = all(-kForbidden);
  Vector rightmost = all(kForbidden);
  for (std::uint32_t i = 0; i < area.size; i += kLanes) {
    const Vector dx = load(tables.area_x + area.first + i) - all(from_x);
    const Vector dy = load(tables.area_y + area.first + i) - all(from_y);
    const Vector side = all(along_x) * dy - all(along_y) * dx;
    leftmost = larger(side, leftmost);
    rightmost = smaller(side, rightmost);
  }
  const double right = least(rightmost);
  const double left = -largest(leftmost);
  double apart = largest(most_apart);
  apart = right > apart ? right : apart;
  apart = left > apart ? left : apart;
  if (apart > tolerance) return Answer::kApart;
  return apart < -tolerance ? Answer::kMeet : Answer::kTooClose;
}

bool meets_obstacle(const Search& search, std::uint32_t edge, std::size_t step,
                    const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].swept;
  const double x =
      vertex.x + vertex.cos_heading * area.centre_x - vertex.sin_heading * area.centre_y;
  const double y =
      vertex.y + vertex.sin_heading * area.centre_x + vertex.cos_heading * area.centre_y;
  const double radius = area.radius + plan.circle_slack;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];
       i += kLanes) {
    const Vector dx = load(plan.circle_x + i) - all(x);
    const Vector dy = load(plan.circle_y + i) - all(y);
    const Vector reach = load(plan.circle_radius + i) + all(radius);
    const Vector gap = dx * dx + dy * dy - reach * reach;
    if (least(gap) > 0.0) continue;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (gap[lane] > 0.0) continue;
      const Answer answer = compare(search, area, plan.obstacles[i + lane], vertex);
      if (answer == Answer::kMeet) return true;
      if (answer == Answer::kTooClose &&
          search.decides(search.decides_context, {edge, false, i + lane, &vertex})) {
        return true;
      }
    }
  }
  return false;
}

bool meets_segment(const Search& search, std::uint32_t edge, std::size_t step,
                   const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].lane;
  const Vector c = all(vertex.cos_heading);
  const Vector s = all(vertex.sin_heading);
  const double slack = plan.circle_slack;
  for (std::uint32_t i = 0; i < plan.num_segments[step - 1]; i += kLanes) {
    const Vector from_dx = load(plan.from_x + i) - all(vertex.x);
    const Vector from_dy = load(plan.from_y + i) - all(vertex.y);
    const Vector to_dx = load(plan.to_x + i) - all(vertex.x);
    const Vector to_dy = load(plan.to_y + i) - all(vertex.y);
    const Vector from_x = from_dx * c + from_dy * s;
    const Vector from_y = from_dy * c - from_dx * s;
    const Vector to_x = to_dx * c + to_dy * s;
    const Vector to_y = to_dy * c - to_dx * s;
    // How far the segments' boxes are from that of the area.
    const Vector beside_x =
        larger(smaller(from_x, to_x) - all(area.max_x), all(area.min_x) - larger(from_x, to_x));
    const Vector beside_y =
        larger(smaller(from_y, to_y) - all(area.max_y), all(area.min_y) - larger(from_y, to_y));
    const Vector beside = larger(beside_x, beside_y);
    if (least(beside) > slack) continue;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (beside[lane] > slack) continue;
      const Answer answer =
          compare_segment(search, area, from_x[lane], from_y[lane], to_x[lane], to_y[lane]);
      if (answer == Answer::kMeet) return true;
      if (answer == Answer::kTooClose &&
          search.decides(search.decides_context, {edge, true, i + lane, &vertex})) {
        return true;
      }
    }
  }
  return false;
}

HLC_INLINE bool is_free(const Search& search, std::uint32_t edge, std::size_t step,
                        const VertexData& vertex) {
  if (search.plan->has_obstacles && meets_obstacle(search, edge, step, vertex)) return false;
  return !search.plan->has_segments || !meets_segment(search, edge, step, vertex);
}

/// Writes the keys of a vertex' children.
HLC_INLINE void expand(Search& search, const VertexData& vertex, std::size_t depth) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const std::size_t steps_left = plan.horizon_steps - depth - 1;  // after the edge
  const std::size_t cap = tables.max_steps_left;
  const std::size_t left = steps_left < cap ? steps_left : cap;
  const std::size_t stride = search.projection_stride;
  double* const along = search.projections;

  // The reference points seen from the vertex, along each axis.
  constexpr double kDiagonal = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
  const Vector c = all(vertex.cos_heading);
  const Vector s = all(vertex.sin_heading);
  for (std::size_t j = 0; j <= steps_left; j += kLanes) {
    const Vector dx = load(plan.reference_x + depth + j) - all(vertex.x);
    const Vector dy = load(plan.reference_y + depth + j) - all(vertex.y);
    const Vector ahead = dx * c + dy * s;
    const Vector aside = dy * c - dx * s;
    store(along + j, ahead);
    store(along + stride + j, (ahead + aside) * all(kDiagonal));
    store(along + 2 * stride + j, aside);
    store(along + 3 * stride + j, (aside - ahead) * all(kDiagonal));
  }

  const std::uint32_t first_group = tables.first_group[vertex.trim];
  const std::uint32_t end_group = tables.first_group[vertex.trim + 1];
  const double* const penalty = search.penalty + left * tables.num_groups * kLanes;
  const std::size_t row = (cap + 1) * kBoundSize;
  const long long mask = static_cast<long long>(tables.index_mask);
  Bits number{0, 1, 2, 3};
  double* keys = vertex.keys;
  for (std::uint32_t group = first_group; group < end_group; ++group) {
    const std::size_t edge = group * kLanes;
    const Vector dx = all(along[0]) - load(tables.displacement_x + edge);
    const Vector dy = all(along[2 * stride]) - load(tables.displacement_y + edge);
    Vector f = load(penalty + edge) + all(vertex.cost_to_come) + (dx * dx + dy * dy);
    const double* const bounds = tables.bounds + group * tables.bound_steps * row;
    for (std::size_t j = 1; j <= steps_left; ++j) {
      const std::size_t after = steps_left - j < cap ? steps_left - j : cap;
      const double* const bound = bounds + (j - 1) * row + after * kBoundSize;
      Vector beyond = all(0.0);
      for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const Vector from_centre =
            absolute(all(along[axis * stride + j]) - load(bound + 2 * axis * kLanes));
        beyond = larger(from_centre - load(bound + (2 * axis + 1) * kLanes), beyond);
      }
      f += beyond * beyond;
    }
    const Bits key = (reinterpret_cast<Bits>(f) & Bits{~mask, ~mask, ~mask, ~mask}) | number;
    *reinterpret_cast<BitsInMemory*>(keys) = key;
    keys += kLanes;
    number += Bits{4, 4, 4, 4};
  }
  search.generated += search.permitted[left * tables.num_trims + vertex.trim];
  ++search.expanded;
}

/// The least key of a vertex' children.
HLC_INLINE double least_key(const Tables& tables, const VertexData& vertex) {
  const std::size_t groups = tables.first_group[vertex.trim + 1] - tables.first_group[vertex.trim];
  Vector lowest = load(vertex.keys);
  for (std::size_t group = 1; group < groups; ++group) {
    lowest = smaller(load(vertex.keys + group * kLanes), lowest);
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
    const std::uint32_t edge =
        tables.first_group[vertex.trim] * static_cast<std::uint32_t>(kLanes) + number;
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
            tables.first_group[search.path[k].trim] * static_cast<std::uint32_t>(kLanes) +
            search.path[k].taken;
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
