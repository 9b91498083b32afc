#include "planner/maneuver_design/shooting.hpp"

#include <array>

#include "planner/common/demand.hpp"

namespace hlc::maneuver_design {
namespace {

/// One stage of a Runge-Kutta step: where it evaluates model and cost, and the values there.
struct Stage {
  vehicle::StateVector x;
  vehicle::StateVector derivative;
  double running_cost{};
};
using Stages = std::array<Stage, 4>;

constexpr std::array<double, 4> kWeights{1.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0};
/// Stage i starts from x + kLead[i] h k_{i-1}.
constexpr std::array<double, 4> kLead{0.0, 0.5, 0.5, 1.0};

struct Step {
  Stages stages;
  vehicle::StateVector end;
};

Step stepped(const vehicle::StateVector& x, const vehicle::Input& u, double h,
             const RunningCost& cost, const vehicle::VehicleParameters& vehicle) {
  Step step;
  step.end = x;
  vehicle::StateVector k = vehicle::StateVector::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    Stage& stage = step.stages[i];
    stage.x = x + kLead[i] * h * k;
    k = vehicle::derivative(stage.x, u, vehicle);
    stage.derivative = k;
    stage.running_cost = cost.value(stage.x, u);
    step.end += kWeights[i] * h * k;
  }
  return step;
}

/// One step backwards. In: lambda = dJ/d(end of the step). Out: lambda = dJ/d(start of the step),
/// and the step's share of dJ/du is returned; its share of dJ/dh is added to `dh`.
Eigen::Vector2d stepped_back(const Stages& stages, const vehicle::Input& u, double h,
                             const RunningCost& cost, const vehicle::VehicleParameters& vehicle,
                             vehicle::StateVector& lambda, double& dh) {
  const vehicle::InputJacobian B = vehicle::input_jacobian();
  const vehicle::StateVector end = lambda;
  Eigen::Vector2d du = Eigen::Vector2d::Zero();
  vehicle::StateVector dk = kWeights[3] * h * end;  // dJ/dk of the current stage
  for (std::size_t i = 4; i-- > 0;) {
    const Stage& stage = stages[i];
    const CostGradient l = cost.gradient(stage.x, u);
    const vehicle::StateVector dx = vehicle::state_jacobian(stage.x, vehicle).transpose() * dk +
                                    kWeights[i] * h * l.state;  // dJ/d(stage.x)
    du += B.transpose() * dk + kWeights[i] * h * l.input;
    lambda += dx;
    dh += kWeights[i] * (end.dot(stage.derivative) + stage.running_cost);
    if (i > 0) {
      dh += kLead[i] * dx.dot(stages[i - 1].derivative);
      dk = kWeights[i - 1] * h * end + kLead[i] * h * dx;
    }
  }
  return du;
}

}  // namespace

Shot shoot(const vehicle::State& start, const std::vector<vehicle::Input>& inputs,
           double duration_s, const RunningCost& cost, const vehicle::VehicleParameters& vehicle,
           WithGradient with_gradient) {
  HLC_DEMAND(!inputs.empty() && duration_s > 0.0, inputs.size(), duration_s);
  const double h = duration_s / static_cast<double>(inputs.size());
  Shot shot;
  shot.states.reserve(inputs.size() + 1);
  shot.states.push_back(start);
  std::vector<Stages> stages;
  stages.reserve(with_gradient == WithGradient::kYes ? inputs.size() : 0);
  vehicle::StateVector x = vehicle::to_vector(start);
  for (const vehicle::Input& u : inputs) {
    const Step step = stepped(x, u, h, cost, vehicle);
    for (std::size_t i = 0; i < 4; ++i) {
      shot.cost += kWeights[i] * h * step.stages[i].running_cost;
    }
    if (with_gradient == WithGradient::kYes) {
      stages.push_back(step.stages);
    }
    x = step.end;
    shot.states.push_back(vehicle::to_state(x));
  }
  if (with_gradient == WithGradient::kYes) {
    shot.gradient.resize(inputs.size());
    vehicle::StateVector lambda = vehicle::StateVector::Zero();
    double dh = 0.0;
    for (std::size_t i = inputs.size(); i-- > 0;) {
      shot.gradient[i] = stepped_back(stages[i], inputs[i], h, cost, vehicle, lambda, dh);
    }
    shot.duration_gradient = dh / static_cast<double>(inputs.size());
  }
  return shot;
}

}  // namespace hlc::maneuver_design
