// What BranchAndBound's inner loop prepares once per plan, in single precision, relative to the
// plan's start: obstacles and boundary segments that can be met, with what encloses them. Compiled
// twice, as branch_and_bound_kernel.hpp, and for the same reason self-contained.
#pragma once

#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/branch_and_bound_vectors.hpp"

namespace hlc::branch_and_bound {
namespace {

constexpr float kFarAway = 1e15F;      // coordinate of padding; its square is still a number
constexpr double kLeastLength = 1e-6;  // of an edge with a direction, relative to S
constexpr double kDiagonal = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
constexpr std::uint32_t kEveryLane = 0xff;

/// Corners, normals and offsets of an obstacle.
HLC_INLINE void write_corners(const Plan& plan, const PolygonData& polygon) {
  double* const x = plan.corners;
  double* const y = plan.corners + plan.corner_stride;
  const std::uint32_t padded = polygon.num_blocks * kFloatLanes;
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    x[i] = polygon.corners[2 * i] - plan.origin_x;
    y[i] = polygon.corners[2 * i + 1] - plan.origin_y;
  }
  for (std::uint32_t i = polygon.size; i <= padded; ++i) {
    x[i] = x[0];
    y[i] = y[0];
  }
  const double least_length = kLeastLength * plan.scale;
  for (std::uint32_t i = 0; i < padded; i += kLanes) {
    PolygonBlock& block = plan.obstacle_blocks[polygon.first_block + i / kFloatLanes];
    const std::uint32_t lane = i % kFloatLanes;
    const Doubles from_x = load(x + i);
    const Doubles from_y = load(y + i);
    const Doubles along_x = load(x + i + 1) - from_x;
    const Doubles along_y = load(y + i + 1) - from_y;
    // An edge too short to have a direction gets no normal: it separates by 0, which is too close
    // to call whatever lies beside it.
    const Doubles length = larger(absolute(along_x), absolute(along_y));
    const Doubles scale = if_less(all(least_length), length, all(1.0) / length, all(0.0));
    const Doubles normal_x = along_y * scale;
    const Doubles normal_y = all(0.0) - along_x * scale;
    store(block.x + lane, from_x);
    store(block.y + lane, from_y);
    store(block.normal_x + lane, normal_x);
    store(block.normal_y + lane, normal_y);
    store(block.offset + lane, normal_x * from_x + normal_y * from_y);
  }
  PolygonBlock& last = plan.obstacle_blocks[polygon.first_block + polygon.num_blocks - 1];
  for (std::uint32_t i = polygon.size; i < padded; ++i)
    last.offset[i % kFloatLanes] = kSeparatesNothing;
}

/// From where to where a polygon's corners lie along an axis.
struct Extent {
  float low;
  float high;
};

HLC_INLINE Extent extent(const PolygonBlock* blocks, std::uint32_t num_blocks, float axis_x,
                         float axis_y) {
  Floats low = load(blocks[0].x) * all(axis_x) + load(blocks[0].y) * all(axis_y);
  Floats high = low;
  for (std::uint32_t i = 1; i < num_blocks; ++i) {
    const Floats place = load(blocks[i].x) * all(axis_x) + load(blocks[i].y) * all(axis_y);
    low = smaller(place, low);
    high = larger(place, high);
  }
  return {least(low), largest(high)};
}

/// Rectangles of an obstacle, along its longest edge, and everything else that is needed of it.
void make_ready(const Plan& plan, std::uint32_t item) {
  const PolygonData& polygon = plan.polygons[plan.obstacles[item]];
  write_corners(plan, polygon);
  const double* const x = plan.corners;
  const double* const y = plan.corners + plan.corner_stride;
  double along_x = 1.0;
  double along_y = 0.0;
  double longest = 0.0;
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const double dx = x[i + 1] - x[i];
    const double dy = y[i + 1] - y[i];
    const double squared = dx * dx + dy * dy;
    const bool is_longer = squared > longest;
    longest = is_longer ? squared : longest;
    along_x = is_longer ? dx : along_x;
    along_y = is_longer ? dy : along_y;
  }
  const double scale = longest > 0.0 ? 1.0 / __builtin_sqrt(longest) : 1.0;
  const auto axis_x = static_cast<float>(along_x * scale);
  const auto axis_y = static_cast<float>(along_y * scale);
  const PolygonBlock* const blocks = plan.obstacle_blocks + polygon.first_block;
  const Extent along = extent(blocks, polygon.num_blocks, axis_x, axis_y);
  const Extent aside = extent(blocks, polygon.num_blocks, -axis_y, axis_x);
  const float middle_along = 0.5F * (along.low + along.high);
  const float middle_aside = 0.5F * (aside.low + aside.high);
  const float half_along = 0.5F * (along.high - along.low);
  const float half_aside = 0.5F * (aside.high - aside.low);
  const float centre_x = middle_along * axis_x - middle_aside * axis_y;
  const float centre_y = middle_along * axis_y + middle_aside * axis_x;

