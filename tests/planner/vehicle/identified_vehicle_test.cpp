#include "planner/vehicle/identified_vehicle.hpp"

#include <gtest/gtest.h>

#include "planner/vehicle/single_track.hpp"

namespace hlc::vehicle {
namespace {

/// Curvature of the path of the identified model in steady state: yaw rate over path speed.
double driven_curvature_per_m(double delta, const IdentifiedVehicle& v) {
  return v.yaw_rate_gain_per_m * delta /
         (v.path_speed_gain * (1.0 + v.path_speed_steering * delta * delta));
}

TEST(IdentifiedVehicle, SteadySteeringDrivesTheCurvature) {
  const IdentifiedVehicle vehicle;
  for (double curvature = -6.0; curvature <= 6.0; curvature += 0.01) {
    EXPECT_NEAR(driven_curvature_per_m(steady_steering(curvature, vehicle), vehicle), curvature,
                1e-13);
  }
  EXPECT_EQ(steady_steering(0.0, vehicle), 0.0);
}

TEST(IdentifiedVehicle, SteadySteeringIsTheSolutionNearestToZero) {
  const IdentifiedVehicle vehicle;
  double last = steady_steering(-20.0, vehicle);
  for (double curvature = -20.0; curvature <= 20.0; curvature += 0.1) {
    const double steering = steady_steering(curvature, vehicle);
    EXPECT_GE(steering, last);  // one branch, through 0
    last = steering;
  }
}

TEST(IdentifiedVehicle, HasTheLabsCurvatureLimits) {
  const IdentifiedVehicle vehicle;
  EXPECT_NEAR(driven_curvature_per_m(1.0 + vehicle.steering_offset, vehicle), 4.316, 1e-3);
  EXPECT_NEAR(driven_curvature_per_m(-1.0 + vehicle.steering_offset, vehicle), -3.960, 1e-3);
}

TEST(IdentifiedVehicle, SlipsLessThanTheSingleTrackModelAtFullSteering) {
  const double curvature = curvature_per_m(0.60, VehicleParameters{});
  EXPECT_NEAR(slip_angle_rad(0.60, VehicleParameters{}), 0.330, 5e-4);
  EXPECT_NEAR(steady_slip_rad(curvature, IdentifiedVehicle{}), 0.189, 5e-4);
}

TEST(IdentifiedVehicle, SlipStaysWhereThePathIsTooSharp) {
  const IdentifiedVehicle vehicle;
  const double right_limit = driven_curvature_per_m(-1.0 + vehicle.steering_offset, vehicle);
  const double slip = steady_slip_rad(right_limit, vehicle);
  EXPECT_NEAR(steady_slip_rad(right_limit - 0.5, vehicle), slip, 1e-12);
  EXPECT_GT(steady_slip_rad(right_limit + 0.5, vehicle), slip + 0.01);
}

}  // namespace
}  // namespace hlc::vehicle
