#include "planner/maneuver_design/comfort.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/vehicle/lateral_acceleration.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(Comfort, OfATrimIsTheSquareOfSpeedTimesYawRate) {
  const vehicle::VehicleParameters vehicle;
  const vehicle::State state{{1.0, 2.0, 3.0}, 1.2, 0.4};
  const double yaw_rate = (vehicle::trim_motion({}, 1.2, 0.4, 0.1, vehicle).heading_rad) / 0.1;
  EXPECT_NEAR(vehicle::lateral_acceleration(vehicle::to_vector(state), vehicle).value_mps2,
              1.2 * yaw_rate, 1e-12);
  EXPECT_NEAR(Comfort(vehicle).value(vehicle::to_vector(state), {}), std::pow(1.2 * yaw_rate, 2),
              1e-11);
}

TEST(Comfort, StraightAheadIsTheWeightedSquareOfTheInput) {
  const Comfort comfort({}, {.longitudinal = 2.0, .lateral = 5.0, .steering_rate = 0.5});
  EXPECT_EQ(comfort.value(vehicle::to_vector({{}, 1.0, 0.0}), {3.0, -4.0}), 2.0 * 9.0 + 0.5 * 16.0);
}

TEST(Comfort, DependsOnTheVehicle) {
  vehicle::VehicleParameters passenger_car;
  passenger_car.wheelbase_m = 2.6;
  passenger_car.rear_axle_to_cg_m = 1.4;
  const vehicle::StateVector x = vehicle::to_vector({{}, 1.0, 0.3});
  EXPECT_LT(Comfort(passenger_car).value(x, {}),
            0.01 * Comfort(vehicle::VehicleParameters{}).value(x, {}));
}

TEST(Comfort, HasAnExactGradient) {
  expect_exact_gradient(Comfort(vehicle::VehicleParameters{}), 106);
  expect_exact_gradient(Comfort({}, {.longitudinal = 0.3, .lateral = 0.7, .steering_rate = 2.0}),
                        107);
}

}  // namespace
}  // namespace hlc::maneuver_design
