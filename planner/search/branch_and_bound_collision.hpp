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

/// Rectangles of an area beside those of eight obstacles.
struct Beside {
  Floats ahead;  ///< distance of the centres along the area's axes
  Floats aside;
  Floats other_ahead;  ///< along the obstacle's axes
  Floats other_aside;
  Floats c;  ///< cosine and sine between the axes; all six without their signs
  Floats s;
};

HLC_INLINE Beside beside(const RectanglesBlock& block, const Floats& x, const Floats& y,
                         const Floats& along_x, const Floats& along_y) {
  const Floats dx = load(block.x) - x;
  const Floats dy = load(block.y) - y;
  const Floats other_x = load(block.along_x);
  const Floats other_y = load(block.along_y);
  return {absolute(dx * along_x + dy * along_y),
          absolute(dy * along_x - dx * along_y),
          absolute(dx * other_x + dy * other_y),
          absolute(dy * other_x - dx * other_y),
          absolute(along_x * other_x + along_y * other_y),
          absolute(along_x * other_y - along_y * other_x)};
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

bool meets_obstacle(const Search& search, std::uint32_t edge, std::size_t step, const Placement& at,
                    const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].swept;
  if (area.num_blocks == 0) return false;
  const Rectangles& own = search.tables->edges[edge].swept_rectangles;
  const Floats c = at.cos_heading;
  const Floats s = at.sin_heading;
  const Floats x = at.x + (c * all(own.x) - s * all(own.y));
  const Floats y = at.y + (s * all(own.x) + c * all(own.y));
  const Floats along_x = c * all(own.along_x) - s * all(own.along_y);
  const Floats along_y = s * all(own.along_x) + c * all(own.along_y);
  const Floats tolerance = all(plan.tolerance);
  bool is_placed = false;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];) {
    const RectanglesBlock& block = plan.obstacle_rectangles[i / kFloatLanes];
    const Beside beside_them = beside(block, x, y, along_x, along_y);
    const Floats outer = most_apart(beside_them, all(own.outer_along), all(own.outer_aside),
                                    load(block.outer_along), load(block.outer_aside));
    // What is not surely apart, so that what is no number is looked at.
    std::uint32_t near = kEveryLane & ~lanes_less(tolerance, outer);
    std::uint32_t fresh = near & ~block.is_ready;
    if (fresh != 0) {
      for (; fresh != 0; fresh &= fresh - 1) {
        make_ready(plan, i + static_cast<std::uint32_t>(__builtin_ctz(fresh)));
      }
      continue;  // with their own rectangles now
    }
    if (near != 0) {
      const Floats inner = most_apart(beside_them, all(own.inner_along), all(own.inner_aside),
                                      load(block.inner_along), load(block.inner_aside));
      if (lanes_less(inner, all(0.0F) - tolerance) != 0) return true;
    }
    for (; near != 0; near &= near - 1) {
      const std::uint32_t item = i + static_cast<std::uint32_t>(__builtin_ctz(near));
      if (!is_placed) {
        place(search.tables->area_blocks + area.first_block, at, area.num_blocks, search.placed);
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

HLC_INLINE bool is_free(const Search& search, std::uint32_t edge, std::size_t step,
                        const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Placement at = placement_of(plan, vertex);
  if (plan.first_obstacle[step - 1] != plan.first_obstacle[step] &&
      meets_obstacle(search, edge, step, at, vertex)) {
    return false;
  }
  return plan.num_blocks == 0 || !meets_segment(search, edge, at, vertex);
}

}  // namespace
}  // namespace hlc::branch_and_bound
