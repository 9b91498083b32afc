#include "planner/road/town_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/road/lane_lines.hpp"

namespace hlc::road {
namespace {

constexpr double kApart_m = 2.4;      // crossings, centre to centre
constexpr double kHalf_m = 0.65;      // centre of a crossing to where its roads begin
constexpr double kAside_m = 0.10;     // middle of a road to that of a lane
constexpr int kPieces = 2;            // lanelets of a lane between two crossings
constexpr double kRamp_share = 0.15;  // of a turn's length, at either end

constexpr int kLeft = 1;  // directions count counterclockwise: east 0, north, west, south
constexpr int kRight = 3;
constexpr int kDirections = 4;

/// A crossing, junction or bend. The road around the town has the first and the last of each.
struct Place {
  int column{};
  int row{};
};

double heading_rad(int direction) { return std::numbers::pi / 2.0 * direction; }

Place next(const Place& place, int direction) {
  constexpr int kEast[] = {1, 0, -1, 0};
  constexpr int kNorth[] = {0, 1, 0, -1};
  return {place.column + kEast[direction], place.row + kNorth[direction]};
}

/// In the lane that leads in this direction, `ahead_m` from the middle of the place.
Pose in_lane(const Place& place, int direction, double ahead_m) {
  const double heading = heading_rad(direction);
  return shifted({.x_m = kApart_m * place.column + ahead_m * std::cos(heading),
                  .y_m = kApart_m * place.row + ahead_m * std::sin(heading),
                  .heading_rad = heading},
                 -kAside_m);
}

Knots turn_of(double length_m, double curvature_per_m) {
  return {{0.0, 0.0},
          {kRamp_share * length_m, curvature_per_m},
          {(1.0 - kRamp_share) * length_m, curvature_per_m},
          {length_m, 0.0}};
}

/// A turn by 90 degrees that leads `across_m` ahead and as far to the side.
/// @param sign  1: to the left, -1: to the right
CurvatureCurve turn(const Pose& begin, double sign, double across_m) {
  constexpr double kTurned = std::numbers::pi / 2.0 / (1.0 - kRamp_share);
  const double unit_m = CurvatureCurve({}, turn_of(1.0, kTurned)).at(1.0).x_m;
  const double length_m = across_m / unit_m;
  return {begin, turn_of(length_m, sign * kTurned / length_m)};
}

class Town {
 public:
  explicit Town(const Blocks& blocks) : columns_(blocks.columns + 2), rows_(blocks.rows + 2) {
    map_.benchmark_id = fmt::format("ZAM_Town{}x{}-1_1_T-1", blocks.columns, blocks.rows);
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) add({column, row});
    }
    link(map_);
  }

  [[nodiscard]] LaneletMap take() { return std::move(map_); }

 private:
  [[nodiscard]] bool has_arm(const Place& place, int direction) const {
    const Place other = next(place, direction);
    return other.column >= 0 && other.column < columns_ && other.row >= 0 && other.row < rows_;
  }

  void add(const Place& place) {
    for (int direction = 0; direction < kDirections; ++direction) {
      if (has_arm(place, direction)) add_road(place, direction);
      if (has_arm(place, (direction + 2) % kDirections)) add_ways(place, direction);
    }
  }

  /// The lane to the next place.
  void add_road(const Place& place, int direction) {
    const double piece_m = (kApart_m - 2.0 * kHalf_m) / kPieces;
    for (int i = 0; i < kPieces; ++i) {
      add_straight(in_lane(place, direction, kHalf_m + i * piece_m), piece_m);
    }
  }

  /// The ways on for who comes driving in this direction.
  void add_ways(const Place& place, int direction) {
    const Pose begin = in_lane(place, direction, -kHalf_m);
    if (has_arm(place, direction)) add_straight(begin, 2.0 * kHalf_m);
    for (const int side : {kLeft, kRight}) {
      const int out = (direction + side) % kDirections;
      if (!has_arm(place, out)) continue;
      const double sign = side == kLeft ? 1.0 : -1.0;
      const CurvatureCurve curve = turn(begin, sign, kHalf_m + sign * kAside_m);
      add_lane(stretch(curve, 0.0, curve.length_m(), begin, in_lane(place, out, kHalf_m)));
    }
  }

  void add_straight(const Pose& begin, double length_m) {
    const CurvatureCurve line(begin, {{0.0, 0.0}, {length_m, 0.0}});
    add_lane({begin, line.at(length_m)});
  }

  void add_lane(const Line& line) {
    const auto id = static_cast<LaneletId>(map_.lanelets.size()) + 1;
    map_.lanelets.emplace(id, lane_along(line, id));
  }

  int columns_;
  int rows_;
  LaneletMap map_;
};

}  // namespace

LaneletMap town_map(Blocks blocks) {
  HLC_DEMAND(blocks.columns >= 1 && blocks.columns <= Blocks::kMost, blocks.columns);
  HLC_DEMAND(blocks.rows >= 1 && blocks.rows <= Blocks::kMost, blocks.rows);
  return Town(blocks).take();
}

}  // namespace hlc::road
