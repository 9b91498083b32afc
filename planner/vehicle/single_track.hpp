#pragma once

#include <Eigen/Core>
#include <optional>

#include "planner/geometry/footprint.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/geometry/timed_curve.hpp"

namespace hlc::vehicle {

/// State of the kinematic single-track model (paper, Eq. 1): x = (s_x, s_y, psi, v, delta).
struct State {
  Pose pose;              ///< s_x, s_y [m], psi [rad] of the centre of gravity
  double speed_mps{};     ///< v
  double steering_rad{};  ///< delta, positive to the left

  friend bool operator==(const State&, const State&) = default;
};

/// Input of the model: u = (u_v, u_delta).
struct Input {
  double acceleration_mps2{};    ///< u_v
  double steering_rate_radps{};  ///< u_delta

  friend bool operator==(const Input&, const Input&) = default;
};

/// Geometry of the vehicle. Defaults: the µCar (1:18).
struct VehicleParameters {
  double wheelbase_m{0.150};        ///< L
  double rear_axle_to_cg_m{0.075};  ///< l_r
  Footprint footprint{0.220, 0.107};
  /// Added to the footprint on every side, vehicle to vehicle: the bound on the deviation of a
  /// vehicle from its plan (planner/automaton/deviation.hpp).
  double safety_margin_m{0.010};
};

/// Bounds on inputs and states; |u_v|, |u_delta| and |delta| are symmetric, 0 <= v.
struct VehicleLimits {
  double acceleration_mps2{12.0};
  double steering_rate_radps{6.2};
  double speed_min_mps{0.0};
  double speed_max_mps{3.7};
  double steering_max_rad{0.62};
  /// Friction circle: u_v^2 + a_lat^2 <= friction^2 (lateral_acceleration.hpp); absent: none.
  std::optional<double> friction_mps2{};
  /// Largest curvature of the driven path, to either side (path_curvature.hpp); absent: limited by
  /// the steering only.
  std::optional<double> curvature_max_per_m{};
};

using StateVector = Eigen::Matrix<double, 5, 1>;
using StateJacobian = Eigen::Matrix<double, 5, 5>;
using InputJacobian = Eigen::Matrix<double, 5, 2>;

[[nodiscard]] StateVector to_vector(const State& state);
[[nodiscard]] State to_state(const StateVector& vector);

/// beta = atan(l_r / L tan(delta)) [rad]: angle from the heading to the course.
[[nodiscard]] double slip_angle_rad(double steering_rad, const VehicleParameters& vehicle);

/// Curvature of the path of the centre of gravity, tan(delta) cos(beta) / L [1/m].
[[nodiscard]] double curvature_per_m(double steering_rad, const VehicleParameters& vehicle);

/// The steering with that curvature [rad]. @pre |curvature| l_r < 1
[[nodiscard]] double steering_for_curvature_rad(double curvature_per_m,
                                                const VehicleParameters& vehicle);

/// A state as a point to follow: v in the direction of the course, heading + beta.
[[nodiscard]] TimedPoint timed_point(double time_s, const State& state,
                                     const VehicleParameters& vehicle);

/// f(x, u) of the paper, Eq. 1.
[[nodiscard]] StateVector derivative(const StateVector& x, const Input& u,
                                     const VehicleParameters& vehicle);
/// df/dx and df/du at (x, u).
[[nodiscard]] StateJacobian state_jacobian(const StateVector& x, const VehicleParameters& vehicle);
[[nodiscard]] InputJacobian input_jacobian();

/// One step of the classical Runge-Kutta method of order 4 over `duration_s` with constant input.
[[nodiscard]] State integrated(const State& start, const Input& input, double duration_s,
                               const VehicleParameters& vehicle);

/// Closed form of a trim's motion (u = 0): a straight line or a circular arc from `start`.
[[nodiscard]] Pose trim_motion(const Pose& start, double speed_mps, double steering_rad,
                               double duration_s, const VehicleParameters& vehicle);

}  // namespace hlc::vehicle
