#include "planner/road/lab_like_map.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "planner/road/lane_lines.hpp"

namespace hlc::road {
namespace {

constexpr double kLeft_m = kLaneWidth_m;
constexpr double kRight_m = -kLaneWidth_m;

// Half of each circuit; the other half repeats (red) or mirrors (blue, green) it.
const Knots kRedHalf = {{0.0, -0.2104},    {0.3545, -1.6808}, {0.9615, -1.4246}, {1.9118, 1.4984},
                        {2.4429, 1.5051},  {2.9120, 0.1848},  {3.6359, -1.0991}, {4.0951, -1.8728},
                        {4.7648, -0.5395}, {5.1225, -1.5889}, {6.1131, -0.2104}};
const Knots kBlueHalf = {{0.0, 0.0094},     {1.0083, -0.0278}, {1.9052, -2.5555}, {2.4973, 0.9094},
                         {2.7242, -2.9061}, {3.3915, -0.3724}, {4.6130, 0.1006}};
const Knots kGreenHalf = {{0.0, 0.0527},     {0.7267, -0.2477}, {1.4885, -1.4447},
                          {1.7707, -1.5687}, {1.8874, -3.2604}, {2.2497, 1.7866},
                          {2.5680, -1.3784}, {2.9340, -2.4020}, {3.6201, -0.0019},
                          {4.0115, -0.0003}, {4.4409, 0.0002}};
const Pose kRedStart{.x_m = 1.35, .y_m = 3.739, .heading_rad = 0.045};
const Pose kBlueStart{.x_m = 2.25, .y_m = 1.775, .heading_rad = 0.0};
const Pose kGreenStart{.x_m = 4.245, .y_m = 2.0, .heading_rad = -std::numbers::pi / 2.0};

Knots reversed(const Knots& knots) {
  Knots result;
  for (auto knot = knots.rbegin(); knot != knots.rend(); ++knot) {
    result.push_back({knots.back().s_m - knot->s_m, knot->curvature_per_m});
  }
  return result;
}

/// @pre `second` begins with the curvature that `first` ends with
Knots joined(Knots first, const Knots& second) {
  const double end_s_m = first.back().s_m;
  for (std::size_t i = 1; i < second.size(); ++i) {
    first.push_back({end_s_m + second[i].s_m, second[i].curvature_per_m});
  }
  return first;
}

/// One and a half rounds of a circuit whose second half mirrors the first.
Knots mirrored_circuit(const Knots& half) { return joined(joined(half, reversed(half)), half); }

/// Adds the lane whose middle runs `left_m` to the left of `line`; ids count from 1.
LaneletId add_lane(LaneletMap& map, const Line& line, double left_m = 0.0) {
  const auto id = static_cast<LaneletId>(map.lanelets.size()) + 1;
  map.lanelets.emplace(id, lane_along(line, id, left_m));
  return id;
}

/// Red is cut where another circuit joins or leaves its lane or the lane beside it.
struct RedCircuit {
  std::array<Pose, 6> cut;
  std::array<Line, 10> line;
  std::array<LaneletId, 10> lane{};
};

RedCircuit add_red_circuit(LaneletMap& map) {
  RedCircuit circuit;
  const CurvatureCurve red(kRedStart, kRedHalf);
  const std::array<double, 6> s_m = {0.0, 1.469, 2.904, 4.630, 5.433, red.length_m()};
  auto& [cut, line, lane] = circuit;
  std::transform(s_m.begin(), s_m.end(), cut.begin(), [&](double at_m) { return red.at(at_m); });
  cut.back() = turned(cut.front());
  for (std::size_t i = 0; i < 5; ++i) {
    line[i] = stretch(red, s_m[i], s_m[i + 1], cut[i], cut[i + 1]);
    line[i + 5] = turned(line[i]);
  }
  std::transform(line.begin(), line.end(), lane.begin(),
                 [&](const Line& one) { return add_lane(map, one); });
  return circuit;
}

}  // namespace

RoadNetwork lab_like_map() {
  RoadNetwork network;
  LaneletMap& map = network.map;
  map.benchmark_id = "ZAM_LabLike-1_1_T-1";

  const auto [red_cut, red_line, red_lane] = add_red_circuit(map);
  const CurvatureCurve blue(kBlueStart, mirrored_circuit(kBlueHalf));
  const Line blue_merge = stretch(blue, 2.266, 3.032, shifted(red_cut[3], kRight_m), red_cut[4]);
  const Line blue_ring = stretch(blue, 3.713, 6.193, red_cut[5], blue.at(6.193));
  const Line blue_leave = stretch(blue, 6.193, 6.960, blue.at(6.193), blue.at(6.960));
  const Line blue_inner =
      stretch(blue, 6.960, 10.026, blue.at(6.960), shifted(red_cut[2], kRight_m));
  const LaneletId blue_beside_red = add_lane(map, red_line[2], kRight_m);
  network.routes.push_back({"red", {red_lane.begin(), red_lane.end()}});
  network.routes.push_back(
      {"blue",
       {blue_beside_red, add_lane(map, blue_merge), red_lane[4], add_lane(map, blue_ring),
        add_lane(map, blue_leave), add_lane(map, blue_inner)}});

  const CurvatureCurve green(kGreenStart, mirrored_circuit(kGreenHalf));
  const Line green_leave = stretch(green, 1.735, 2.415, red_cut[4], shifted(red_cut[5], kRight_m));
  const Line green_inner =
      stretch(green, 3.641, 6.467, shifted(turned(red_cut[1]), kRight_m), green.at(6.467));
  const Line green_merge = stretch(green, 6.467, 7.147, green.at(6.467), green.at(7.147));
  const Line green_ring = stretch(green, 7.147, 9.812, green.at(7.147), red_cut[3]);
  network.routes.push_back(
      {"green",
       {red_lane[3], add_lane(map, green_leave), add_lane(map, red_line[5], kRight_m),
        add_lane(map, green_inner), add_lane(map, green_merge), add_lane(map, green_ring)}});

  // Second lanes that no circuit uses.
  for (const std::size_t i : {0U, 1U, 6U, 7U}) {
    add_lane(map, red_line[i], kRight_m);
  }
  for (const std::size_t i : {3U, 4U, 8U, 9U}) {
    add_lane(map, red_line[i], kLeft_m);
  }
  for (const Line& line : {blue_ring, blue_inner, green_inner, green_ring}) {
    add_lane(map, line, kLeft_m);
  }
  // Where blue leaves and green joins the ring, the lane between that ring and the second lanes:
  // red's lane at the mirrored place.
  const Line beside_blue =
      bent(mirrored_x(red_line[3]), blue_leave.front(), shifted(blue_leave.back(), kLeft_m));
  const Line beside_green =
      bent(mirrored_y(red_line[4]), shifted(green_merge.front(), kLeft_m), green_merge.back());
  for (const Line& line : {beside_blue, beside_green}) {
    add_lane(map, line);
    add_lane(map, line, kLeft_m);
  }
  link(map);
  return network;
}

}  // namespace hlc::road
