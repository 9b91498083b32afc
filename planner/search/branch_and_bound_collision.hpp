// The collision test of BranchAndBound's inner loop: separating axes in single precision, eight
// obstacles, edges, corners or boundary segments at a time. Long-winded for speed; compiled twice,
// as branch_and_bound_kernel.hpp, and for the same reason self-contained.
//
// Distances are computed relative to the plan's start, where coordinates are small. Each step of
// the computation rounds by half a unit in the last place, 2^-24 of the largest coordinate S, or
// twice that after a rotation; from corners, normals, rectangles and placements to a distance they
// add up to less than 64 of them. The tolerance is 2^-18 S. What is apart or overlaps by more is
// certain; what is between is asked of Search::decides.
#pragma once

#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/branch_and_bound_preparation.hpp"
#include "planner/search/branch_and_bound_vectors.hpp"

namespace hlc::branch_and_bound {
namespace {

/// A vertex in single precision, relative to the plan's start.
struct Placement {
  Floats x;
  Floats y;
  Floats cos_heading;
  Floats sin_heading;
};

HLC_INLINE Placement placement_of(const Plan& plan, const VertexData& vertex) {
  return {all(static_cast<float>(vertex.x - plan.origin_x)),
          all(static_cast<float>(vertex.y - plan.origin_y)),
          all(static_cast<float>(vertex.cos_heading)), all(static_cast<float>(vertex.sin_heading))};
}

/// Moves the blocks of an area from its own frame to the plan's.
HLC_INLINE void place(const PolygonBlock* from, const Placement& at, std::uint32_t num_blocks,
                      PolygonBlock* to) {
  for (std::uint32_t i = 0; i < num_blocks; ++i) {
    const Floats x = load(from[i].x);
    const Floats y = load(from[i].y);
    const Floats normal_x = load(from[i].normal_x);
    const Floats normal_y = load(from[i].normal_y);
    const Floats placed_normal_x = at.cos_heading * normal_x - at.sin_heading * normal_y;
    const Floats placed_normal_y = at.sin_heading * normal_x + at.cos_heading * normal_y;
    store(to[i].x, at.x + (at.cos_heading * x - at.sin_heading * y));
    store(to[i].y, at.y + (at.sin_heading * x + at.cos_heading * y));
    store(to[i].normal_x, placed_normal_x);
    store(to[i].normal_y, placed_normal_y);
    store(to[i].offset, load(from[i].offset) + (placed_normal_x * at.x + placed_normal_y * at.y));
  }
}

/// How far the nearest corner of `other` lies beyond each edge of one block of a polygon.
HLC_INLINE Floats beyond_edges(const PolygonBlock& block, const PolygonBlock* other,
                               std::uint32_t num_blocks) {
  const Floats normal_x = load(block.normal_x);
  const Floats normal_y = load(block.normal_y);
  Floats nearest = all(kFarAway);
  for (std::uint32_t i = 0; i < num_blocks; ++i) {
    const auto along = [&](std::uint32_t k) {
      return normal_x * all(other[i].x[k]) + normal_y * all(other[i].y[k]);
    };
    const Floats low = smaller(smaller(along(0), along(1)), smaller(along(2), along(3)));
    const Floats high = smaller(smaller(along(4), along(5)), smaller(along(6), along(7)));
    nearest = smaller(smaller(low, high), nearest);
  }
  return nearest - load(block.offset);
}

enum class Answer { kApart, kMeet, kTooClose };

/// Do a placed area and an obstacle meet? A separating-axis test.
HLC_INLINE Answer compare(const PolygonBlock* area, std::uint32_t area_blocks,
                          const PolygonBlock* obstacle, std::uint32_t obstacle_blocks,
                          const Floats& tolerance) {
  Floats most_apart = all(-kFarAway);
  for (std::uint32_t i = 0; i < obstacle_blocks; ++i) {
    most_apart = larger(beyond_edges(obstacle[i], area, area_blocks), most_apart);
  }
  if (lanes_less(tolerance, most_apart) != 0) return Answer::kApart;
  for (std::uint32_t i = 0; i < area_blocks; ++i) {
    most_apart = larger(beyond_edges(area[i], obstacle, obstacle_blocks), most_apart);
  }
  if (lanes_less(tolerance, most_apart) != 0) return Answer::kApart;
  const Floats inside = all(0.0F) - tolerance;
  return lanes_less(most_apart, inside) == kEveryLane ? Answer::kMeet : Answer::kTooClose;
}

/// Eight times a rectangle and another one.
struct Beside {
  Floats ahead;  ///< distance of the centres along the axes of the first
  Floats aside;
  Floats other_ahead;  ///< along those of the second
  Floats other_aside;
  Floats c;  ///< cosine and sine between the axes; all six without their signs
  Floats s;
};

/// Centres of rectangles and the directions of their first axes.
struct Centres {
  Floats x;
  Floats y;
  Floats along_x;
  Floats along_y;
};

HLC_INLINE Beside beside(const Centres& own, const Centres& other) {
  const Floats dx = other.x - own.x;
  const Floats dy = other.y - own.y;
  return {absolute(dx * own.along_x + dy * own.along_y),
          absolute(dy * own.along_x - dx * own.along_y),
          absolute(dx * other.along_x + dy * other.along_y),
          absolute(dy * other.along_x - dx * other.along_y),
          absolute(own.along_x * other.along_x + own.along_y * other.along_y),
          absolute(own.along_x * other.along_y - own.along_y * other.along_x)};
}

/// How far rectangles with half these sizes are apart on the axis that separates them most.
HLC_INLINE Floats most_apart(const Beside& at, const Floats& along, const Floats& aside,
                             const Floats& other_along, const Floats& other_aside) {
  const Floats own = larger(at.ahead - (along + (at.c * other_along + at.s * other_aside)),
                            at.aside - (aside + (at.s * other_along + at.c * other_aside)));
  const Floats other = larger(at.other_ahead - (other_along + (at.c * along + at.s * aside)),
                              at.other_aside - (other_aside + (at.s * along + at.c * aside)));
  return larger(own, other);
}

/// Makes those of eight obstacles ready that are near and not ready yet. Were there any?
HLC_INLINE bool prepare_fresh(const Plan& plan, std::uint32_t first, std::uint32_t near) {
  std::uint32_t fresh = near & ~plan.obstacle_rectangles[first / kFloatLanes].is_ready;
  if (fresh == 0) return false;
  for (; fresh != 0; fresh &= fresh - 1) {
    make_ready(plan, first + static_cast<std::uint32_t>(__builtin_ctz(fresh)));
  }
  return true;
}

/// Obstacles of a step that what is around all edges out of a vertex does not surely miss, seen
/// from the vertex. Returns how many.
HLC_INLINE std::uint32_t list_near(const Search& search, std::size_t step, const Placement& at,
                                   const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Rectangles& around = search.tables->around[vertex.trim];
  const Centres own{all(around.x), all(around.y), all(around.along_x), all(around.along_y)};
  const Floats tolerance = all(plan.tolerance);
  std::uint32_t count = 0;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];) {
    const ObstaclesBlock& obstacles = plan.obstacle_rectangles[i / kFloatLanes];
    const RectanglesBlock& block = obstacles.rectangles;
    const Floats dx = load(block.x) - at.x;
    const Floats dy = load(block.y) - at.y;
    const Floats along_x = load(block.along_x);
    const Floats along_y = load(block.along_y);
    const Centres seen{at.cos_heading * dx + at.sin_heading * dy,
                       at.cos_heading * dy - at.sin_heading * dx,
                       at.cos_heading * along_x + at.sin_heading * along_y,
                       at.cos_heading * along_y - at.sin_heading * along_x};
    const Floats outer =
        most_apart(beside(own, seen), all(around.outer_along), all(around.outer_aside),
                   load(block.outer_along), load(block.outer_aside));
    // What is not surely apart, so that a distance that is no number is looked at.
    std::uint32_t near = obstacles.is_there & ~lanes_less(tolerance, outer);
    if (prepare_fresh(plan, i, near)) continue;  // with their own rectangles now
    if (near != 0) {
      alignas(32) float x[kFloatLanes];
      alignas(32) float y[kFloatLanes];
      alignas(32) float axis_x[kFloatLanes];
      alignas(32) float axis_y[kFloatLanes];
      store(x, seen.x);
      store(y, seen.y);
      store(axis_x, seen.along_x);
      store(axis_y, seen.along_y);
      for (; near != 0; near &= near - 1) {
        const auto lane = static_cast<std::uint32_t>(__builtin_ctz(near));
        plan.near[count++] = {x[lane],
                              y[lane],
                              axis_x[lane],
                              axis_y[lane],
                              block.outer_along[lane],
                              block.outer_aside[lane],
                              block.inner_along[lane],
                              block.inner_aside[lane]};
      }
    }
    i += kFloatLanes;
  }
  return count;
}

