#include "planner/search/branch_and_bound/tables.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "planner/common/demand.hpp"
#include "planner/search/frame.hpp"

namespace hlc::search::branch_and_bound {
namespace {

std::size_t padded(std::size_t size) { return (size + kLanes - 1) / kLanes * kLanes; }

/// The nearest 16-bit integer.
std::int16_t limited(double value) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(std::clamp<double>(value, Limits::min(), Limits::max()));
}

/// A shorter edge has no direction.
constexpr double kLeastEdge_m = 1e-7;

/// Smallest interval that holds the points along an axis.
struct Interval {
  double low{std::numeric_limits<double>::infinity()};
  double high{-std::numeric_limits<double>::infinity()};
};

Interval interval_along(const ConvexPolygon& area_m, const Point& axis) {
  Interval interval;
  for (const Point& corner_m : area_m.vertices_m) {
    interval.low = std::min(interval.low, axis.dot(corner_m));
    interval.high = std::max(interval.high, axis.dot(corner_m));
  }
  return interval;
}

/// The smallest rectangle around an area with one side along an edge.
Surroundings rectangle_around(const ConvexPolygon& area_m) {
  const auto& corners = area_m.vertices_m;
  if (corners.empty()) return {0.0F, 0.0F, 1.0F, 0.0F, kNoRectangle, kNoRectangle};
  const Box box = bounding_box(area_m);  // of an area whose edges are all too short
  const Point middle = 0.5 * (box.min_m + box.max_m);
  const Point half = 0.5 * (box.max_m - box.min_m);
  Surroundings best{static_cast<float>(middle.x()), static_cast<float>(middle.y()), 1.0F, 0.0F,
                    static_cast<float>(half.x()),   static_cast<float>(half.y())};
  double least_size_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t edge = 0; edge < corners.size(); ++edge) {
    const Point side = corners[(edge + 1) % corners.size()] - corners[edge];
    const double length_m = side.norm();
    if (length_m <= kLeastEdge_m) continue;
    const Point along = side / length_m;
    const Point aside{-along.y(), along.x()};
    const Interval ahead = interval_along(area_m, along);
    const Interval left = interval_along(area_m, aside);
    const Point half_size{0.5 * (ahead.high - ahead.low), 0.5 * (left.high - left.low)};
    if (!(half_size.prod() < least_size_m2)) continue;
    least_size_m2 = half_size.prod();
    const Point centre =
        0.5 * (ahead.low + ahead.high) * along + 0.5 * (left.low + left.high) * aside;
    best = {static_cast<float>(centre.x()),    static_cast<float>(centre.y()),
            static_cast<float>(along.x()),     static_cast<float>(along.y()),
            static_cast<float>(half_size.x()), static_cast<float>(half_size.y())};
  }
  return best;
}

/// Whether the origin lies inside an area, with a margin.
bool holds_origin(const ConvexPolygon& area_m) {
  constexpr double kRoom_m = 1e-3;
  const auto& corners = area_m.vertices_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    const double inside = edge.y() * corners[i].x() - edge.x() * corners[i].y();
    if (!(inside > kRoom_m * edge.norm())) return false;
  }
  return !corners.empty();
}

bool is_any_of(const TableStore::Excluded& excluded, bool ends_at_limit,
               const automaton::Maneuver& maneuver) {
  return (excluded.at_limit && ends_at_limit) ||
         (excluded.turning_in_place && turns_in_place(maneuver));
}

}  // namespace

TableStore::TableStore(const automaton::Subgraph& subgraph,
                       const automaton::ReachableSets& reachable, const EdgeCosts& costs) {
  num_trims_ = subgraph.automaton().trims.size();
  max_steps_left_ = reachable.max_steps_left();
  HLC_DEMAND(reachable.max_steps() <= kMostSteps, reachable.max_steps(), kMostSteps);
  const std::size_t max_steps = std::max<std::size_t>(reachable.max_steps(), 1);
  add_edges(subgraph, costs);
  list_permitted(subgraph, costs, max_steps);
  choose_unit();
  compute_bounds(reachable);
  list_levels(max_steps);
  list_reach(subgraph, reachable);

  view_.edges = edges_.data();
  view_.first_group = first_group_.data();
  view_.displacement_x = displacement_x_.data();
  view_.displacement_y = displacement_y_.data();
  view_.bounds = bounds_.data();
  view_.numbers = numbers_.data();
  view_.area_blocks = area_blocks_.data();
  view_.lane_areas = lane_areas_.data();
  view_.around = around_.data();
}

