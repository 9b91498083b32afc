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

#define HLC_INLINE [[gnu::always_inline]] inline

#ifdef __AVX2__
using Vector = double __attribute__((vector_size(32)));
using Bits = long long __attribute__((vector_size(32)));
/// The same in memory, at any address of a double.
using VectorInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

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
/// Replaces the last bits, those of `mask`, by those of `number`.
HLC_INLINE Vector numbered(const Vector& a, std::uint64_t mask, const Vector& number) {
  const auto kept = static_cast<long long>(~mask);
  return reinterpret_cast<Vector>((reinterpret_cast<Bits>(a) & Bits{kept, kept, kept, kept}) |
                                  reinterpret_cast<Bits>(number));
}
#else
/// Two halves: the compiler makes poor code of longer vectors than the processor has.
using Half = double __attribute__((vector_size(16)));
using HalfBits = long long __attribute__((vector_size(16)));
using HalfInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));
struct Vector {
  Half low;
  Half high;
  HLC_INLINE double operator[](std::size_t i) const { return i < 2 ? low[i] : high[i - 2]; }
};

HLC_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.low + b.low, a.high + b.high};
}
HLC_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.low - b.low, a.high - b.high};
}
HLC_INLINE Vector operator*(const Vector& a, const Vector& b) {
  return {a.low * b.low, a.high * b.high};
}
HLC_INLINE Vector& operator+=(Vector& a, const Vector& b) { return a = a + b; }
HLC_INLINE Half load_half(const double* from) {
  return *reinterpret_cast<const HalfInMemory*>(from);
}
HLC_INLINE Vector load(const double* from) { return {load_half(from), load_half(from + 2)}; }
HLC_INLINE void store(double* to, const Vector& value) {
  *reinterpret_cast<HalfInMemory*>(to) = value.low;
  *reinterpret_cast<HalfInMemory*>(to + 2) = value.high;
}
HLC_INLINE Vector all(double value) { return {Half{value, value}, Half{value, value}}; }
HLC_INLINE Vector smaller(const Vector& a, const Vector& b) {
  return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}
