#pragma once

#include <Eigen/Core>

#include "planner/vehicle/single_track.hpp"

namespace hlc::maneuver_design {

/// Derivatives of a running cost at one state and input.
struct CostGradient {
  vehicle::StateVector state{vehicle::StateVector::Zero()};  ///< dl/dx
  Eigen::Vector2d input{Eigen::Vector2d::Zero()};            ///< dl/du, u = (u_v, u_delta)
};

/// Running cost l(x, u) of a criterion J = integral_0^T l(x, u) dt (paper, Section 3); J is
/// minimised.
///
/// A further criterion is one file that implements this, its test, and one line in criteria.cpp.
class RunningCost {
 public:
  virtual ~RunningCost() = default;
  [[nodiscard]] virtual double value(const vehicle::StateVector& x,
                                     const vehicle::Input& u) const = 0;
  [[nodiscard]] virtual CostGradient gradient(const vehicle::StateVector& x,
                                              const vehicle::Input& u) const = 0;
  /// True if l depends on the pose, so that a shift of the pose changes J. Otherwise l(x, 0) is
  /// constant along a trim: the trim's unit cost.
  [[nodiscard]] virtual bool depends_on_pose() const { return false; }
  /// True if J usually has several local optima of different value: the solver then tries several
  /// starts.
  [[nodiscard]] virtual bool has_many_optima() const { return false; }
};

}  // namespace hlc::maneuver_design
