#include "planner/maneuver_design/solver/sensitivities.hpp"

#include "planner/common/demand.hpp"

namespace hlc::maneuver_design {
namespace {

/// d(end of a step)/d(x, u_v, u_delta, h).
using StepJacobian = Eigen::Matrix<double, 5, 8>;

StepJacobian step_jacobian(const vehicle::StateVector& x, const vehicle::Input& u, double h,
                           const vehicle::VehicleParameters& vehicle) {
  constexpr double kLead[]{0.0, 0.5, 0.5, 1.0};
  constexpr double kWeights[]{1.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0};
  StepJacobian start = StepJacobian::Zero();
  start.leftCols<5>().setIdentity();
  StepJacobian by_input = StepJacobian::Zero();
  by_input.middleCols<2>(5) = vehicle::input_jacobian();

  StepJacobian end = start;
  vehicle::StateVector k = vehicle::StateVector::Zero();
  StepJacobian dk = StepJacobian::Zero();
  for (int i = 0; i < 4; ++i) {
    const vehicle::StateVector stage = x + kLead[i] * h * k;
    StepJacobian dstage = start + kLead[i] * h * dk;
    dstage.col(7) += kLead[i] * k;
    k = vehicle::derivative(stage, u, vehicle);
    dk = vehicle::state_jacobian(stage, vehicle) * dstage + by_input;
    end += kWeights[i] * h * dk;
    end.col(7) += kWeights[i] * k;
  }
  return end;
}

}  // namespace

std::vector<Eigen::Matrix<double, 5, Eigen::Dynamic>> sensitivities(
    const std::vector<vehicle::State>& states, const std::vector<vehicle::Input>& inputs,
    double duration_s, const vehicle::VehicleParameters& vehicle) {
  HLC_DEMAND(states.size() == inputs.size() + 1, states.size(), inputs.size());
  const auto intervals = static_cast<Eigen::Index>(inputs.size());
  const double share = 1.0 / static_cast<double>(intervals);
  using Matrix = Eigen::Matrix<double, 5, Eigen::Dynamic>;
  std::vector<Matrix> result{Matrix::Zero(5, 2 * intervals + 1)};
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const StepJacobian step =
        step_jacobian(vehicle::to_vector(states[k]), inputs[k], share * duration_s, vehicle);
    Matrix next = step.leftCols<5>() * result.back();
    next.middleCols<2>(2 * static_cast<Eigen::Index>(k)) += step.middleCols<2>(5);
    next.rightCols<1>() += share * step.col(7);
    result.push_back(std::move(next));
  }
  return result;
}

}  // namespace hlc::maneuver_design
