// Preparation of a plan for BranchAndBound's inner loop, in single precision, relative to the
// plan's start: obstacles and boundary segments within reach, with enclosing shapes. Compiled as
// often as kernel.hpp, and for the same reason self-contained.
#pragma once

#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/branch_and_bound/vectors.hpp"

namespace hlc::search::branch_and_bound {
namespace {

constexpr float kFarAway = 1e15F;      // coordinate of padding; its square is still a number
constexpr double kLeastLength = 1e-6;  // of an edge with a direction, relative to S
constexpr double kDiagonal = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
constexpr std::uint32_t kEveryLane = 0xff;

/// Corners, normals and offsets of an obstacle.
HLC_INLINE void write_piece(const Plan& plan, const PieceData& piece, PolygonBlock& block) {
  alignas(32) double x[kFloatLanes + 1];
  alignas(32) double y[kFloatLanes + 1];
  const double* const corners = plan.polygons[piece.polygon].corners;
  const double* const others = corners + 2 * piece.second;
  x[0] = corners[0] - plan.origin_x;
  y[0] = corners[1] - plan.origin_y;
  for (std::uint32_t i = 1; i < piece.size; ++i) {
    x[i] = others[2 * i - 2] - plan.origin_x;
    y[i] = others[2 * i - 1] - plan.origin_y;
  }
  for (std::uint32_t i = piece.size; i <= kFloatLanes; ++i) {
    x[i] = x[0];
    y[i] = y[0];
  }
  const double least_length = kLeastLength * plan.scale;
  for (std::uint32_t i = 0; i < kFloatLanes; i += kLanes) {
    const Doubles from_x = load(x + i);
    const Doubles from_y = load(y + i);
    const Doubles along_x = load(x + i + 1) - from_x;
    const Doubles along_y = load(y + i + 1) - from_y;
    // An edge too short to have a direction gets no normal: it separates by 0, which is too close
    // for a decision.
    const Doubles length = larger(absolute(along_x), absolute(along_y));
    const Doubles scale = if_less(all(least_length), length, all(1.0) / length, all(0.0));
    const Doubles normal_x = along_y * scale;
    const Doubles normal_y = all(0.0) - along_x * scale;
    store(block.x + i, from_x);
    store(block.y + i, from_y);
    store(block.normal_x + i, normal_x);
    store(block.normal_y + i, normal_y);
    store(block.offset + i, normal_x * from_x + normal_y * from_y);
  }
  for (std::uint32_t i = piece.size; i < kFloatLanes; ++i) block.offset[i] = kSeparatesNothing;
}

/// Coordinates along the axes of the start's frame.
struct Axes {
  Doubles x;
  Doubles y;
};

HLC_INLINE Doubles along_axes(const Axes& axes, double x, double y) {
  return axes.x * all(x) + axes.y * all(y);
}

/// Whether the interval, on any axis, lies beyond reach.
HLC_INLINE bool is_beyond(const Doubles& low, const Doubles& high, const double* reach) {
  return (lanes_less(load(reach + kAxes), low) | lanes_less(high, load(reach))) != 0;
}

/// From the lowest to the highest x and y of a polygon, each twice.
struct Bounds {
  Doubles lowest;
  Doubles highest;
};

HLC_INLINE Bounds bounds_of(const PolygonData& polygon) {
  // Two corners at a time; the last two may repeat.
  const std::uint32_t last_pair = 2 * polygon.size - 4;
  Doubles lowest = load(polygon.corners + last_pair);
  Doubles highest = lowest;
  for (std::uint32_t i = 0; i < last_pair; i += 4) {
    const Doubles pair = load(polygon.corners + i);
    lowest = smaller(pair, lowest);
    highest = larger(pair, highest);
  }
  return {smaller(lowest, halves_swapped(lowest)), larger(highest, halves_swapped(highest))};
}

/// Whether the corners are equal, in the same order.
HLC_INLINE bool is_equal(const PolygonData& a, const PolygonData& b) {
  if (a.size != b.size) return false;
  for (std::uint32_t i = 0; i < 2 * a.size; i += 4) {
    const std::uint32_t at = i < 2 * a.size - 4 ? i : 2 * a.size - 4;
    if (!are_equal(load(a.corners + at), load(b.corners + at))) return false;
  }
  return true;
}

/// Obstacles within reach in their step, with a box around each.
HLC_INLINE void prepare_obstacles(Plan& plan, const Axes& axes) {
  const Axes absolute_axes{absolute(axes.x), absolute(axes.y)};
  const Doubles origin{plan.origin_x, plan.origin_y, plan.origin_x, plan.origin_y};
  Doubles largest_coordinate = all(0.0);
  std::uint32_t count = 0;
  const PolygonData* polygon = plan.polygons;
  const PolygonData* const last = plan.polygons + plan.num_polygons;
  plan.first_obstacle[0] = 0;
  for (std::size_t step = 0; step < plan.horizon_steps; ++step) {
    const double* const reach = plan.reach[step];
    plan.first_in_motion[step] = count;
    for (const PolygonData* before = nullptr; polygon != last && polygon->step == step;
         before = polygon++) {
      // A vehicle that keeps to its former plan has equal areas from both of its plans.
      if (before != nullptr && is_equal(*before, *polygon)) continue;
      const Bounds bounds = bounds_of(*polygon);
      const Doubles centre = all(0.5) * (bounds.lowest + bounds.highest) - origin;
      const Doubles half = all(0.5) * (bounds.highest - bounds.lowest);
      const Doubles place = along_axes(axes, centre[0], centre[1]);
      const Doubles size = along_axes(absolute_axes, half[0], half[1]);
      if (is_beyond(place - size, place + size, reach)) continue;
      for (std::uint32_t second = 1; second + 1 < polygon->size; second += kNextPiece) {
        const std::uint32_t others = polygon->size - second;
        const std::uint32_t lane = count % kFloatLanes;
        BoxesBlock& boxes = plan.obstacle_boxes[count / kFloatLanes];
        boxes.x[lane] = static_cast<float>(centre[0]);
        boxes.y[lane] = static_cast<float>(centre[1]);
        boxes.half_x[lane] = static_cast<float>(half[0]);
        boxes.half_y[lane] = static_cast<float>(half[1]);
        boxes.is_ready = 0;
        plan.obstacles[count] = {static_cast<std::uint32_t>(polygon - plan.polygons), second,
                                 1 + (others < kMostOthers ? others : kMostOthers)};
        ++count;
      }
      if (!polygon->only_in_motion) plan.first_in_motion[step] = count;
      largest_coordinate = larger(absolute(centre) + half, largest_coordinate);
    }
    plan.last_obstacle[step] = count;
    count = (count + kFloatLanes - 1) / kFloatLanes * kFloatLanes;
    plan.first_obstacle[step + 1] = count;
  }
  const double size = largest_coordinate[0] + largest_coordinate[1];
  plan.scale = size > plan.scale ? size : plan.scale;
}

/// An oriented rectangle that contains eight consecutive segments, along the line from the first
/// one's begin to the last one's end.
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

/// Writes eight consecutive segments, the first of them number `first`, into a block.
HLC_INLINE void write_segments(const Plan& plan, std::size_t first, SegmentBlock& block) {
  const Doubles origin{plan.origin_x, plan.origin_y, plan.origin_x, plan.origin_y};
  double along_x[kFloatLanes];
  double along_y[kFloatLanes];
  const std::size_t last = plan.boundary_size - 1;
  for (std::uint32_t lane = 0; lane < kFloatLanes; ++lane) {
    // Repeats the last one: it meets the same areas.
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
    // As with obstacles: no direction, too close for a decision.
    const Doubles length = larger(absolute(x), absolute(y));
    const Doubles scale =
        if_less(all(kLeastLength * plan.scale), length, all(1.0) / length, all(0.0));
    store(block.along_x + lane, x * scale);
    store(block.along_y + lane, y * scale);
  }
}

/// Reach of any step, along the axes of the start's frame: lowest, highest.
struct Reachable {
  float low[kAxes];
  float high[kAxes];
};

/// Whether all segments of a block, on the same axis, lie beyond reach.
HLC_INLINE bool is_beyond(const SegmentBlock& segments, const float* axis_x, const float* axis_y,
                          const Reachable& reachable) {
  const Floats from_x = load(segments.from_x);
  const Floats from_y = load(segments.from_y);
  const Floats to_x = load(segments.to_x);
  const Floats to_y = load(segments.to_y);
  // Above the rounding of coordinates, of their projections and of the reach.
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

/// Blocks of boundary segments within reach in any step.
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
  const double c = start.place[kCos];
  const double s = start.place[kSin];
  const double diagonal = (c - s) * kDiagonal;
  const double other = (c + s) * kDiagonal;
  const double x[kAxes] = {c, diagonal, -s, -other};
  const double y[kAxes] = {s, other, c, diagonal};
  const Axes axes{load(x), load(y)};
  plan.origin_x = start.place[kX];
  plan.origin_y = start.place[kY];
  prepare_obstacles(plan, axes);
  prepare_segments(plan, x, y);
  plan.tolerance = 0x1p-18F * static_cast<float>(plan.scale);
}

}  // namespace
}  // namespace hlc::search::branch_and_bound
