#include "planner/maneuver_design/energy.hpp"

namespace hlc::maneuver_design {
namespace {

/// max(a, 0) without its kink, and its slope: between 0 and the band's end the cubic that joins
/// both straight parts with their slopes.
struct PositivePart {
  double value;
  double slope;
};

PositivePart positive_part(double a) {
  if (a <= 0.0) {
    return {0.0, 0.0};
  }
  const double s = a / kCoastingBand_mps2;
  if (s >= 1.0) {
    return {a, 1.0};
  }
  return {a * s * (2.0 - s), s * (4.0 - 3.0 * s)};
}

}  // namespace

double Energy::value(const vehicle::StateVector& x, const vehicle::Input& u) const {
  return positive_part(u.acceleration_mps2).value * x(3);
}

CostGradient Energy::gradient(const vehicle::StateVector& x, const vehicle::Input& u) const {
  const PositivePart part = positive_part(u.acceleration_mps2);
  CostGradient gradient;
  gradient.state(3) = part.value;
  gradient.input.x() = part.slope * x(3);
  return gradient;
}

}  // namespace hlc::maneuver_design
