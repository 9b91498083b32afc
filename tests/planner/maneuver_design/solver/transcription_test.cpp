#include "planner/maneuver_design/solver/transcription.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/friction_circle.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

ManeuverProblem problem_with_everything() {
  ManeuverProblem problem{{0.8, 0.1}, {0.6, -0.3}, 0.2, 8, {}, {}};
  problem.path_constraints = {std::make_shared<FrictionCircle>(6.0, problem.vehicle)};
  problem.cost_bounds = {{std::make_shared<Effort>(), 5.0}};
  return problem;
}

Eigen::VectorXd random_point(Eigen::Index size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(size, [&] { return unit(random); });
  return z;
}

/// Compares with central differences, to 1e-6 of the largest derivative.
void expect_jacobian(const Eigen::MatrixXd& exact, const Eigen::VectorXd& z,
                     const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& value) {
  constexpr double kStep = 1e-5;
  const double scale = exact.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(z.size(), i);
    const Eigen::VectorXd difference = (value(z + step) - value(z - step)) / (2.0 * kStep);
    EXPECT_LT((exact.col(i) - difference).lpNorm<Eigen::Infinity>(), 1e-6 * scale)
        << "column " << i;
  }
}

TEST(Transcription, AllDerivativesAreThoseOfCentralDifferences) {
  constexpr unsigned kSeed = 91;
  for (const bool free_duration : {false, true}) {
    ManeuverProblem problem = problem_with_everything();
    if (free_duration) {
      problem.free_duration = DurationRange{0.1, 0.4};
    }
    for (const std::string& name : criterion_names()) {
      SCOPED_TRACE(Message() << name << (free_duration ? ", free" : "") << ", seed " << kSeed);
      const auto cost = make_criterion(name, problem.vehicle);
      Transcription t(problem, *cost, 0.2, 1e-2);
      std::mt19937 random(kSeed);
      Eigen::VectorXd z = random_point(t.variables().size(), random);
      if (free_duration) {
        z(z.size() - 1) = 1.1;
      }
      t.scale_at(z);
      Eigen::VectorXd gradient;
      (void)t.objective(z, &gradient);
      expect_jacobian(gradient.transpose(), z, [&](const Eigen::VectorXd& at) {
        return Eigen::VectorXd::Constant(1, t.objective(at, nullptr));
      });
      expect_jacobian(t.end_conditions(z).jacobian, z,
                      [&](const Eigen::VectorXd& at) { return t.end_conditions(at).value; });
      const ConstraintSet all{true, true, true, true};
      expect_jacobian(t.inequalities(all, z).jacobian, z,
                      [&](const Eigen::VectorXd& at) { return t.inequalities(all, at).value; });
    }
  }
}

TEST(Transcription, SecondDerivativesAreThoseOfTheGradient) {
  const ManeuverProblem problem = problem_with_everything();
  for (const std::string name : {"J1", "J2", "comfort"}) {
    SCOPED_TRACE(name);
    const auto cost = make_criterion(name, problem.vehicle);
    Transcription t(problem, *cost, 0.2, 1e-2);
    std::mt19937 random(92);
    const Eigen::VectorXd z = random_point(t.variables().size(), random);
    t.scale_at(z);
    const std::vector<Eigen::Index> some{0, 1, 4, 7, 9, 10, 15};
    const auto slopes = [&](const Eigen::VectorXd& at) {
      Eigen::VectorXd gradient;
      (void)t.objective(at, &gradient);
      return Eigen::VectorXd(gradient(some));
    };
    const Eigen::MatrixXd hessian = t.hessian(z, some);
    constexpr double kStep = 1e-5;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(z.size(), some[i]);
      const Eigen::VectorXd difference = (slopes(z + step) - slopes(z - step)) / (2.0 * kStep);
      EXPECT_LT((hessian.col(static_cast<Eigen::Index>(i)) - difference).norm(),
                1e-6 * hessian.norm());
    }
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