void TableStore::add_edges(const automaton::Subgraph& subgraph, const EdgeCosts& costs) {
  const std::size_t num_trims = num_trims_;
  first_group_.push_back(0);
  for (std::size_t trim = 0; trim < num_trims; ++trim) {
    const auto successors = subgraph.successors({trim});
    for (const automaton::Edge& edge : successors) {
      const automaton::Maneuver& maneuver = *edge.maneuver;
      const Frame displacement = to_frame(maneuver.displacement);
      longest_m_ = std::max(longest_m_, displacement.origin_m.norm());
      area_radius_m_ = std::max(area_radius_m_, displacement.origin_m.norm());
      maneuvers_.push_back(&maneuver);
      edges_.push_back(edge_data(edge, displacement, costs));
      lane_areas_.push_back(add_lane_area(maneuver.lane_area_m));
    }
    add_surroundings(successors);
    while (edges_.size() % kLanes != 0 || edges_.size() == kLanes * first_group_.back()) {
      maneuvers_.push_back(nullptr);
      edges_.push_back({});
      lane_areas_.push_back({});
    }
    most_edges_ = std::max(most_edges_, padded(successors.size()));
    first_group_.push_back(static_cast<std::uint32_t>(edges_.size() / kLanes));
  }
  most_edges_ = std::max<std::size_t>(most_edges_, kLanes);
  view_.index_mask = std::bit_ceil(most_edges_) - 1;
  for (std::uint64_t number = 0; number < most_edges_; ++number) {
    numbers_.push_back(std::bit_cast<double>(number));
  }
  for (const EdgeData& edge : edges_) {
    displacement_x_.push_back(edge.displacement[kX]);
    displacement_y_.push_back(edge.displacement[kY]);
  }
}

void TableStore::add_surroundings(std::span<const automaton::Edge> successors) {
  std::vector<ConvexPolygon> areas_m;
  bool all_hold_start = true;
  for (const automaton::Edge& edge : successors) {
    const ConvexPolygon& area_m = edge.maneuver->swept_area_m;
    if (!area_m.empty()) areas_m.push_back(area_m);
    all_hold_start = all_hold_start && holds_origin(area_m);
  }
  around_.push_back(rectangle_around(areas_m.empty() ? ConvexPolygon{} : convex_hull(areas_m)));
  around_.back().all_hold_start = all_hold_start;
}

EdgeData TableStore::edge_data(const automaton::Edge& edge, const Frame& displacement,
                               const EdgeCosts& costs) {
  const double x_m = displacement.origin_m.x();
  const double y_m = displacement.origin_m.y();
  const double c = displacement.cos_heading;
  const double s = displacement.sin_heading;
  EdgeData data{.displacement = {x_m, y_m, c, s},
                .turned = {-y_m, x_m, -s, c},
                .cost = costs.reduced_cost(*edge.maneuver),
                .to = static_cast<std::uint32_t>(edge.to.index),
                .first_swept = static_cast<std::uint32_t>(area_blocks_.size()),
                .stands = stands_in(*edge.maneuver)};
  const auto& corners = edge.maneuver->swept_area_m.vertices_m;
  for (std::size_t first = 1; first + 1 < corners.size(); first += kNextPiece) {
    const std::size_t last = std::min(first + kMostOthers, corners.size());
    std::vector<Point> piece{corners.front()};
    for (std::size_t i = first; i < last; ++i) piece.push_back(corners[i]);
    add_blocks(piece);
    ++data.num_swept;
  }
  return data;
}

