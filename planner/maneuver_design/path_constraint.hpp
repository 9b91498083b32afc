#pragma once

#include <string>

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Constraint g(x, u) <= 0 along a maneuver (paper, Eq. 2), beyond the bounds on inputs and states.
///
/// g has no unit: it is scaled so that 1 is a violation as large as the bound. A further constraint
/// is one file that implements this, and its test.
class PathConstraint {
 public:
  virtual ~PathConstraint() = default;
  [[nodiscard]] virtual double value(const vehicle::StateVector& x,
                                     const vehicle::Input& u) const = 0;
  /// dg/dx and dg/du.
  [[nodiscard]] virtual CostGradient gradient(const vehicle::StateVector& x,
                                              const vehicle::Input& u) const = 0;
  /// Its name in messages, with the bound.
  [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace hlc::maneuver_design