HLC_INLINE Vector larger(const Vector& a, const Vector& b) {
  return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
HLC_INLINE Half masked(const Half& a, std::uint64_t mask) {
  const auto kept = static_cast<long long>(mask);
  return reinterpret_cast<Half>(reinterpret_cast<HalfBits>(a) & HalfBits{kept, kept});
}
HLC_INLINE Half joined(const Half& a, const Half& b) {
  return reinterpret_cast<Half>(reinterpret_cast<HalfBits>(a) | reinterpret_cast<HalfBits>(b));
}
HLC_INLINE Vector absolute(const Vector& a) {
  constexpr std::uint64_t kNoSign = 0x7fff'ffff'ffff'ffff;
  return {masked(a.low, kNoSign), masked(a.high, kNoSign)};
}
HLC_INLINE Vector numbered(const Vector& a, std::uint64_t mask, const Vector& number) {
  return {joined(masked(a.low, ~mask), number.low), joined(masked(a.high, ~mask), number.high)};
}
#endif

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

/// Square of the distance of four circles' centres from that of another, minus that of the sum of
/// the radii.
HLC_INLINE Vector circle_gap(const double* circle_x, const double* circle_y,
                             const double* circle_radius, double x, double y, double radius) {
  const Vector dx = load(circle_x) - all(x);
  const Vector dy = load(circle_y) - all(y);
  const Vector reach = load(circle_radius) + all(radius);
  return dx * dx + dy * dy - reach * reach;
}

/// Corners of an obstacle in rows, with normals and offsets.
void make_ready(const Plan& plan, const PolygonData& polygon) {
  const std::uint32_t first = polygon.first;
  const double* const corners = polygon.corners;
  const std::uint32_t last = polygon.size - 1;
  const std::uint32_t padded = (polygon.size + kLanes - 1) / kLanes * kLanes;
  for (std::uint32_t i = 0; i < padded; ++i) {
    const std::uint32_t from = i <= last ? i : 0;
    const std::uint32_t to = from == last ? 0 : from + 1;
    const double x = corners[2 * from];
    const double y = corners[2 * from + 1];
    const double along_x = corners[2 * to] - x;
    const double along_y = corners[2 * to + 1] - y;
    plan.obstacle_x[first + i] = x;
    plan.obstacle_y[first + i] = y;
    plan.obstacle_normal_x[first + i] = along_y;
    plan.obstacle_normal_y[first + i] = -along_x;
    plan.obstacle_offset[first + i] = along_y * x - along_x * y;
  }
}

/// How far a point lies outside the edge lines of a polygon, at most (times the edges' lengths).
HLC_INLINE double outside(const double* normal_x, const double* normal_y, const double* offset,
                          std::uint32_t size, double x, double y) {
  Vector most = all(-kForbidden);
  for (std::uint32_t i = 0; i < size; i += kLanes) {
    most =
        larger(most, load(normal_x + i) * all(x) + load(normal_y + i) * all(y) - load(offset + i));
  }
  return largest(most);
}

/// Do an area and an obstacle meet? `x`, `y`: centre of the placed area. A separating-axis test in
/// the area's frame.
HLC_INLINE Answer compare(const Search& search, const Area& area, std::uint32_t item,
                          const VertexData& vertex, double x, double y) {
  const Tables& tables = *search.tables;
  const Plan& plan = *search.plan;
  const PolygonData& polygon = plan.polygons[plan.obstacles[item].polygon];
  if (!plan.obstacles[item].is_ready) {
    make_ready(plan, polygon);
    plan.obstacles[item].is_ready = true;
  }
  if (area.size == 0) return Answer::kApart;
  const std::uint32_t first = polygon.first;
  const std::uint32_t size = polygon.size;
  const double tolerance = plan.tolerance;
  // In a large obstacle the centre tells at once; of areas alike it hardly ever does.
  if (plan.circle_radius[item] > 2.0 * area.radius &&
      outside(plan.obstacle_normal_x + first, plan.obstacle_normal_y + first,
              plan.obstacle_offset + first, size, x, y) < -tolerance) {
    return Answer::kMeet;
  }
  const double c = vertex.cos_heading;
  const double s = vertex.sin_heading;

  // The obstacle's normals, four at a time, against the corners of the area.
  const double* const area_x = tables.area_x + area.first;
  const double* const area_y = tables.area_y + area.first;
  Vector most_apart = all(-kForbidden);
  for (std::uint32_t i = first; i < first + size; i += kLanes) {
    const Vector world_x = load(plan.obstacle_normal_x + i);
    const Vector world_y = load(plan.obstacle_normal_y + i);
    const Vector offset =
        load(plan.obstacle_offset + i) - (world_x * all(vertex.x) + world_y * all(vertex.y));
    const Vector normal_x = world_x * all(c) + world_y * all(s);
    const Vector normal_y = world_y * all(c) - world_x * all(s);
    Vector nearest = all(kForbidden);
    for (std::uint32_t a = 0; a < area.size; ++a) {
      nearest = smaller(nearest, normal_x * all(area_x[a]) + normal_y * all(area_y[a]));
    }
    most_apart = larger(most_apart, nearest - offset);
    if (largest(most_apart) > tolerance) return Answer::kApart;
  }

  // The obstacle's corners seen from the vertex, against the area's normals.
  double* const corner_x = search.corners;
  double* const corner_y = search.corners + search.corner_stride;
  for (std::uint32_t i = 0; i < size; i += kLanes) {
    const Vector dx = load(plan.obstacle_x + first + i) - all(vertex.x);
    const Vector dy = load(plan.obstacle_y + first + i) - all(vertex.y);
    store(corner_x + i, dx * all(c) + dy * all(s));
    store(corner_y + i, dy * all(c) - dx * all(s));
  }
  for (std::uint32_t i = area.first; i < area.first + area.size; i += kLanes) {
    const Vector normal_x = load(tables.area_normal_x + i);
    const Vector normal_y = load(tables.area_normal_y + i);
    Vector nearest = all(kForbidden);
    for (std::uint32_t b = 0; b < size; ++b) {
      nearest = smaller(nearest, normal_x * all(corner_x[b]) + normal_y * all(corner_y[b]));
    }
    most_apart = larger(most_apart, nearest - load(tables.area_offset + i));
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
  const double radius = area.radius + plan.slack;
  for (std::uint32_t i = plan.first_obstacle[step - 1]; i < plan.first_obstacle[step];
       i += kLanes) {
    const Vector gap =
        circle_gap(plan.circle_x + i, plan.circle_y + i, plan.circle_radius + i, x, y, radius);
    if (least(gap) > 0.0) continue;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (gap[lane] > 0.0) continue;
      const Answer answer = compare(search, area, i + lane, vertex, x, y);
      if (answer == Answer::kMeet) return true;
      if (answer == Answer::kTooClose &&
          search.decides(search.decides_context, {edge, false, i + lane, &vertex})) {
        return true;
      }
    }
  }
  return false;
}

/// Four segments in a row.
HLC_INLINE bool meets_block(const Search& search, std::uint32_t edge, const Area& area,
                            std::uint32_t first, const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Vector c = all(vertex.cos_heading);
  const Vector s = all(vertex.sin_heading);
  const Vector from_dx = load(plan.from_x + first) - all(vertex.x);
  const Vector from_dy = load(plan.from_y + first) - all(vertex.y);
  const Vector to_dx = load(plan.to_x + first) - all(vertex.x);
  const Vector to_dy = load(plan.to_y + first) - all(vertex.y);
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
  if (least(beside) > plan.slack) return false;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (beside[lane] > plan.slack) continue;
    const Answer answer =
        compare_segment(search, area, from_x[lane], from_y[lane], to_x[lane], to_y[lane]);
    if (answer == Answer::kMeet) return true;
    if (answer == Answer::kTooClose &&
        search.decides(search.decides_context, {edge, true, first + lane, &vertex})) {
      return true;
    }
  }
  return false;
}