/// What rectangles say of eight edges and obstacles, one bit per edge.
struct Compared {
  std::uint32_t apart;  ///< surely free
  std::uint32_t met;    ///< surely not
};

HLC_INLINE Compared compare_eight(const RectanglesBlock& eight, const Rectangles* near,
                                  std::uint32_t num_near, const Floats& tolerance) {
  const Centres own{load(eight.x), load(eight.y), load(eight.along_x), load(eight.along_y)};
  const Floats outer_along = load(eight.outer_along);
  const Floats outer_aside = load(eight.outer_aside);
  const Floats inner_along = load(eight.inner_along);
  const Floats inner_aside = load(eight.inner_aside);
  const Floats inside = all(0.0F) - tolerance;
  Compared result{kEveryLane, 0};
  for (std::uint32_t i = 0; i < num_near; ++i) {
    const Rectangles& other = near[i];
    const Beside at =
        beside(own, {all(other.x), all(other.y), all(other.along_x), all(other.along_y)});
    const Floats outer =
        most_apart(at, outer_along, outer_aside, all(other.outer_along), all(other.outer_aside));
    const Floats inner =
        most_apart(at, inner_along, inner_aside, all(other.inner_along), all(other.inner_aside));
    result.apart &= lanes_less(tolerance, outer);
    result.met |= lanes_less(inner, inside);
  }
  return result;
}