LaneArea TableStore::add_lane_area(const ConvexPolygon& area_m) {
  const auto& corners = area_m.vertices_m;
  LaneArea area{};
  area.first_block = static_cast<std::uint32_t>(area_blocks_.size());
  area.num_blocks = static_cast<std::uint32_t>(blocks_of(corners.size()));
  if (corners.empty()) return area;
  add_blocks({corners.data(), corners.size()});
  const Box box = bounding_box(area_m);
  const Point centre = 0.5 * (box.min_m + box.max_m);
  area.centre_x = static_cast<float>(centre.x());
  area.centre_y = static_cast<float>(centre.y());
  area.half_x = static_cast<float>(0.5 * (box.max_m.x() - box.min_m.x()));
  area.half_y = static_cast<float>(0.5 * (box.max_m.y() - box.min_m.y()));
  return area;
}

void TableStore::add_blocks(std::span<const Point> corners) {
  const std::size_t first_block = area_blocks_.size();
  area_blocks_.resize(first_block + blocks_of(corners.size()));
  for (std::size_t i = 0; i < blocks_of(corners.size()) * kFloatLanes; ++i) {
    const bool is_padding = i >= corners.size();
    const Point& from = corners[is_padding ? 0 : i];
    const Point along =
        is_padding ? Point::Zero() : Point(corners[(i + 1) % corners.size()] - from);
    const double length = along.cwiseAbs().maxCoeff();
    const Point normal =
        length > kLeastEdge_m ? Point(along.y() / length, -along.x() / length) : Point::Zero();
    PolygonBlock& block = area_blocks_[first_block + i / kFloatLanes];
    const std::size_t lane = i % kFloatLanes;
    block.x[lane] = static_cast<float>(from.x());
    block.y[lane] = static_cast<float>(from.y());
    block.normal_x[lane] = static_cast<float>(normal.x());
    block.normal_y[lane] = static_cast<float>(normal.y());
    block.offset[lane] = is_padding ? kSeparatesNothing : static_cast<float>(normal.dot(from));
    area_radius_m_ = std::max(area_radius_m_, from.norm());
  }
}

void TableStore::list_permitted(const automaton::Subgraph& subgraph, const EdgeCosts& costs,
                                std::size_t max_steps) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const std::size_t rows = costs.is_zero() ? max_steps_left_ + 1 : max_steps;
  penalty_rows_ = rows;
  std::vector<bool> is_at_limit;
  for (const automaton::Trim& trim : automaton.trims) {
    is_at_limit.push_back(
        automaton::is_at_steering_limit(trim, automaton.vehicle, automaton.identified));
  }
  for (const Excluded& excluded : kChoices) {
    auto& penalty = penalty_[number_of(excluded)];
    auto& permitted = permitted_[number_of(excluded)];
    penalty.assign(rows * edges_.size(), kForbidden);
    permitted.assign(rows * num_trims_, 0);
    for (std::size_t left = 0; left < rows; ++left) {
      for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
        const automaton::Maneuver* const maneuver = maneuvers_[edge];
        if (maneuver == nullptr || subgraph.distance_to_standstill(maneuver->to) > left) continue;
        if (is_any_of(excluded, is_at_limit[maneuver->to.index], *maneuver)) continue;
        penalty[left * edges_.size() + edge] = edges_[edge].cost + costs.to_go(maneuver->to, left);
        ++permitted[left * num_trims_ + maneuver->from.index];
      }
    }
  }
}

void TableStore::choose_unit() {
  // Fine enough near the vehicle, and coarse enough that horizons of sixteen steps stay within 16
  // bits.
  constexpr double kCountedSteps = 40.0;
  constexpr double kLargest = std::numeric_limits<std::int16_t>::max();
  constexpr double kLeastUnit_m = 0x1p-40;  // single precision has its square and its reciprocal
  view_.units_per_m =
      static_cast<float>(1.0 / std::max(kCountedSteps * longest_m_ / kLargest, kLeastUnit_m));
  const auto units_per_m = static_cast<double>(view_.units_per_m);
  const double unit_m = 1.0 / units_per_m;
  counted_m_ = (kLargest - 1.0) * (1.0 - 0x1p-17) * unit_m;
  view_.squared_unit_m2 = static_cast<float>(unit_m * unit_m);
  for (EdgeData& edge : edges_) {
    edge.move = {static_cast<float>(edge.displacement[kX] * units_per_m),
                 static_cast<float>(edge.displacement[kY] * units_per_m),
                 static_cast<float>(edge.displacement[kCos]),
                 static_cast<float>(edge.displacement[kSin])};
  }
}