bool meets_segment(const Search& search, std::uint32_t edge, const VertexData& vertex) {
  const Plan& plan = *search.plan;
  const Area& area = search.tables->edges[edge].lane;
  if (area.size == 0) return false;
  const Vector c = all(vertex.cos_heading);
  const Vector s = all(vertex.sin_heading);
  const Vector centre_x = all(0.5 * (area.min_x + area.max_x));
  const Vector centre_y = all(0.5 * (area.min_y + area.max_y));
  const Vector half_x = all(0.5 * (area.max_x - area.min_x) + plan.slack);
  const Vector half_y = all(0.5 * (area.max_y - area.min_y) + plan.slack);
  for (std::uint32_t i = 0; i < plan.num_blocks; i += kLanes) {
    // How far the boxes of four rectangles, in the area's frame, are from that of the area.
    const Vector dx = load(plan.block_x + i) - all(vertex.x);
    const Vector dy = load(plan.block_y + i) - all(vertex.y);
    const Vector along_x = load(plan.block_half_x + i);
    const Vector along_y = load(plan.block_half_y + i);
    const Vector half_width = load(plan.block_half_width + i);
    const Vector beside_x = absolute(dx * c + dy * s - centre_x) -
                            absolute(along_x * c + along_y * s) - half_width - half_x;
    const Vector beside_y = absolute(dy * c - dx * s - centre_y) -
                            absolute(along_y * c - along_x * s) - half_width - half_y;
    const Vector beside = larger(beside_x, beside_y);
    if (least(beside) > 0.0) continue;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (beside[lane] > 0.0) continue;
      if (meets_block(search, edge, area, (i + lane) * kLanes, vertex)) return true;
    }
  }
  return false;
}

HLC_INLINE bool is_free(const Search& search, std::uint32_t edge, std::size_t step,
                        const VertexData& vertex) {
  const Plan& plan = *search.plan;
  if (plan.first_obstacle[step - 1] != plan.first_obstacle[step] &&
      meets_obstacle(search, edge, step, vertex)) {
    return false;
  }
  return plan.num_segments == 0 || !meets_segment(search, edge, vertex);
}

/// Coordinate of padding: far from everything, and its square is still a number.
constexpr double kFarAway = 1e150;
constexpr double kDiagonal = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)

/// Places along the axes of the start's frame.
struct Axes {
  Vector x;
  Vector y;
  double origin_x;
  double origin_y;
};

HLC_INLINE Vector along_axes(const Axes& axes, double x, double y) {
  return axes.x * all(x - axes.origin_x) + axes.y * all(y - axes.origin_y);
}

/// How far the interval lies beside what can be reached, on the axis that has most.
HLC_INLINE double beside(const Vector& low, const Vector& high, const Vector& reach_low,
                         const Vector& reach_high) {
  return largest(larger(low - reach_high, reach_low - high));
}

HLC_INLINE double absolute(double value) { return value < 0.0 ? -value : value; }