/// Compares the rectangles of all edges out of a vertex with those of the obstacles near them:
/// forbids the edges that surely meet one, and notes of which it stays open.
/// @param key  the least of the vertex
/// Returns the least that is left.
HLC_INLINE double forbid_met(const Search& search, std::size_t step, VertexData& vertex,
                             double key) {
  const Plan& plan = *search.plan;
  vertex.doubtful = Doubtful::kNone;
  const std::uint32_t num_near = list_near(search, step, placement_of(plan, vertex), vertex);
  if (num_near == 0) return key;
  vertex.doubtful = Doubtful::kNoted;
  const RectanglesBlock* eight =
      search.tables->rectangles + search.tables->first_rectangles[vertex.trim];
  const Floats tolerance = all(plan.tolerance);
  Doubles lowest = all(kForbidden);
  for (std::uint32_t edge = 0; edge < vertex.num_edges; edge += kFloatLanes, ++eight) {
    const Compared compared = compare_eight(*eight, plan.near, num_near, tolerance);
    vertex.doubts[edge / kFloatLanes] = static_cast<std::uint8_t>(kEveryLane & ~compared.apart);
    for (std::uint32_t i = edge; i < edge + kFloatLanes && i < vertex.num_edges; i += kLanes) {
      const Doubles keys =
          where_set(compared.met >> (i - edge), all(kForbidden), load(vertex.keys + i));
      store(vertex.keys + i, keys);
      lowest = smaller(keys, lowest);
    }
  }
  return least(lowest);
}

/// So many children to try are not worth to compare all edges at once.
constexpr int kFewChildren = 1;

/// Which edges out of a vertex meet an obstacle? Forbids some of those that do, and notes of which
/// it stays open until they are tried.
/// @param key  the least of the vertex
/// Returns the least that is left.
HLC_INLINE double look_at_obstacles(const Search& search, std::size_t step, VertexData& vertex,
                                    double key, double best) {
  const Plan& plan = *search.plan;
  if (plan.first_obstacle[step - 1] == plan.first_obstacle[step]) {
    vertex.doubtful = Doubtful::kNone;
    return key;
  }
  int num_children = 0;
  for (std::uint32_t edge = 0; edge < vertex.num_edges; edge += kLanes) {
    num_children += __builtin_popcount(lanes_less(load(vertex.keys + edge), all(best)));
  }
  return num_children > kFewChildren ? forbid_met(search, step, vertex, key) : key;
}

