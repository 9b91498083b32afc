// The collision test of BranchAndBound's inner loop: separating axes in single precision, eight
// obstacles, edges or boundary segments at a time. Verbose for speed; compiled as often as
// kernel.hpp, and for the same reason self-contained.
//
// Obstacles and boundary are prepared relative to the plan's start, where coordinates are small.
// Obstacles are compared in the frame of the vertex, where the largest coordinate is at most twice
// that relative to the start, S. Each step of the computation rounds by half a unit in the last
// place, 2^-24 of a coordinate, or twice that after a rotation; from corners, normals, boxes and
// placements to a distance they add up to less than 64 times 2^-24 S. The tolerance is 2^-18 S. A
// larger distance or overlap is certain; in between Search::decides is called.
#pragma once

#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/branch_and_bound/preparation.hpp"
#include "planner/search/branch_and_bound/vectors.hpp"

namespace hlc::search::branch_and_bound {
namespace {

/// A vertex in single precision, relative to the plan's start.
struct Placement {
  Floats x;
  Floats y;
  Floats cos_heading;
  Floats sin_heading;
};

HLC_INLINE Placement placement_of(const Plan& plan, const VertexData& vertex) {
  return {all(static_cast<float>(vertex.place[kX] - plan.origin_x)),
          all(static_cast<float>(vertex.place[kY] - plan.origin_y)),
          all(static_cast<float>(vertex.place[kCos])), all(static_cast<float>(vertex.place[kSin]))};
}

/// A polygon, moved from the plan's frame to a vertex'. Returns how far the vertex lies inside each
/// of its edges.
HLC_INLINE Floats see_from(const Placement& at, const PolygonBlock& from, PolygonBlock& to) {
  const Floats dx = load(from.x) - at.x;
  const Floats dy = load(from.y) - at.y;
  const Floats normal_x = load(from.normal_x);
  const Floats normal_y = load(from.normal_y);
  store(to.x, at.cos_heading * dx + at.sin_heading * dy);
  store(to.y, at.cos_heading * dy - at.sin_heading * dx);
  store(to.normal_x, at.cos_heading * normal_x + at.sin_heading * normal_y);
  store(to.normal_y, at.cos_heading * normal_y - at.sin_heading * normal_x);
  const Floats inside = load(from.offset) - (normal_x * at.x + normal_y * at.y);
  store(to.offset, inside);
  return inside;
}

/// How far the nearest corner of `other` lies beyond each edge of a polygon.
HLC_INLINE Floats beyond_edges(const PolygonBlock& polygon, const PolygonBlock& other) {
  const Floats normal_x = load(polygon.normal_x);
  const Floats normal_y = load(polygon.normal_y);
  const auto along = [&](std::uint32_t i) {
    return normal_x * all(other.x[i]) + normal_y * all(other.y[i]);
  };
  const Floats low = smaller(smaller(along(0), along(1)), smaller(along(2), along(3)));
  const Floats high = smaller(smaller(along(4), along(5)), smaller(along(6), along(7)));
  return smaller(low, high) - load(polygon.offset);
}

enum class Answer { kApart, kMeet, kTooClose };

/// Whether two polygons meet: a separating-axis test.
HLC_INLINE Answer compare(const PolygonBlock& a, const PolygonBlock& b, const Floats& tolerance) {
  const Floats beyond_a = beyond_edges(a, b);
  if (lanes_less(tolerance, beyond_a) != 0) return Answer::kApart;
  const Floats most_apart = larger(beyond_edges(b, a), beyond_a);
  if (lanes_less(tolerance, most_apart) != 0) return Answer::kApart;
  const Floats inside = all(0.0F) - tolerance;
  return lanes_less(most_apart, inside) == kEveryLane ? Answer::kMeet : Answer::kTooClose;
}

/// Prepares those of eight obstacles that are near and not prepared yet.
HLC_INLINE void make_ready(const Plan& plan, std::uint32_t first, std::uint32_t near) {
  BoxesBlock& boxes = plan.obstacle_boxes[first / kFloatLanes];
  std::uint32_t fresh = near & ~boxes.is_ready;
  boxes.is_ready |= fresh;
  for (; fresh != 0; fresh &= fresh - 1) {
    const std::uint32_t item = first + static_cast<std::uint32_t>(__builtin_ctz(fresh));
    write_piece(plan, plan.obstacles[item], plan.obstacle_blocks[item]);
  }
}

/// Lists the obstacles of a step that the surroundings of all edges out of a vertex may meet, seen
/// from the vertex. False if one is around the vertex itself, so that all edges meet it.
HLC_INLINE bool look_around(const Search& search, std::size_t step, VertexData& vertex) {
  const Plan& plan = *search.plan;
  vertex.num_near = 0;
  vertex.num_near_at_rest = 0;
  std::uint32_t first = plan.first_obstacle[step - 1];
  const std::uint32_t last = plan.last_obstacle[step - 1];
  const std::uint32_t first_in_motion = plan.first_in_motion[step - 1];
  if (first == last) return true;
  // A rectangle that contains all edges' areas, against eight boxes at a time.
  const Placement at = placement_of(plan, vertex);
  const Surroundings& around = search.tables->around[vertex.trim];
  const Floats centre_x = at.x + (at.cos_heading * all(around.x) - at.sin_heading * all(around.y));
  const Floats centre_y = at.y + (at.sin_heading * all(around.x) + at.cos_heading * all(around.y));
  const Floats along_x =
      at.cos_heading * all(around.along_x) - at.sin_heading * all(around.along_y);
  const Floats along_y =
      at.sin_heading * all(around.along_x) + at.cos_heading * all(around.along_y);
  const Floats part_x = absolute(along_x);
  const Floats part_y = absolute(along_y);
  const Floats half_along = all(around.half_along);
  const Floats half_aside = all(around.half_aside);
  const Floats own_half_x = part_x * half_along + part_y * half_aside;
  const Floats own_half_y = part_y * half_along + part_x * half_aside;
  const Floats tolerance = all(plan.tolerance);
  for (; first < last; first += kFloatLanes) {
    const BoxesBlock& boxes = plan.obstacle_boxes[first / kFloatLanes];
    const Floats dx = load(boxes.x) - centre_x;
    const Floats dy = load(boxes.y) - centre_y;
    const Floats half_x = load(boxes.half_x);
    const Floats half_y = load(boxes.half_y);
    const Floats apart =
        larger(absolute(dx) - (own_half_x + half_x), absolute(dy) - (own_half_y + half_y));
    const Floats own_apart = larger(
        absolute(dx * along_x + dy * along_y) - (half_along + (part_x * half_x + part_y * half_y)),
        absolute(dy * along_x - dx * along_y) - (half_aside + (part_y * half_x + part_x * half_y)));
    // Not certainly apart, so that NaN distances are checked.
    const std::uint32_t are_there = last - first < kFloatLanes ? (1U << (last - first)) - 1 : 0xff;
    std::uint32_t near = are_there & ~lanes_less(tolerance, larger(own_apart, apart));
    if (near == 0) continue;
    make_ready(plan, first, near);
    for (; near != 0; near &= near - 1) {
      const std::uint32_t item = first + static_cast<std::uint32_t>(__builtin_ctz(near));
      const Floats inside =
          see_from(at, plan.obstacle_blocks[item], vertex.near_blocks[vertex.num_near]);
      const bool is_met_at_rest = item < first_in_motion;
      if (is_met_at_rest && around.all_hold_start && lanes_less(tolerance, inside) == kEveryLane) {
        return false;
      }
      vertex.near[vertex.num_near++] = item;
      vertex.num_near_at_rest += static_cast<std::uint32_t>(is_met_at_rest);
    }
  }
  return true;
}

/// Whether the edge to a child keeps clear of the obstacles near its vertex.
HLC_INLINE bool keeps_off_obstacles(const Search& search, std::uint32_t edge,
                                    const VertexData& vertex) {
  const Tables& tables = *search.tables;
  const std::uint32_t num_near =
      tables.edges[edge].stands ? vertex.num_near_at_rest : vertex.num_near;
  if (num_near == 0) return true;
  const Floats tolerance = all(search.plan->tolerance);
  const PolygonBlock* area = tables.area_blocks + tables.edges[edge].first_swept;
  for (std::uint32_t left = tables.edges[edge].num_swept; left != 0; --left, ++area) {
    for (std::uint32_t i = 0; i < num_near; ++i) {
      const Answer answer = compare(vertex.near_blocks[i], *area, tolerance);
      if (answer == Answer::kApart) continue;
      if (answer == Answer::kMeet ||
          search.decides(search.decides_context, {edge, false, vertex.near[i], &vertex})) {
        return false;
      }
    }
  }
  return true;
}

/// Eight consecutive segments against an area, seen from its vertex.
HLC_INLINE bool meets_block(const Search& search, std::uint32_t edge, const LaneArea& area,
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
  const LaneArea& area = search.tables->lane_areas[edge];
  if (area.num_blocks == 0) return false;
  const Floats c = at.cos_heading;
  const Floats s = at.sin_heading;
  const Floats centre_x = all(area.centre_x);
  const Floats centre_y = all(area.centre_y);
  const Floats half_x = all(area.half_x + plan.tolerance);
  const Floats half_y = all(area.half_y + plan.tolerance);
  for (std::uint32_t i = 0; i < plan.num_blocks; i += kFloatLanes) {
    // Distance of the boxes of eight rectangles, in the area's frame, from that of the area.
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

/// Whether the edge to a child of a vertex is free. @pre the obstacles near the vertex are listed
HLC_INLINE bool is_free(const Search& search, std::uint32_t edge, const VertexData& vertex) {
  if (!keeps_off_obstacles(search, edge, vertex)) return false;
  const Plan& plan = *search.plan;
  return plan.num_blocks == 0 || !meets_segment(search, edge, placement_of(plan, vertex), vertex);
}

}  // namespace
}  // namespace hlc::search::branch_and_bound