/// Obstacles that can be met in their step, with a circle around each.
HLC_INLINE void prepare_obstacles(Plan& plan, const Axes& axes) {
  std::uint32_t count = 0;
  std::size_t next = 0;
  plan.first_obstacle[0] = 0;
  for (std::size_t step = 0; step < plan.horizon_steps; ++step) {
    const Vector reach_low = load(plan.reach[step]);
    const Vector reach_high = load(plan.reach[step] + kAxes);
    for (; next < plan.num_polygons && plan.polygons[next].step == step; ++next) {
      const PolygonData& polygon = plan.polygons[next];
      const double* const corners = polygon.corners;
      // Two corners at a time; the last two may come twice.
      const std::uint32_t last_pair = 2 * polygon.size - 4;
      Vector lowest = load(corners + last_pair);
      Vector highest = lowest;
      for (std::uint32_t i = 0; i < last_pair; i += 4) {
        const Vector pair = load(corners + i);
        lowest = smaller(pair, lowest);
        highest = larger(pair, highest);
      }
      const double min_x = lowest[0] < lowest[2] ? lowest[0] : lowest[2];
      const double min_y = lowest[1] < lowest[3] ? lowest[1] : lowest[3];
      const double max_x = highest[0] > highest[2] ? highest[0] : highest[2];
      const double max_y = highest[1] > highest[3] ? highest[1] : highest[3];
      const double centre_x = 0.5 * (min_x + max_x);
      const double centre_y = 0.5 * (min_y + max_y);
      const double radius = 0.5 * __builtin_sqrt((max_x - min_x) * (max_x - min_x) +
                                                 (max_y - min_y) * (max_y - min_y));
      const Vector centre = along_axes(axes, centre_x, centre_y);
      if (beside(centre, centre, reach_low, reach_high) > radius) continue;
      plan.circle_x[count] = centre_x;
      plan.circle_y[count] = centre_y;
      plan.circle_radius[count] = radius;
      plan.obstacles[count] = {static_cast<std::uint32_t>(next), false};
      ++count;
      const double size = absolute(centre_x) + absolute(centre_y) + radius;
      plan.scale = size > plan.scale ? size : plan.scale;
    }
    for (; count % kLanes != 0; ++count) {
      plan.circle_x[count] = kFarAway;
      plan.circle_y[count] = kFarAway;
      plan.circle_radius[count] = 0.0;
    }
    plan.first_obstacle[step + 1] = count;
  }
}

/// An oriented rectangle that contains four segments in a row, along the line from the first one's
/// begin to the last one's end.
HLC_INLINE void enclose_block(Plan& plan, std::uint32_t block) {
  const std::uint32_t first = kLanes * block;
  double along_x = plan.to_x[first + kLanes - 1] - plan.from_x[first];
  double along_y = plan.to_y[first + kLanes - 1] - plan.from_y[first];
  const double length = __builtin_sqrt(along_x * along_x + along_y * along_y);
  along_x = length > 0.0 ? along_x / length : 1.0;
  along_y = length > 0.0 ? along_y / length : 0.0;
  const Vector from_x = load(plan.from_x + first);
  const Vector from_y = load(plan.from_y + first);
  const Vector to_x = load(plan.to_x + first);
  const Vector to_y = load(plan.to_y + first);
  const Vector from_along = from_x * all(along_x) + from_y * all(along_y);
  const Vector to_along = to_x * all(along_x) + to_y * all(along_y);
  const Vector from_aside = from_y * all(along_x) - from_x * all(along_y);
  const Vector to_aside = to_y * all(along_x) - to_x * all(along_y);
  const double begin = least(smaller(from_along, to_along));
  const double end = largest(larger(from_along, to_along));
  const double right = least(smaller(from_aside, to_aside));
  const double left = largest(larger(from_aside, to_aside));
  const double middle = 0.5 * (begin + end);
  const double aside = 0.5 * (left + right);
  plan.block_x[block] = middle * along_x - aside * along_y;
  plan.block_y[block] = middle * along_y + aside * along_x;
  plan.block_half_x[block] = 0.5 * (end - begin) * along_x;
  plan.block_half_y[block] = 0.5 * (end - begin) * along_y;
  plan.block_half_width[block] = 0.5 * (left - right);
  const double size = absolute(begin) + absolute(end) + absolute(right) + absolute(left);
  plan.scale = size > plan.scale ? size : plan.scale;
}