// With u = 2^-24, let L be the distance from the start to the farthest vertex of kMostSteps steps,
// D the longest displacement, q a reference point seen from a vertex and p its coordinate along an
// axis. Seen from the start, in single precision, the error of q is at most 6 u ||q|| + 2 u L. A
// step from one vertex to the next adds at most 5 u ||q_i|| + u D, where q_i is seen from the i-th
// of seven, so that ||q_i|| <= ||q|| + (7 - i) D, and the axis 3 u ||q||. So after a row of eight
// vertices the error of p is at most (6 + 7 * 5 + 3) u ||q|| + 2 u L + (7 * 6 + 21 * 5 + 7) u D.
// Let R be the largest |c| + w of all axes. Intervals that are 192 u R + 4 u L + 256 u D wider on
// both sides cover the last two terms and, where ||q|| is at most 4 R, the first. Beyond, the
// distance on the axis with the largest is at least 0.98 ||q|| - R > 0.7 ||q||, so its relative
// error is less than 63 u and that of its square less than 128 u.
//
// Then p is rounded to an integer number of units, by at most a half, by which the intervals are
// wider, too. From there on everything is exact except the sum of squares and its scale: m / 4 + 4
// roundings. Factor kSurely, 1 - 160 u, covers them and the square above.
//
// Where p might exceed 16 bits, everything is computed in double precision. Two axes together take
// the difference of two squares, which makes rounding some 14 times as large; with m terms it stays
// below 2^-44 of the sum, and kSurelyFar is 1 - 2^-40.
//
// Nothing here depends on the number of steps of the tables: equal searches expand equally many
// vertices.
static_assert(kSeenInARow == 8);

void TableStore::compute_bounds(const automaton::ReachableSets& reachable) {
  constexpr double kRelative = 0xCp-20;
  const double farthest = (0x1p-22 * static_cast<double>(kMostSteps) + 0x1p-16) * longest_m_;
  const double unit_m = 1.0 / static_cast<double>(view_.units_per_m);
  const std::size_t cap = max_steps_left_;
  const std::size_t max_steps = std::max<std::size_t>(reachable.max_steps(), 1) - 1;
  num_bound_blocks_ = (max_steps + kBoundSteps - 1) / kBoundSteps;
  // Rows by the steps left after the first of four steps, the last row for all cases in which even
  // the last of the four is above the cap.
  const std::size_t rows = cap + kBoundSteps;
  view_.bound_size = rows * num_bound_blocks_;
  bounds_.assign(edges_.size() / kLanes * view_.bound_size, BoundBlock{});
  for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
    if (maneuvers_[edge] == nullptr) continue;
    const EdgeData& data = edges_[edge];
    const Frame frame{{data.displacement[kX], data.displacement[kY]},
                      data.displacement[kCos],
                      data.displacement[kSin]};
    const auto write = [&](BoundBlock& bound, std::size_t lane, std::size_t steps,
                           std::size_t left) {
      std::array<Interval, kBoundAxes> intervals;
      const auto positions_m = reachable.positions_m({data.to}, steps, left);
      if (positions_m.empty()) return;  // no permitted edge needs it
      for (const Point& position_m : positions_m) {
        const Point seen_m = transformed(position_m, frame);
        for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
          const double along_m = automaton::kReachDirections[axis][0] * seen_m.x() +
                                 automaton::kReachDirections[axis][1] * seen_m.y();
          intervals[axis].low = std::min(intervals[axis].low, along_m);
          intervals[axis].high = std::max(intervals[axis].high, along_m);
        }
      }
      double reach_m = 0.0;
      for (Interval& interval : intervals) {
        interval.low -= automaton::ReachableSets::allowance_m(steps + 1);
        interval.high += automaton::ReachableSets::allowance_m(steps + 1);
        reach_m = std::max({reach_m, -interval.low, interval.high});
      }
      const double wider_m = kRelative * reach_m + farthest + 0.5 * unit_m;
      for (std::size_t axis = 0; axis < kBoundAxes; ++axis) {
        bound.low[axis][lane] = limited(std::floor((intervals[axis].low - wider_m) / unit_m));
        bound.high[axis][lane] = limited(std::ceil((intervals[axis].high + wider_m) / unit_m));
      }
    };
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t block = 0; block < num_bound_blocks_; ++block) {
        BoundBlock& bound =
            bounds_[edge / kLanes * view_.bound_size + row * num_bound_blocks_ + block];
        for (std::size_t step = 0; step < kBoundSteps; ++step) {
          const std::size_t lane = 8 * (step / 2) + 2 * (edge % kLanes) + step % 2;
          const std::size_t steps = kBoundSteps * block + step + 1;
          if (step <= row && steps <= max_steps) {
            write(bound, lane, steps, std::min(row - step, cap));
          } else {  // a step beyond the horizon
            for (auto& lows : bound.low) lows[lane] = std::numeric_limits<std::int16_t>::min();
            for (auto& highs : bound.high) highs[lane] = std::numeric_limits<std::int16_t>::max();
          }
        }
      }
    }
  }
}

