#include "planner/road/lab_network_map.hpp"

#include <numbers>

#include "planner/road/lane_lines.hpp"

namespace hlc::road {
namespace {

constexpr double kToTheRight_m = -kLaneWidth_m;
constexpr int kLaneletsOfAQuarter = 26;

// Curves of the quarter x >= 2.25 m, y >= 2.0 m: {arc length [m], curvature [1/m]}.
const Knots kRing = {{0.0, 0.0135},     {0.4880, -0.0077}, {0.9440, -0.2718}, {1.3686, -0.7994},
                     {1.7769, -1.5872}, {2.3109, -0.6240}, {2.8076, -0.1098}, {3.3152, 0.0265}};
const Knots kRingToArm = {{0.0, -0.6048},    {0.2621, -1.4939}, {0.5500, -1.7444},
                          {0.8406, -1.4379}, {1.4345, -0.2387}, {1.7258, 0.0386}};
const Knots kArmToRing = {{0.0, 0.0013},     {0.3802, -1.0019}, {0.6633, -1.5645},
                          {0.9421, -1.7083}, {1.2141, -1.2928}, {1.4689, -0.3016}};
const Knots kOntoRing = {{0.0, 0.1550}, {0.1575, 1.8606}, {0.5213, -3.1476}, {0.6801, -1.5878}};
const Knots kOffRing = {{0.0, -1.5661}, {0.1910, -3.2899}, {0.6028, 0.8795}, {0.7675, -0.2615}};
const Knots kTurn = {
    {0.0, -0.0824}, {0.3028, -1.3675}, {0.6590, -1.8109}, {1.0152, -1.3675}, {1.3180, -0.0824}};
// Arc lengths at which lanelets meet.
constexpr double kRingJoined_m = 0.900;  // by the lane from the arm
constexpr double kRingMiddle_m = 1.580;
constexpr double kRingLeft_m = 2.383;  // by the lane to the arm
constexpr double kMiddleToArm_m = 0.8625;
constexpr double kMiddleFromArm_m = 0.7335;

constexpr double kWestwards_rad = std::numbers::pi;
constexpr double kNorthwards_rad = std::numbers::pi / 2.0;
const Pose kTop{.x_m = 2.25, .y_m = 3.745, .heading_rad = 0.0};  // of the inner lane
const Pose kRightmost{.x_m = 4.245, .y_m = 2.0, .heading_rad = -std::numbers::pi / 2.0};
// Between the directions of travel, where the arms meet the intersection, and in its middle.
const Pose kRightArm{.x_m = 3.05, .y_m = 2.0, .heading_rad = kWestwards_rad};
const Pose kTopArm{.x_m = 2.25, .y_m = 2.8, .heading_rad = kNorthwards_rad};
const Pose kCentreWestwards{.x_m = 2.25, .y_m = 2.0, .heading_rad = kWestwards_rad};
const Pose kCentreNorthwards{.x_m = 2.25, .y_m = 2.0, .heading_rad = kNorthwards_rad};

/// Adds a lane, its mirror images and the turned one. @param id  1 to 26
void add_lanes(LaneletMap& map, LaneletId id, const Line& line, double left_m = 0.0) {
  for (const Line& one : {line, mirrored_x(line), mirrored_y(line), turned(line)}) {
    map.lanelets.emplace(id, lane_along(one, id, left_m));
    id += kLaneletsOfAQuarter;
  }
}

Line straight(const Pose& from, const Pose& to) {
  const double length_m = (to.position_m() - from.position_m()).norm();
  return stretch(CurvatureCurve(from, {{0.0, 0.0}, {length_m, 0.0}}), 0.0, length_m, from, to);
}

Line whole(const Pose& begin, const Knots& knots, const Pose& end) {
  const CurvatureCurve curve(begin, knots);
  return stretch(curve, 0.0, curve.length_m(), begin, end);
}

void add_ring_and_arms(LaneletMap& map) {
  const CurvatureCurve ring(kTop, kRing);
  const Pose joined = ring.at(kRingJoined_m);
  const Pose middle = ring.at(kRingMiddle_m);
  const Pose left = ring.at(kRingLeft_m);
  const auto add_ring = [&](LaneletId id, const Line& line) {
    add_lanes(map, id, line);
    add_lanes(map, id + 1, line, kLaneWidth_m);
  };
  add_ring(1, stretch(ring, 0.0, kRingJoined_m, kTop, joined));
  add_ring(3, stretch(ring, kRingJoined_m, kRingMiddle_m, joined, middle));
  add_ring(5, stretch(ring, kRingMiddle_m, kRingLeft_m, middle, left));
  add_ring(7, stretch(ring, kRingLeft_m, ring.length_m(), left, kRightmost));

  const auto add_arm = [&](LaneletId id, const Pose& begin, const Knots& knots, double middle_m,
                           const Pose& end) {
    const CurvatureCurve arm(begin, knots);
    const Pose half = arm.at(middle_m);
    const Line first = stretch(arm, 0.0, middle_m, begin, half);
    const Line second = stretch(arm, middle_m, arm.length_m(), half, end);
    add_lanes(map, id, first);
    add_lanes(map, id + 1, first, kToTheRight_m);
    add_lanes(map, id + 2, second);
    add_lanes(map, id + 3, second, kToTheRight_m);
  };
  add_arm(9, left, kRingToArm, kMiddleToArm_m, shifted(kRightArm, kToTheRight_m / 2.0));
  add_arm(13, shifted(kTopArm, kToTheRight_m / 2.0), kArmToRing, kMiddleFromArm_m, joined);
  add_lanes(map, 22, whole(shifted(joined, kToTheRight_m), kOntoRing, middle));
  add_lanes(map, 23, whole(middle, kOffRing, shifted(left, kToTheRight_m)));
}

void add_intersection(LaneletMap& map) {
  const auto add_pair = [&](LaneletId inner, LaneletId outer, const Line& line) {
    add_lanes(map, inner, line, kToTheRight_m / 2.0);
    add_lanes(map, outer, line, 1.5 * kToTheRight_m);
  };
  const Line turn = whole(kRightArm, kTurn, kTopArm);
  add_pair(25, 18, turn);
  add_pair(20, 21, driven_back(turn));
  add_pair(26, 17, straight(kRightArm, kCentreWestwards));
  add_pair(24, 19, straight(kCentreNorthwards, kTopArm));
}

}  // namespace

LaneletMap lab_network_map() {
  LaneletMap map{.benchmark_id = "ZAM_LabNetwork-1_1_T-1", .lanelets = {}};
  add_ring_and_arms(map);
  add_intersection(map);
  link(map);
  return map;
}

}  // namespace hlc::road