/// Boundary segments that can be met in any step.
HLC_INLINE void prepare_segments(Plan& plan, const Axes& axes) {
  plan.num_segments = 0;
  plan.num_blocks = 0;
  if (plan.boundary_size == 0) return;
  Vector reach_low = load(plan.reach[0]);
  Vector reach_high = load(plan.reach[0] + kAxes);
  for (std::size_t step = 1; step < plan.horizon_steps; ++step) {
    reach_low = smaller(reach_low, load(plan.reach[step]));
    reach_high = larger(reach_high, load(plan.reach[step] + kAxes));
  }
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < plan.boundary_size; ++i) {
    const double* const ends = plan.boundary + 4 * i;
    const Vector from = along_axes(axes, ends[0], ends[1]);
    const Vector to = along_axes(axes, ends[2], ends[3]);
    if (beside(smaller(from, to), larger(from, to), reach_low, reach_high) > 0.0) continue;
    plan.from_x[count] = ends[0];
    plan.from_y[count] = ends[1];
    plan.to_x[count] = ends[2];
    plan.to_y[count] = ends[3];
    plan.segment_source[count] = static_cast<std::uint32_t>(i);
    ++count;
  }
  plan.num_segments = count;
  for (; count % kLanes != 0; ++count) {  // the last one again: it meets what that one meets
    plan.from_x[count] = plan.from_x[count - 1];
    plan.from_y[count] = plan.from_y[count - 1];
    plan.to_x[count] = plan.to_x[count - 1];
    plan.to_y[count] = plan.to_y[count - 1];
    plan.segment_source[count] = plan.segment_source[count - 1];
  }
  std::uint32_t block = 0;
  for (; kLanes * block < count; ++block) enclose_block(plan, block);
  plan.num_blocks = block;
  for (; block % kLanes != 0; ++block) {
    plan.block_x[block] = kFarAway;
    plan.block_y[block] = kFarAway;
    plan.block_half_x[block] = 0.0;
    plan.block_half_y[block] = 0.0;
    plan.block_half_width[block] = 0.0;
  }
}

void prepare(Plan& plan, const VertexData& start) {
  const double c = start.cos_heading;
  const double s = start.sin_heading;
  const double diagonal = (c - s) * kDiagonal;
  const double other = (c + s) * kDiagonal;
  double x[kAxes] = {c, diagonal, -s, -other};
  double y[kAxes] = {s, other, c, diagonal};
  const Axes axes{load(x), load(y), start.x, start.y};
  prepare_obstacles(plan, axes);
  prepare_segments(plan, axes);
  // Far above the rounding of products of coordinates and edges, which are at most twice the
  // scale; far below what matters.
  plan.tolerance = 1e-12 * (1.0 + plan.scale) * (1.0 + plan.scale);
  plan.slack = 1e-9 * (1.0 + plan.scale);
}

/// How far the reference point lies beyond each of four intervals, on the axis that has most; 0
/// within them all.
HLC_INLINE Vector distance_beyond(const double* along, std::size_t stride,
                                  const double* intervals) {
  Vector beyond = all(0.0);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const Vector from_centre =
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
  const Vector c = all(vertex.cos_heading);
  const Vector s = all(vertex.sin_heading);
  const Vector x = all(vertex.x);
  const Vector y = all(vertex.y);
  for (std::size_t j = 0; j <= level.steps_left; j += kLanes) {
    const Vector dx = load(plan.reference_x + depth + j) - x;
    const Vector dy = load(plan.reference_y + depth + j) - y;
    const Vector ahead = dx * c + dy * s;
    const Vector aside = dy * c - dx * s;
    store(along + j, ahead);
    store(along + stride + j, (ahead + aside) * all(kDiagonal));
    store(along + 2 * stride + j, aside);
    store(along + 3 * stride + j, (aside - ahead) * all(kDiagonal));
  }

  const Vector ahead = all(along[0]);
  const Vector aside = all(along[2 * stride]);
  const Vector cost_to_come = all(vertex.cost_to_come);
  const std::size_t first_edge = std::size_t{kLanes} * tables.first_group[vertex.trim];
  const std::size_t end_edge = std::size_t{kLanes} * tables.first_group[vertex.trim + 1];
  const double* bounds = tables.bounds + first_edge / kLanes * tables.bound_size;
  double* const keys = vertex.keys;
  for (std::size_t edge = first_edge; edge < end_edge; edge += kLanes) {
    const Vector dx = ahead - load(tables.displacement_x + edge);
    const Vector dy = aside - load(tables.displacement_y + edge);
    Vector f = load(level.penalty + edge) + cost_to_come + (dx * dx + dy * dy);
    const double* reference = along + 1;
    const double* intervals = bounds + level.far;
    for (std::size_t i = 0; i < level.num_far; ++i) {
      const Vector beyond = distance_beyond(reference++, stride, intervals);
      f += beyond * beyond;
      intervals += kBoundSize;
    }
    intervals = bounds + level.near;
    for (std::size_t i = 0; i < level.num_near; ++i) {
      const Vector beyond = distance_beyond(reference++, stride, intervals);
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
  Vector lowest = load(keys);
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