/// Does the edge to a child meet an obstacle? Rectangles decide most; then a separating-axis test.
bool meets_obstacle(const Search& search, std::uint32_t number, std::size_t step,
                    const Placement& at, const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Tables& tables = *search.tables;
  const std::uint32_t edge = vertex.first_edge + number;
  const Area& area = tables.edges[edge].swept;
  const RectanglesBlock& eight =
      tables.rectangles[tables.first_rectangles[vertex.trim] + number / kFloatLanes];
  const std::uint32_t lane = number % kFloatLanes;
  const Floats c = at.cos_heading;
  const Floats s = at.sin_heading;
  const Centres own{at.x + (c * all(eight.x[lane]) - s * all(eight.y[lane])),
                    at.y + (s * all(eight.x[lane]) + c * all(eight.y[lane])),
                    c * all(eight.along_x[lane]) - s * all(eight.along_y[lane]),
                    s * all(eight.along_x[lane]) + c * all(eight.along_y[lane])};
  const Floats tolerance = all(plan.tolerance);
  bool is_placed = false;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];) {
    const ObstaclesBlock& obstacles = plan.obstacle_rectangles[i / kFloatLanes];
    const RectanglesBlock& block = obstacles.rectangles;
    const Beside at_them =
        beside(own, {load(block.x), load(block.y), load(block.along_x), load(block.along_y)});
    const Floats outer =
        most_apart(at_them, all(eight.outer_along[lane]), all(eight.outer_aside[lane]),
                   load(block.outer_along), load(block.outer_aside));
    std::uint32_t near = obstacles.is_there & ~lanes_less(tolerance, outer);
    if (prepare_fresh(plan, i, near)) continue;  // with their own rectangles now
    if (near != 0) {
      const Floats inner =
          most_apart(at_them, all(eight.inner_along[lane]), all(eight.inner_aside[lane]),
                     load(block.inner_along), load(block.inner_aside));
      if (lanes_less(inner, all(0.0F) - tolerance) != 0) return true;
    }
    for (; near != 0; near &= near - 1) {
      const std::uint32_t item = i + static_cast<std::uint32_t>(__builtin_ctz(near));
      if (!is_placed) {
        place(tables.area_blocks + area.first_block, at, area.num_blocks, search.placed);
        is_placed = true;
      }
      const PolygonData& polygon = plan.polygons[plan.obstacles[item]];
      const PolygonBlock* const blocks = plan.obstacle_blocks + polygon.first_block;
      const Answer answer =
          compare(search.placed, area.num_blocks, blocks, polygon.num_blocks, tolerance);
      if (answer == Answer::kMeet) return true;
      if (answer == Answer::kTooClose &&
          search.decides(search.decides_context, {edge, false, item, &vertex})) {
        return true;
      }
    }
    i += kFloatLanes;
  }
  return false;
}

