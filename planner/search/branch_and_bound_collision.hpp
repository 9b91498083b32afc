// The collision test of BranchAndBound's inner loop: separating axes in single precision, eight
// edges, corners or boundary segments at a time. Long-winded for speed; compiled twice, as
// branch_and_bound_kernel.hpp, and for the same reason self-contained.
//
// Distances are computed relative to the plan's start, where coordinates are small. Each step of
// the computation rounds by half a unit in the last place, 2^-24 of the largest coordinate S, or
// twice that after a rotation; from corners, normals and placements to a distance they add up to
// less than 64 of them. The tolerance is 2^-18 S. What is apart or overlaps by more is certain;
// what is between is asked of Search::decides.
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
#pragma GCC unroll 8
    for (std::uint32_t k = 0; k < kFloatLanes; ++k) {
      nearest = smaller(normal_x * all(other[i].x[k]) + normal_y * all(other[i].y[k]), nearest);
    }
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

/// Does a point lie deep in a polygon?
HLC_INLINE bool contains(const PolygonBlock* polygon, std::uint32_t num_blocks, const Floats& x,
                         const Floats& y, const Floats& tolerance) {
  Floats most_outside = all(-kFarAway);
  for (std::uint32_t i = 0; i < num_blocks; ++i) {
    const Floats outside =
        load(polygon[i].normal_x) * x + load(polygon[i].normal_y) * y - load(polygon[i].offset);
    most_outside = larger(outside, most_outside);
  }
  return lanes_less(most_outside, all(0.0F) - tolerance) == kEveryLane;
}

bool meets_obstacle(const Search& search, std::uint32_t edge, std::size_t step, const Placement& at,
                    const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].swept;
  if (area.num_blocks == 0) return false;
  const Floats centre_x =
      at.x + (at.cos_heading * all(area.centre_x) - at.sin_heading * all(area.centre_y));
  const Floats centre_y =
      at.y + (at.sin_heading * all(area.centre_x) + at.cos_heading * all(area.centre_y));
  const Floats radius = all(area.radius + plan.tolerance);
  const Floats tolerance = all(plan.tolerance);
  bool is_placed = false;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];
       i += kFloatLanes) {
    const Floats dx = load(plan.circle_x + i) - centre_x;
    const Floats dy = load(plan.circle_y + i) - centre_y;
    const Floats reach = load(plan.circle_radius + i) + radius;
    // What is not surely apart, so that what is no number is looked at.
    std::uint32_t near = kEveryLane & ~lanes_less(reach * reach, dx * dx + dy * dy);
    for (; near != 0; near &= near - 1) {
      const std::uint32_t item = i + static_cast<std::uint32_t>(__builtin_ctz(near));
      ObstacleData& obstacle = plan.obstacles[item];
      const PolygonData& polygon = plan.polygons[obstacle.polygon];
      if (!obstacle.is_ready) {
        make_ready(plan, polygon);
        obstacle.is_ready = true;
      }
      const PolygonBlock* const blocks = plan.obstacle_blocks + polygon.first_block;
      // The centre of the area's box lies in the area, which is convex. In a large obstacle it
      // tells at once; of areas alike it hardly ever does.
      if (plan.circle_radius[item] > 2.0F * area.radius &&
          contains(blocks, polygon.num_blocks, centre_x, centre_y, tolerance)) {
        return true;
      }
      if (!is_placed) {
        place(search.tables->area_blocks + area.first_block, at, area.num_blocks, search.placed);
        is_placed = true;
      }
      const Answer answer =
          compare(search.placed, area.num_blocks, blocks, polygon.num_blocks, tolerance);
      if (answer == Answer::kMeet) return true;
      if (answer == Answer::kTooClose &&
          search.decides(search.decides_context, {edge, false, item, &vertex})) {
        return true;
      }
    }
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
    const RectangleBlock& rectangles = plan.rectangles[i / kFloatLanes];
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