  // The share of the outer rectangle that every edge leaves inside. An edge without direction
  // leaves nothing: of such a polygon the exact test alone knows what it meets.
  Floats share = all(1.0F);
  for (std::uint32_t i = 0; i < polygon.num_blocks; ++i) {
    const Floats normal_x = load(blocks[i].normal_x);
    const Floats normal_y = load(blocks[i].normal_y);
    const Floats inside =
        load(blocks[i].offset) - (normal_x * all(centre_x) + normal_y * all(centre_y));
    const Floats taken =
        absolute(normal_x * all(axis_x) + normal_y * all(axis_y)) * all(half_along) +
        absolute(normal_y * all(axis_x) - normal_x * all(axis_y)) * all(half_aside);
    share = smaller(if_less(all(0.0F), taken, inside / taken, inside), share);
  }
  const float inner = least(share);
  const bool has_inner = inner > 0.0F;

  ObstaclesBlock& obstacles = plan.obstacle_rectangles[item / kFloatLanes];
  RectanglesBlock& block = obstacles.rectangles;
  const std::uint32_t lane = item % kFloatLanes;
  block.x[lane] = centre_x;
  block.y[lane] = centre_y;
  block.along_x[lane] = axis_x;
  block.along_y[lane] = axis_y;
  block.outer_along[lane] = half_along;
  block.outer_aside[lane] = half_aside;
  block.inner_along[lane] = has_inner ? inner * half_along : kNoInner;
  block.inner_aside[lane] = has_inner ? inner * half_aside : kNoInner;
  obstacles.is_ready |= 1U << lane;
}

/// Places along the axes of the start's frame.
struct Axes {
  Doubles x;
  Doubles y;
};

HLC_INLINE Doubles along_axes(const Axes& axes, double x, double y) {
  return axes.x * all(x) + axes.y * all(y);
}

/// Does the interval, on any axis, lie beyond what can be reached?
HLC_INLINE bool is_beyond(const Doubles& low, const Doubles& high, const double* reach) {
  return (lanes_less(load(reach + kAxes), low) | lanes_less(high, load(reach))) != 0;
}

/// Nothing meets what is in a block before obstacles are written into it.
HLC_INLINE void write_padding(ObstaclesBlock& obstacles) {
  obstacles.is_there = 0;
  obstacles.is_ready = 0;
  RectanglesBlock& block = obstacles.rectangles;
  store(block.x, all(kFarAway));
  store(block.y, all(kFarAway));
  store(block.along_x, all(1.0F));
  store(block.along_y, all(0.0F));
  store(block.outer_along, all(0.0F));
  store(block.outer_aside, all(0.0F));
  store(block.inner_along, all(kNoInner));
  store(block.inner_aside, all(kNoInner));
}

/// Obstacles that can be met in their step, with a box around each.
HLC_INLINE void prepare_obstacles(Plan& plan, const Axes& axes) {
  const Axes absolute_axes{absolute(axes.x), absolute(axes.y)};
  std::uint32_t count = 0;
  std::size_t next = 0;
  double scale = plan.scale;
  plan.first_obstacle[0] = 0;
  for (std::size_t step = 0; step < plan.horizon_steps; ++step) {
    for (; next < plan.num_polygons && plan.polygons[next].step == step; ++next) {
      const PolygonData& polygon = plan.polygons[next];
      const double* const corners = polygon.corners;
      // Two corners at a time; the last two may come twice.
      const std::uint32_t last_pair = 2 * polygon.size - 4;
      Doubles lowest = load(corners + last_pair);
      Doubles highest = lowest;
      for (std::uint32_t i = 0; i < last_pair; i += 4) {
        const Doubles pair = load(corners + i);
        lowest = smaller(pair, lowest);
        highest = larger(pair, highest);
      }
      const double min_x = lowest[0] < lowest[2] ? lowest[0] : lowest[2];
      const double min_y = lowest[1] < lowest[3] ? lowest[1] : lowest[3];
      const double max_x = highest[0] > highest[2] ? highest[0] : highest[2];
      const double max_y = highest[1] > highest[3] ? highest[1] : highest[3];
      const double centre_x = 0.5 * (min_x + max_x) - plan.origin_x;
      const double centre_y = 0.5 * (min_y + max_y) - plan.origin_y;
      const double half_x = 0.5 * (max_x - min_x);
      const double half_y = 0.5 * (max_y - min_y);
      const Doubles centre = along_axes(axes, centre_x, centre_y);
      const Doubles half = along_axes(absolute_axes, half_x, half_y);
      if (is_beyond(centre - half, centre + half, plan.reach[step])) continue;
      const std::uint32_t lane = count % kFloatLanes;
      ObstaclesBlock& obstacles = plan.obstacle_rectangles[count / kFloatLanes];
      if (lane == 0) write_padding(obstacles);
      RectanglesBlock& block = obstacles.rectangles;
      block.x[lane] = static_cast<float>(centre_x);
      block.y[lane] = static_cast<float>(centre_y);
      block.outer_along[lane] = static_cast<float>(half_x);
      block.outer_aside[lane] = static_cast<float>(half_y);
      obstacles.is_there |= 1U << lane;
      plan.obstacles[count] = static_cast<std::uint32_t>(next);
      ++count;
      const double size = absolute(centre_x) + absolute(centre_y) + half_x + half_y;
      scale = size > scale ? size : scale;
    }
    count = (count + kFloatLanes - 1) / kFloatLanes * kFloatLanes;
    plan.first_obstacle[step + 1] = count;
  }
  plan.scale = scale;
}

