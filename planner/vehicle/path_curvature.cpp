#include "planner/vehicle/path_curvature.hpp"

#include <cmath>

namespace hlc::vehicle {

// With t = tan(delta), t' = 1 + t^2, t'' = 2 t t', q = l_r / L and d = 1 + q^2 t^2:
//
//     beta' = q t' / d        beta'' = q t'' / d - 2 q^3 t t'^2 / d^2
CourseRate course_rate(const StateVector& x, const Input& u, const VehicleParameters& vehicle) {
  const double v = x(3);
  const StateJacobian jacobian = state_jacobian(x, vehicle);
  const double kappa = jacobian(2, 3);
  const double q = vehicle.rear_axle_to_cg_m / vehicle.wheelbase_m;
  const double t = std::tan(x(4));
  const double t_slope = 1.0 + t * t;
  const double d = 1.0 + q * q * t * t;
  const double beta_slope = q * t_slope / d;
  const double beta_bend =
      2.0 * q * t * t_slope / d - 2.0 * q * q * q * t * t_slope * t_slope / (d * d);
  return {.value_radps = v * kappa + beta_slope * u.steering_rate_radps,
          .by_speed = kappa,
          .by_steering = jacobian(2, 4) + beta_bend * u.steering_rate_radps,
          .by_steering_rate = beta_slope};
}

TurningSpeed turning_speed(double speed_mps) {
  const double value_mps = std::hypot(speed_mps, kCreepSpeed_mps);
  return {value_mps, speed_mps / value_mps};
}

bool is_within_curvature(const State& state, const Input& input, const VehicleParameters& vehicle,
                         const VehicleLimits& limits) {
  if (!limits.curvature_max_per_m) return true;
  const double rate_radps = course_rate(to_vector(state), input, vehicle).value_radps;
  return std::abs(rate_radps) <=
         *limits.curvature_max_per_m * turning_speed(state.speed_mps).value_mps * (1.0 + 1e-6);
}

}  // namespace hlc::vehicle
