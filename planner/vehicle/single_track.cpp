#include "planner/vehicle/single_track.hpp"

#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::vehicle {
namespace {

/// sin(x) / x.
double sinc(double x) {
  // The series is exact in double precision below this bound: the next term is x^4 / 120 < 1e-18.
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

}  // namespace

StateVector to_vector(const State& state) {
  StateVector x;
  x << state.pose.x_m, state.pose.y_m, state.pose.heading_rad, state.speed_mps, state.steering_rad;
  return x;
}

State to_state(const StateVector& vector) {
  return {{vector(0), vector(1), vector(2)}, vector(3), vector(4)};
}

double slip_angle_rad(double steering_rad, const VehicleParameters& vehicle) {
  return std::atan(vehicle.rear_axle_to_cg_m / vehicle.wheelbase_m * std::tan(steering_rad));
}

double curvature_per_m(double steering_rad, const VehicleParameters& vehicle) {
  return std::tan(steering_rad) * std::cos(slip_angle_rad(steering_rad, vehicle)) /
         vehicle.wheelbase_m;
}

double steering_for_curvature_rad(double curvature_per_m, const VehicleParameters& vehicle) {
  const double slip_sine = curvature_per_m * vehicle.rear_axle_to_cg_m;
  HLC_DEMAND(std::abs(slip_sine) < 1.0, slip_sine);
  return std::atan(curvature_per_m * vehicle.wheelbase_m / std::sqrt(1.0 - slip_sine * slip_sine));
}

TimedPoint timed_point(double time_s, const State& state, const VehicleParameters& vehicle) {
  const double course = state.pose.heading_rad + slip_angle_rad(state.steering_rad, vehicle);
  return {.time_s = time_s,
          .position_m = state.pose.position_m(),
          .velocity_mps = state.speed_mps * Eigen::Vector2d(std::cos(course), std::sin(course))};
}

StateVector derivative(const StateVector& x, const Input& u, const VehicleParameters& vehicle) {
  const double psi = x(2);
  const double v = x(3);
  const double delta = x(4);
  const double beta = slip_angle_rad(delta, vehicle);
  StateVector f;
  f << v * std::cos(psi + beta),                                   //
      v * std::sin(psi + beta),                                    //
      v / vehicle.wheelbase_m * std::tan(delta) * std::cos(beta),  //
      u.acceleration_mps2,                                         //
      u.steering_rate_radps;
  return f;
}

// With t = tan(delta), t' = 1 + t^2 and q = l_r / L:
//
//     beta = atan(q t)                 beta' = q t' / (1 + q^2 t^2)
//     kappa = t cos(beta) / L          kappa' = (t' cos(beta) - t sin(beta) beta') / L
//
//     df/dx = | 0 0 -v sin(psi+beta)  cos(psi+beta)  -v sin(psi+beta) beta' |
//             | 0 0  v cos(psi+beta)  sin(psi+beta)   v cos(psi+beta) beta' |
//             | 0 0  0                kappa           v kappa'              |
//             | 0 0  0                0               0                     |
//             | 0 0  0                0               0                     |
StateJacobian state_jacobian(const StateVector& x, const VehicleParameters& vehicle) {
  const double v = x(3);
  const double q = vehicle.rear_axle_to_cg_m / vehicle.wheelbase_m;
  const double t = std::tan(x(4));
  const double t_slope = 1.0 + t * t;
  const double beta = std::atan(q * t);
  const double beta_slope = q * t_slope / (1.0 + q * q * t * t);
  const double kappa_slope =
      (t_slope * std::cos(beta) - t * std::sin(beta) * beta_slope) / vehicle.wheelbase_m;
  const double c = std::cos(x(2) + beta);
  const double s = std::sin(x(2) + beta);

  StateJacobian jacobian = StateJacobian::Zero();
  jacobian(0, 2) = -v * s;
  jacobian(0, 3) = c;
  jacobian(0, 4) = -v * s * beta_slope;
  jacobian(1, 2) = v * c;
  jacobian(1, 3) = s;
  jacobian(1, 4) = v * c * beta_slope;
  jacobian(2, 3) = t * std::cos(beta) / vehicle.wheelbase_m;
  jacobian(2, 4) = v * kappa_slope;
  return jacobian;
}

InputJacobian input_jacobian() {
  InputJacobian jacobian = InputJacobian::Zero();
  jacobian(3, 0) = 1.0;
  jacobian(4, 1) = 1.0;
  return jacobian;
}

State integrated(const State& start, const Input& input, double duration_s,
                 const VehicleParameters& vehicle) {
  const double h = duration_s;
  const StateVector x = to_vector(start);
  const StateVector k1 = derivative(x, input, vehicle);
  const StateVector k2 = derivative(x + 0.5 * h * k1, input, vehicle);
  const StateVector k3 = derivative(x + 0.5 * h * k2, input, vehicle);
  const StateVector k4 = derivative(x + h * k3, input, vehicle);
  return to_state(x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
}

Pose trim_motion(const Pose& start, double speed_mps, double steering_rad, double duration_s,
                 const VehicleParameters& vehicle) {
  const double arc_m = speed_mps * duration_s;
  const double turn_rad = arc_m * curvature_per_m(steering_rad, vehicle);
  // The chord of the arc points along the mean course and is shorter than the arc by sinc(turn /
  // 2).
  const double chord_m = arc_m * sinc(0.5 * turn_rad);
  const double direction_rad =
      start.heading_rad + slip_angle_rad(steering_rad, vehicle) + 0.5 * turn_rad;
  return {start.x_m + chord_m * std::cos(direction_rad),
          start.y_m + chord_m * std::sin(direction_rad), start.heading_rad + turn_rad};
}

}  // namespace hlc::vehicle