/// An oriented rectangle that contains eight segments in a row, along the line from the first one's
/// begin to the last one's end.
HLC_INLINE void enclose(const SegmentBlock& segments, SegmentRectanglesBlock& rectangles,
                        std::uint32_t lane) {
  constexpr std::uint32_t kLast = kFloatLanes - 1;
  float along_x = segments.to_x[kLast] - segments.from_x[0];
  float along_y = segments.to_y[kLast] - segments.from_y[0];
  const float length = __builtin_sqrtf(along_x * along_x + along_y * along_y);
  along_x = length > 0.0F ? along_x / length : 1.0F;
  along_y = length > 0.0F ? along_y / length : 0.0F;
  const Floats from_x = load(segments.from_x);
  const Floats from_y = load(segments.from_y);
  const Floats to_x = load(segments.to_x);
  const Floats to_y = load(segments.to_y);
  const Floats from_along = from_x * all(along_x) + from_y * all(along_y);
  const Floats to_along = to_x * all(along_x) + to_y * all(along_y);
  const Floats from_aside = from_y * all(along_x) - from_x * all(along_y);
  const Floats to_aside = to_y * all(along_x) - to_x * all(along_y);
  const float begin = least(smaller(from_along, to_along));
  const float end = largest(larger(from_along, to_along));
  const float right = least(smaller(from_aside, to_aside));
  const float left = largest(larger(from_aside, to_aside));
  const float middle = 0.5F * (begin + end);
  const float aside = 0.5F * (left + right);
  rectangles.x[lane] = middle * along_x - aside * along_y;
  rectangles.y[lane] = middle * along_y + aside * along_x;
  rectangles.half_x[lane] = 0.5F * (end - begin) * along_x;
  rectangles.half_y[lane] = 0.5F * (end - begin) * along_y;
  rectangles.half_width[lane] = 0.5F * (left - right);
}

/// Writes eight segments in a row, the first of them number `first`, into a block.
HLC_INLINE void write_segments(const Plan& plan, std::size_t first, SegmentBlock& block) {
  const Doubles origin{plan.origin_x, plan.origin_y, plan.origin_x, plan.origin_y};
  double along_x[kFloatLanes];
  double along_y[kFloatLanes];
  const std::size_t last = plan.boundary_size - 1;
  for (std::uint32_t lane = 0; lane < kFloatLanes; ++lane) {
    // The last one again: it meets what that one meets.
    const double* const ends = plan.boundary + 4 * (first + lane < last ? first + lane : last);
    along_x[lane] = ends[2] - ends[0];
    along_y[lane] = ends[3] - ends[1];
    float relative[kLanes];
    store(relative, load(ends) - origin);
    block.from_x[lane] = relative[0];
    block.from_y[lane] = relative[1];
    block.to_x[lane] = relative[2];
    block.to_y[lane] = relative[3];
  }
  for (std::uint32_t lane = 0; lane < kFloatLanes; lane += kLanes) {
    const Doubles x = load(along_x + lane);
    const Doubles y = load(along_y + lane);
    // As with obstacles: no direction, too close to call.
    const Doubles length = larger(absolute(x), absolute(y));
    const Doubles scale =
        if_less(all(kLeastLength * plan.scale), length, all(1.0) / length, all(0.0));
    store(block.along_x + lane, x * scale);
    store(block.along_y + lane, y * scale);
  }
}