void TableStore::list_levels(std::size_t max_steps) {
  for (std::size_t steps_left = 0; steps_left < max_steps; ++steps_left) {
    auto& places = bound_places_.emplace_back();
    for (std::size_t block = 0; kBoundSteps * block < steps_left; ++block) {
      const std::size_t left = steps_left - (kBoundSteps * block + 1);
      const std::size_t row = std::min<std::size_t>(left, max_steps_left_ + kBoundSteps - 1);
      places.push_back(static_cast<std::uint32_t>(row * num_bound_blocks_ + block));
    }
  }
  for (std::size_t choice = 0; choice < kChoices.size(); ++choice) {
    for (std::size_t steps_left = 0; steps_left < max_steps; ++steps_left) {
      const std::size_t left = std::min(steps_left, penalty_rows_ - 1);
      levels_[choice].push_back(
          {&penalty_[choice][left * edges_.size()], &permitted_[choice][left * num_trims_],
           bound_places_[steps_left].size(), bound_places_[steps_left].data()});
    }
  }
}

void TableStore::list_reach(const automaton::Subgraph& subgraph,
                            const automaton::ReachableSets& reachable) {
  constexpr double kSlackM = 1e-6;  // covers rounding for areas that only just touch
  const double beyond_m = area_radius_m_ + kSlackM;
  reach_steps_ = std::max<std::size_t>(reachable.max_steps(), 1);
  const std::size_t rows = max_steps_left_ + 1;
  reach_.resize(num_trims_ * rows * reach_steps_ * kReachSize);
  for (const TrimId trim : subgraph.start_trims()) {
    for (std::size_t left = 0; left < rows; ++left) {
      for (std::size_t steps = 0; steps < reach_steps_; ++steps) {
        const automaton::Reach& reach = reachable.reach(trim, steps, left);
        double* const row = &reach_[reach_row(trim, steps, left)];
        for (std::size_t axis = 0; axis < kAxes; ++axis) {
          row[axis] = -reach.support_m[2 * axis + kBoundAxes] - beyond_m;
          row[axis + kAxes] = reach.support_m[2 * axis] + beyond_m;
        }
      }
    }
  }
}

const double* TableStore::reach(TrimId trim, std::size_t steps, std::size_t steps_left) const {
  return &reach_[reach_row(trim, steps, std::min(steps_left, max_steps_left_))];
}

std::size_t TableStore::reach_row(TrimId trim, std::size_t steps, std::size_t steps_left) const {
  return ((trim.index * (max_steps_left_ + 1) + steps_left) * reach_steps_ + steps) * kReachSize;
}

std::uint32_t TableStore::find(TrimId trim, const automaton::Maneuver* maneuver) const {
  for (std::size_t edge = kLanes * first_group_[trim.index];
       edge < kLanes * first_group_[trim.index + 1]; ++edge) {
    if (maneuver != nullptr && maneuvers_[edge] == maneuver) {
      return static_cast<std::uint32_t>(edge);
    }
  }
  return kNoEdge;
}

}  // namespace hlc::search::branch_and_bound
