#include "planner/automaton/swept_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::automaton {
namespace {

constexpr int kTimes = 1000;

struct Vehicle {
  vehicle::VehicleParameters parameters;
  vehicle::IdentifiedVehicle identified;
};

/// Corners of the footprint during the motion: what the areas promise to contain.
struct Corners {
  std::vector<Point> lane_m;   ///< planned heading, no margin
  std::vector<Point> swept_m;  ///< planned heading and driven yaw, with margin
};

Corners corners_at(const Maneuver& maneuver, const Vehicle& vehicle, double time_s) {
  const vehicle::VehicleParameters& p = vehicle.parameters;
  const vehicle::State state = state_at(maneuver, time_s, p);
  Pose driven = state.pose;
  driven.heading_rad += yaw_minus_heading_rad(state.steering_rad, p, vehicle.identified);
  Corners corners;
  const auto add = [&p](std::vector<Point>& all_m, const Pose& pose, double margin_m) {
    const ConvexPolygon area = footprint_area(p.footprint, pose, margin_m);
    all_m.insert(all_m.end(), area.vertices_m.begin(), area.vertices_m.end());
  };
  add(corners.lane_m, state.pose, 0.0);
  add(corners.swept_m, state.pose, p.safety_margin_m);
  add(corners.swept_m, driven, p.safety_margin_m);
  return corners;
}

/// At seeded random times, and at both ends.
Corners corners_at_random_times(const Maneuver& maneuver, const Vehicle& vehicle,
                                std::mt19937& random) {
  std::uniform_real_distribution<double> time_s(0.0, maneuver.duration_s);
  Corners all;
  for (int i = 0; i < kTimes; ++i) {
    const double t = i == 0 ? 0.0 : i == 1 ? maneuver.duration_s : time_s(random);
    const Corners now = corners_at(maneuver, vehicle, t);
    all.lane_m.insert(all.lane_m.end(), now.lane_m.begin(), now.lane_m.end());
    all.swept_m.insert(all.swept_m.end(), now.swept_m.begin(), now.swept_m.end());
  }
  return all;
}

bool contains_all(const ConvexPolygon& area, const std::vector<Point>& points_m) {
  return std::all_of(points_m.begin(), points_m.end(),
                     [&area](const Point& point) { return contains(area, point); });
}

/// One percent smaller about its middle.
ConvexPolygon shrunk(ConvexPolygon area) {
  Point middle = Point::Zero();
  for (const Point& vertex : area.vertices_m) {
    middle += vertex / static_cast<double>(area.vertices_m.size());
  }
  for (Point& vertex : area.vertices_m) {
    vertex = middle + 0.99 * (vertex - middle);
  }
  return area;
}

double area_m2(const ConvexPolygon& polygon) {
  const auto& v = polygon.vertices_m;
  double twice = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Point& a = v[i];
    const Point& b = v[(i + 1) % v.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

Vehicle paper_vehicle() { return {paper_automaton()->vehicle, paper_automaton()->identified}; }

/// Motions far rougher than any of the paper's: inputs jump between their bounds.
Maneuver random_motion(const Vehicle& vehicle, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Maneuver maneuver;
  maneuver.from = TrimId{0};
  maneuver.to = TrimId{1};
  maneuver.duration_s = 0.2;
  vehicle::State state{{}, 1.0 + unit(random), 0.5 * unit(random)};
  maneuver.states.push_back(state);
  constexpr int kIntervals = 20;
  for (int i = 0; i < kIntervals; ++i) {
    vehicle::Input input{12.0 * unit(random), 6.2 * unit(random)};
    if (state.speed_mps + 0.01 * input.acceleration_mps2 < 0.0) {
      input.acceleration_mps2 = 12.0;
    }
    if (std::abs(state.steering_rad + 0.01 * input.steering_rate_radps) > 0.62) {
      input.steering_rate_radps = state.steering_rad > 0.0 ? -6.2 : 6.2;
    }
    maneuver.inputs.push_back(input);
    state = vehicle::integrated(state, input, maneuver.duration_s / kIntervals, vehicle.parameters);
    maneuver.states.push_back(state);
  }
  return maneuver;
}

TEST(SweptArea, HoldsAllCornersAtRandomTimesAndOnePercentLessDoesNot) {
  constexpr unsigned kSeed = 31;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const Vehicle vehicle = paper_vehicle();
  for (const Maneuver& maneuver : paper_automaton()->maneuvers) {
    SCOPED_TRACE(testing::Message()
                 << "maneuver " << maneuver.from.index + 1 << " -> " << maneuver.to.index + 1);
    const Corners corners = corners_at_random_times(maneuver, vehicle, random);
    EXPECT_TRUE(contains_all(maneuver.swept_area_m, corners.swept_m));
    EXPECT_TRUE(contains_all(maneuver.lane_area_m, corners.lane_m));
    EXPECT_FALSE(contains_all(shrunk(maneuver.swept_area_m), corners.swept_m));
    EXPECT_FALSE(contains_all(shrunk(maneuver.lane_area_m), corners.lane_m));
  }
}

TEST(SweptArea, OfAFootprintOnePercentSmallerDoesNotHoldTheFootprint) {
  constexpr unsigned kSeed = 32;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const Vehicle vehicle = paper_vehicle();
  vehicle::VehicleParameters smaller = vehicle.parameters;
  smaller.footprint.length_m *= 0.99;
  smaller.footprint.width_m *= 0.99;
  for (const Maneuver& maneuver : paper_automaton()->maneuvers) {
    const Corners corners = corners_at_random_times(maneuver, vehicle, random);
    const SweptAreas areas = swept_areas(maneuver, smaller, vehicle.identified);
    EXPECT_FALSE(contains_all(areas.swept_area_m, corners.swept_m));
    EXPECT_FALSE(contains_all(areas.lane_area_m, corners.lane_m));
  }
}

TEST(SweptArea, HoldsAllCornersOfRoughMotionsOfOtherVehiclesToo) {
  constexpr unsigned kSeed = 33;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  Vehicle longer = paper_vehicle();
  longer.parameters.wheelbase_m = 0.2;
  longer.parameters.rear_axle_to_cg_m = 0.1;
  Vehicle rear = paper_vehicle();
  rear.parameters.rear_axle_to_cg_m = 0.0;
  Vehicle front = paper_vehicle();
  front.parameters.rear_axle_to_cg_m = front.parameters.wheelbase_m;
  Vehicle slipping = paper_vehicle();
  slipping.identified.slip_gain_rad = -0.8;
  slipping.identified.path_speed_steering = -0.5;
  const std::array<Vehicle, 5> vehicles{paper_vehicle(), longer, rear, front, slipping};
  for (int run = 0; run < 40; ++run) {
    const Vehicle& vehicle = vehicles[static_cast<std::size_t>(run) % vehicles.size()];
    const Maneuver maneuver = random_motion(vehicle, random);
    const SweptAreas areas = swept_areas(maneuver, vehicle.parameters, vehicle.identified);
    const Corners corners = corners_at_random_times(maneuver, vehicle, random);
    EXPECT_TRUE(contains_all(areas.swept_area_m, corners.swept_m)) << "run " << run;
    EXPECT_TRUE(contains_all(areas.lane_area_m, corners.lane_m)) << "run " << run;
  }
}

TEST(SweptArea, HoldsTheCornersWhereSteeringSaturatesWithinAnInterval) {
  constexpr unsigned kSeed = 34;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  Vehicle vehicle = paper_vehicle();
  vehicle.identified.slip_gain_rad = -0.8;  // turns far beyond the planned heading
  Vehicle weak = vehicle;                   // saturates on both sides
  weak.identified.yaw_rate_gain_per_m = 1.0;
  struct Case {
    Vehicle vehicle;
    double from_rad, to_rad;
  };
  for (const Case& c : {Case{vehicle, -0.5, -0.62}, Case{vehicle, -0.62, -0.5},
                        Case{weak, -0.62, 0.62}, Case{weak, 0.62, -0.62}}) {
    // Standing, so that nothing but the steering moves, in a single interval.
    const double rate_radps = (c.to_rad - c.from_rad) / 0.2;
    const Maneuver maneuver{
        TrimId{0},
        TrimId{1},
        "",
        0.2,
        {vehicle::Input{0.0, rate_radps}},
        {vehicle::State{{}, 0.0, c.from_rad}, vehicle::State{{}, 0.0, c.to_rad}},
        {},
        {},
        {}};
    const SweptAreas areas = swept_areas(maneuver, c.vehicle.parameters, c.vehicle.identified);
    const Corners corners = corners_at_random_times(maneuver, c.vehicle, random);
    EXPECT_TRUE(contains_all(areas.swept_area_m, corners.swept_m)) << c.from_rad;
  }
}

TEST(SweptArea, HasAtMostEightVerticesAndLittleMoreThanTheHullOfTheCorners) {
  const Vehicle vehicle = paper_vehicle();
  for (const Maneuver& maneuver : paper_automaton()->maneuvers) {
    SCOPED_TRACE(testing::Message()
                 << "maneuver " << maneuver.from.index + 1 << " -> " << maneuver.to.index + 1);
    std::vector<Point> lane_m;
    std::vector<Point> swept_m;
    for (int i = 0; i <= kTimes; ++i) {
      const Corners now = corners_at(maneuver, vehicle, maneuver.duration_s * i / kTimes);
      lane_m.insert(lane_m.end(), now.lane_m.begin(), now.lane_m.end());
      swept_m.insert(swept_m.end(), now.swept_m.begin(), now.swept_m.end());
    }
    EXPECT_LE(maneuver.swept_area_m.vertices_m.size(), 8U);
    EXPECT_LE(maneuver.lane_area_m.vertices_m.size(), 8U);
    EXPECT_LT(area_m2(maneuver.swept_area_m), 1.006 * area_m2(convex_hull(swept_m)));
    EXPECT_LT(area_m2(maneuver.lane_area_m), 1.002 * area_m2(convex_hull(lane_m)));
  }
}

TEST(SweptArea, OfStandingIsTheFootprint) {
  const auto automaton = paper_automaton();
  const Maneuver* standing = automaton->find(pi(1), pi(1), "J2");
  ASSERT_NE(standing, nullptr);
  const double footprint_m2 = 0.220 * 0.107;
  EXPECT_GT(area_m2(standing->lane_area_m), footprint_m2);
  EXPECT_LT(area_m2(standing->lane_area_m), 1.001 * footprint_m2);
}

}  // namespace
}  // namespace hlc::automaton