/// What can be reached in any step, along the axes of the start's frame: lowest, highest.
struct Reachable {
  float low[kAxes];
  float high[kAxes];
};

/// Do all segments of a block, on the same axis, lie beyond what can be reached?
HLC_INLINE bool is_beyond(const SegmentBlock& segments, const float* axis_x, const float* axis_y,
                          const Reachable& reachable) {
  const Floats from_x = load(segments.from_x);
  const Floats from_y = load(segments.from_y);
  const Floats to_x = load(segments.to_x);
  const Floats to_y = load(segments.to_y);
  // Above the rounding of coordinates, of their projections and of what can be reached.
  const Floats slack =
      all(0x1p-20F) * (absolute(from_x) + absolute(from_y) + absolute(to_x) + absolute(to_y)) +
      all(1e-6F);
  std::uint32_t beyond = 0;
#pragma GCC unroll 4
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const Floats from = from_x * all(axis_x[axis]) + from_y * all(axis_y[axis]);
    const Floats to = to_x * all(axis_x[axis]) + to_y * all(axis_y[axis]);
    const Floats low = smaller(from, to) - slack;
    const Floats high = larger(from, to) + slack;
    const bool is_above = lanes_less(all(reachable.high[axis]), low) == kEveryLane;
    const bool is_below = lanes_less(high, all(reachable.low[axis])) == kEveryLane;
    beyond |= static_cast<std::uint32_t>(is_above) | static_cast<std::uint32_t>(is_below);
  }
  return beyond != 0;
}

/// Blocks of boundary segments that can be met in any step.
HLC_INLINE void prepare_segments(Plan& plan, const double* axis_x, const double* axis_y) {
  plan.num_blocks = 0;
  if (plan.boundary_size == 0) return;
  Doubles low = load(plan.reach[0]);
  Doubles high = load(plan.reach[0] + kAxes);
  for (std::size_t step = 1; step < plan.horizon_steps; ++step) {
    low = smaller(low, load(plan.reach[step]));
    high = larger(high, load(plan.reach[step] + kAxes));
  }
  Reachable reachable;
  store(reachable.low, low);
  store(reachable.high, high);
  float x[kAxes];
  float y[kAxes];
  store(x, load(axis_x));
  store(y, load(axis_y));

  Floats largest_coordinate = all(0.0F);
  std::uint32_t count = 0;
  for (std::size_t source = 0; source < plan.boundary_size; source += kFloatLanes) {
    SegmentBlock& block = plan.segment_blocks[count];
    write_segments(plan, source, block);
    if (is_beyond(block, x, y, reachable)) continue;
    plan.segment_source[count] = static_cast<std::uint32_t>(source);
    enclose(block, plan.segment_rectangles[count / kFloatLanes], count % kFloatLanes);
    const Floats from = absolute(load(block.from_x)) + absolute(load(block.from_y));
    const Floats to = absolute(load(block.to_x)) + absolute(load(block.to_y));
    largest_coordinate = larger(larger(from, to), largest_coordinate);
    ++count;
  }
  plan.num_blocks = count;
  for (; count % kFloatLanes != 0; ++count) {
    SegmentRectanglesBlock& rectangles = plan.segment_rectangles[count / kFloatLanes];
    const std::uint32_t lane = count % kFloatLanes;
    rectangles.x[lane] = kFarAway;
    rectangles.y[lane] = kFarAway;
    rectangles.half_x[lane] = 0.0F;
    rectangles.half_y[lane] = 0.0F;
    rectangles.half_width[lane] = 0.0F;
  }
  const double size = static_cast<double>(largest(largest_coordinate));
  plan.scale = size > plan.scale ? size : plan.scale;
}

void prepare(Plan& plan, const VertexData& start) {
  const double c = start.cos_heading;
  const double s = start.sin_heading;
  const double diagonal = (c - s) * kDiagonal;
  const double other = (c + s) * kDiagonal;
  const double x[kAxes] = {c, diagonal, -s, -other};
  const double y[kAxes] = {s, other, c, diagonal};
  const Axes axes{load(x), load(y)};
  plan.origin_x = start.x;
  plan.origin_y = start.y;
  prepare_obstacles(plan, axes);
  prepare_segments(plan, x, y);
  plan.tolerance = 0x1p-18F * static_cast<float>(plan.scale);
}

}  // namespace
}  // namespace hlc::branch_and_bound
