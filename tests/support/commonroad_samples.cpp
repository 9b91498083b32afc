#include "tests/support/commonroad_samples.hpp"

#include <cmath>
#include <numbers>

namespace hlc::test {
namespace {

constexpr double kWidth_m = CommonRoadSketch::kLaneWidth_m;
constexpr double kQuarter_rad = std::numbers::pi / 2.0;

/// A goal across a lane that runs in direction of the heading.
std::string across(const Pose& middle) { return rectangle_at(middle, {12.0, 3.4}); }

/// One lane of 80 m to the east.
CommonRoadSketch one_lane() {
  return CommonRoadSketch().lane(1, straight({0.0, 0.0}, {80.0, 0.0}));
}

/// Two lanes of 100 m to the east, 2 to the left of 1.
CommonRoadSketch two_lanes() {
  return CommonRoadSketch()
      .lane(1, straight({0.0, 0.0}, {100.0, 0.0}))
      .lane(2, straight({0.0, kWidth_m}, {100.0, kWidth_m}))
      .beside(2, 1);
}

/// 20 m to the east, a bend, and 30 m on.
CommonRoadSketch bend(double turned_rad) {
  const Line curve = arc({20.0, 0.0, 0.0}, 18.0, turned_rad);
  const Point end_m = curve.back().position_m();
  const Point on_m = transformed(Point(30.0, 0.0), curve.back());
  return CommonRoadSketch()
      .lane(1, straight({0.0, 0.0}, {20.0, 0.0}))
      .lane(2, curve)
      .lane(3, straight(end_m, on_m))
      .joined(1, 2)
      .joined(2, 3);
}

/// 1 and 2 merge into 3, which leads to the east.
CommonRoadSketch merge() {
  const Line ramp = arc({20.0, -12.0, 0.4}, 60.0, -0.4);
  const Point end_m = ramp.back().position_m();
  return CommonRoadSketch()
      .lane(1, straight({0.0, end_m.y()}, end_m))
      .lane(2, ramp)
      .lane(3, straight(end_m, end_m + Point(60.0, 0.0)))
      .joined(1, 3)
      .joined(2, 3);
}

/// 1 to the east and 2 to the north cross in the origin.
CommonRoadSketch crossing() {
  return CommonRoadSketch()
      .lane(1, straight({-40.0, 0.0}, {40.0, 0.0}))
      .lane(2, straight({0.0, -40.0}, {0.0, 40.0}));
}

/// 1 forks into 2, straight on, and 3, to the left.
CommonRoadSketch fork() {
  return CommonRoadSketch()
      .lane(1, straight({0.0, 0.0}, {30.0, 0.0}))
      .lane(2, straight({30.0, 0.0}, {80.0, 0.0}))
      .lane(3, arc({30.0, 0.0, 0.0}, 25.0, kQuarter_rad))
      .joined(1, 2)
      .joined(1, 3);
}

/// Four quarters of a circle around the origin, driven counter-clockwise.
CommonRoadSketch roundabout() {
  CommonRoadSketch sketch;
  for (int i = 0; i < 4; ++i) {
    const double at_rad = i * kQuarter_rad;
    sketch.lane(i + 1,
                arc({20.0 * std::cos(at_rad), 20.0 * std::sin(at_rad), at_rad + kQuarter_rad}, 20.0,
                    kQuarter_rad));
  }
  return sketch.joined(1, 2).joined(2, 3).joined(3, 4).joined(4, 1);
}

const Pose kStart{10.0, 0.0, 0.0};

void add_goals(std::vector<CommonRoadSample>& samples) {
  samples.push_back(
      {"rectangle", one_lane().problem(7, kStart, {across({60.0, 0.0, 0.0})}).xml(), 1});
  samples.push_back(
      {"circle", one_lane().problem(7, kStart, {circle_at({55.0, 0.5}, 6.0)}).xml(), 1});
  samples.push_back(
      {"polygon",
       one_lane()
           .problem(7, kStart, {polygon_at({{50.0, -2.0}, {64.0, -1.0}, {62.0, 2.0}, {49.0, 2.0}})})
           .xml(),
       1});
  samples.push_back({"lanelet", bend(kQuarter_rad).problem(7, kStart, {lanelet_ref(3)}).xml(), 1});
  samples.push_back({"second_goal",
                     fork().problem(7, kStart, {across({20.0, 60.0, 0.0}), lanelet_ref(2)}).xml(),
                     1});
  samples.push_back({"beside_the_middle",
                     one_lane().problem(7, {10.0, -0.6, 0.1}, {across({60.0, 0.0, 0.0})}).xml(),
                     1});
  samples.push_back(
      {"heading_and_speed",
       one_lane()
           .in_goals("<orientation><intervalStart>-0.8</intervalStart><intervalEnd>0.8"
                     "</intervalEnd></orientation><velocity><intervalStart>0"
                     "</intervalStart><intervalEnd>3</intervalEnd></velocity>")
           .problem(7, kStart, {across({60.0, 0.0, 0.0})})
           .xml(),
       1});
}

void add_roads(std::vector<CommonRoadSample>& samples) {
  samples.push_back(
      {"left_bend", bend(kQuarter_rad).problem(7, kStart, {lanelet_ref(3)}).xml(), 1});
  samples.push_back(
      {"right_bend", bend(-kQuarter_rad).problem(7, kStart, {lanelet_ref(3)}).xml(), 1});
  samples.push_back(
      {"left_fork", fork().problem(7, kStart, {across({53.3, 15.94, 1.2})}).xml(), 1});
  samples.push_back({"lane_to_the_left",
                     two_lanes().problem(7, kStart, {across({70.0, kWidth_m, 0.0})}).xml(), 1});
  samples.push_back(
      {"lane_to_the_right",
       two_lanes().problem(7, {10.0, kWidth_m, 0.0}, {across({70.0, 0.0, 0.0})}).xml(), 1});
  samples.push_back(
      {"roundabout",
       roundabout()
           .problem(7, {14.142135624, 14.142135624, 3.0 * std::numbers::pi / 4.0}, {lanelet_ref(4)})
           .xml(),
       1});
}

void add_obstacles(std::vector<CommonRoadSample>& samples) {
  samples.push_back({"parked_car",
                     two_lanes()
                         .parked_car(50, {45.0, 0.0, 0.0})
                         .problem(7, kStart, {across({85.0, 0.0, 0.0})})
                         .xml(),
                     1});
  samples.push_back({"two_parked_cars",
                     two_lanes()
                         .parked_car(50, {35.0, -0.6, 0.0})
                         .parked_car(51, {68.0, kWidth_m + 0.6, 0.0})
                         .problem(7, kStart, {across({88.0, 0.0, 0.0})})
                         .xml(),
                     1});
  samples.push_back(
      {"obstacle_field",
       CommonRoadSketch()
           .lane(1, straight({0.0, 0.0}, {100.0, 0.0}), 16.0)
           .obstacle(50, {35.0, 0.5, 0.0}, "<circle><radius>1.0</radius></circle>")
           .obstacle(51, {50.0, -4.0, 0.3},
                     "<rectangle><length>3</length><width>2</width></rectangle>")
           .obstacle(52, {62.0, 3.0, 0.0},
                     "<polygon><point><x>0</x><y>0</y></point><point><x>3</x><y>0</y></point>"
                     "<point><x>1</x><y>2</y></point></polygon>")
           .problem(7, kStart, {rectangle_at({88.0, 0.0, 0.0}, {12.0, 8.0})})
           .xml(),
       1});
}

void add_several(std::vector<CommonRoadSample>& samples) {
  samples.push_back({"following",
                     one_lane()
                         .problem(7, {22.0, 0.0, 0.0}, {across({70.0, 0.0, 0.0})})
                         .problem(8, {8.0, 0.0, 0.0}, {across({50.0, 0.0, 0.0})})
                         .xml(),
                     2});
  samples.push_back(
      {"crossing",
       crossing()
           .problem(7, {-30.0, 0.0, 0.0}, {across({28.0, 0.0, 0.0})})
           .problem(8, {0.0, -32.0, kQuarter_rad}, {across({0.0, 28.0, kQuarter_rad})})
           .xml(),
       2});
  samples.push_back({"merge",
                     merge()
                         .problem(7, {24.0, -10.2, 0.36}, {across({85.0, -7.265, 0.0})})
                         .problem(8, {10.0, -7.26, 0.0}, {across({66.0, -7.265, 0.0})})
                         .xml(),
                     2});
  samples.push_back(
      {"oncoming",
       CommonRoadSketch()
           .lane(1, straight({0.0, 0.0}, {80.0, 0.0}))
           .lane(2, straight({80.0, kWidth_m}, {0.0, kWidth_m}))
           .beside(2, 1, false)
           .problem(7, kStart, {across({65.0, 0.0, 0.0})})
           .problem(8, {70.0, kWidth_m, std::numbers::pi}, {across({15.0, kWidth_m, 0.0})})
           .xml(),
       2});
  samples.push_back({"three_on_two_lanes",
                     two_lanes()
                         .problem(7, {24.0, 0.0, 0.0}, {across({85.0, 0.0, 0.0})})
                         .problem(8, {8.0, 0.0, 0.0}, {across({65.0, 0.0, 0.0})})
                         .problem(9, {16.0, kWidth_m, 0.0}, {across({80.0, kWidth_m, 0.0})})
                         .xml(),
                     3});
}

}  // namespace

std::vector<CommonRoadSample> commonroad_samples() {
  std::vector<CommonRoadSample> samples;
  add_goals(samples);
  add_roads(samples);
  add_obstacles(samples);
  add_several(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {  // every file has a benchmarkID of its own
    std::string& xml = samples[i].xml;
    const std::string id = CommonRoadSketch::kBenchmarkId;
    xml.replace(xml.find(id), id.size(), "ZAM_Sketch-" + std::to_string(i + 1) + "_1_T-1");
  }
  return samples;
}

}  // namespace hlc::test