/// Eight segments in a row against an area, seen from its vertex.
HLC_INLINE bool meets_block(const Search& search, std::uint32_t edge, const Area& area,
                            std::uint32_t number, const Placement& at, const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const SegmentBlock& segments = plan.segment_blocks[number];
  const Floats c = at.cos_heading;
  const Floats s = at.sin_heading;
  const Floats tolerance = all(plan.tolerance);
  const Floats from_dx = load(segments.from_x) - at.x;
  const Floats from_dy = load(segments.from_y) - at.y;
  const Floats to_dx = load(segments.to_x) - at.x;
  const Floats to_dy = load(segments.to_y) - at.y;
  const Floats from_x = from_dx * c + from_dy * s;
  const Floats from_y = from_dy * c - from_dx * s;
  const Floats to_x = to_dx * c + to_dy * s;
  const Floats to_y = to_dy * c - to_dx * s;

  // The area's box.
  const Floats centre_x = all(area.centre_x);
  const Floats centre_y = all(area.centre_y);
  Floats most_apart = larger(
      larger(smaller(from_x, to_x) - centre_x, centre_x - larger(from_x, to_x)) - all(area.half_x),
      larger(smaller(from_y, to_y) - centre_y, centre_y - larger(from_y, to_y)) - all(area.half_y));
  if (lanes_less(tolerance, most_apart) == kEveryLane) return false;

  // The area's edges.
  const PolygonBlock* const blocks = search.tables->area_blocks + area.first_block;
  for (std::uint32_t i = 0; i < area.num_blocks; ++i) {
#pragma GCC unroll 8
    for (std::uint32_t k = 0; k < kFloatLanes; ++k) {
      const Floats normal_x = all(blocks[i].normal_x[k]);
      const Floats normal_y = all(blocks[i].normal_y[k]);
      const Floats nearest =
          smaller(normal_x * from_x + normal_y * from_y, normal_x * to_x + normal_y * to_y);
      most_apart = larger(nearest - all(blocks[i].offset[k]), most_apart);
    }
  }
  if (lanes_less(tolerance, most_apart) == kEveryLane) return false;

  // The segments' own sides.
  const Floats along_dx = load(segments.along_x);
  const Floats along_dy = load(segments.along_y);
  const Floats along_x = along_dx * c + along_dy * s;
  const Floats along_y = along_dy * c - along_dx * s;
  const Floats offset = along_x * from_y - along_y * from_x;
  Floats leftmost = all(-kFarAway);
  Floats rightmost = all(kFarAway);
  for (std::uint32_t i = 0; i < area.num_blocks; ++i) {
#pragma GCC unroll 8
    for (std::uint32_t k = 0; k < kFloatLanes; ++k) {
      const Floats side = along_x * all(blocks[i].y[k]) - along_y * all(blocks[i].x[k]);
      leftmost = larger(side, leftmost);
      rightmost = smaller(side, rightmost);
    }
  }
  most_apart = larger(larger(rightmost - offset, offset - leftmost), most_apart);
  if (lanes_less(most_apart, all(0.0F) - tolerance) != 0) return true;
  std::uint32_t close = kEveryLane & ~lanes_less(tolerance, most_apart);
  for (; close != 0; close &= close - 1) {
    const std::uint32_t item =
        number * kFloatLanes + static_cast<std::uint32_t>(__builtin_ctz(close));
    if (search.decides(search.decides_context, {edge, true, item, &vertex})) return true;
  }
  return false;
}

bool meets_segment(const Search& search, std::uint32_t edge, const Placement& at,
                   const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].lane;
  if (area.num_blocks == 0) return false;
  const Floats c = at.cos_heading;
  const Floats s = at.sin_heading;
  const Floats centre_x = all(area.centre_x);
  const Floats centre_y = all(area.centre_y);
  const Floats half_x = all(area.half_x + plan.tolerance);
  const Floats half_y = all(area.half_y + plan.tolerance);
  for (std::uint32_t i = 0; i < plan.num_blocks; i += kFloatLanes) {
    // How far the boxes of eight rectangles, in the area's frame, are from that of the area.
    const SegmentRectanglesBlock& rectangles = plan.segment_rectangles[i / kFloatLanes];
    const Floats dx = load(rectangles.x) - at.x;
    const Floats dy = load(rectangles.y) - at.y;
    const Floats along_x = load(rectangles.half_x);
    const Floats along_y = load(rectangles.half_y);
    const Floats half_width = load(rectangles.half_width);
    const Floats beside_x = absolute(dx * c + dy * s - centre_x) -
                            absolute(along_x * c + along_y * s) - half_width - half_x;
    const Floats beside_y = absolute(dy * c - dx * s - centre_y) -
                            absolute(along_y * c - along_x * s) - half_width - half_y;
    std::uint32_t near = kEveryLane & ~lanes_less(all(0.0F), larger(beside_x, beside_y));
    for (; near != 0; near &= near - 1) {
      const std::uint32_t number = i + static_cast<std::uint32_t>(__builtin_ctz(near));
      if (meets_block(search, edge, area, number, at, vertex)) return true;
    }
  }
  return false;
}

/// Is the edge to a child of a vertex free? @pre the vertex' obstacles were looked at, and the edge
/// was not forbidden
HLC_INLINE bool is_free(const Search& search, std::uint32_t number, std::size_t step,
                        const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const bool is_noted = ((1U << number % kFloatLanes) & vertex.doubts[number / kFloatLanes]) != 0;
  const bool is_doubtful =
      vertex.doubtful == Doubtful::kAll || (vertex.doubtful == Doubtful::kNoted && is_noted);
  if (!is_doubtful && plan.num_blocks == 0) return true;
  const Placement at = placement_of(plan, vertex);
  const std::uint32_t edge = vertex.first_edge + number;
  if (is_doubtful && meets_obstacle(search, number, step, at, vertex)) return false;
  return plan.num_blocks == 0 || !meets_segment(search, edge, at, vertex);
}

}  // namespace
}  // namespace hlc::branch_and_bound
