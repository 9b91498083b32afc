#include "planner/maneuver_design/solver/first_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <random>

namespace hlc::maneuver_design {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(FirstOrder, WithoutConstraintsAnySlopeIsUnexplained) {
  EXPECT_EQ(first_order_residual(VectorXd::Zero(3), MatrixXd(3, 0), MatrixXd(3, 0)), 0.0);
  EXPECT_NEAR(first_order_residual(VectorXd::Ones(3), MatrixXd(3, 0), MatrixXd(3, 0)), 1.0, 1e-15);
}

TEST(FirstOrder, AnEqualityExplainsBothSignsAnInequalityOnlyOne) {
  const VectorXd slope = 2.0 * VectorXd::Unit(2, 0);
  const MatrixXd along = VectorXd::Unit(2, 0);
  const MatrixXd none(2, 0);
  EXPECT_NEAR(first_order_residual(slope, along, none), 0.0, 1e-15);
  EXPECT_NEAR(first_order_residual(slope, -along, none), 0.0, 1e-15);
  EXPECT_NEAR(first_order_residual(slope, none, -along), 0.0, 1e-15);
  EXPECT_NEAR(first_order_residual(slope, none, along), 1.0, 1e-15);
}

TEST(FirstOrder, SlopesMadeOfMultipliersAreExplainedAndOthersByWhatIsLeft) {
  constexpr unsigned kSeed = 71;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int run = 0; run < 100; ++run) {
    // Row 0 belongs to no constraint: a slope along it stays.
    MatrixXd equalities = MatrixXd::NullaryExpr(12, 2, [&] { return normal(random); });
    MatrixXd active = MatrixXd::NullaryExpr(12, 15, [&] { return normal(random); });
    equalities.row(0).setZero();
    active.row(0).setZero();
    const VectorXd lambda = VectorXd::NullaryExpr(2, [&] { return normal(random); });
    const VectorXd mu =
        VectorXd::NullaryExpr(15, [&] { return std::max(0.0, unit(random) - 0.5); });
    VectorXd slope = -equalities * lambda - active * mu;
    EXPECT_LT(first_order_residual(slope, equalities, active), 1e-10);
    const double rest = 0.3 * slope.norm();
    slope(0) = rest;
    EXPECT_NEAR(first_order_residual(slope, equalities, active), rest / slope.norm(), 1e-9);
  }
}

TEST(FirstOrder, EqualsTheBestOfAllChoicesOfActiveConstraints) {
  constexpr unsigned kSeed = 73;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 300; ++run) {
    const MatrixXd active = MatrixXd::NullaryExpr(5, 4, [&] { return normal(random); });
    const VectorXd slope = VectorXd::NullaryExpr(5, [&] { return normal(random); });
    double best = slope.norm();
    for (unsigned choice = 1; choice < 16; ++choice) {
      MatrixXd chosen(5, 0);
      for (Eigen::Index i = 0; i < 4; ++i) {
        if ((choice >> i & 1U) != 0U) {
          chosen.conservativeResize(5, chosen.cols() + 1);
          chosen.rightCols<1>() = active.col(i);
        }
      }
      const VectorXd multipliers = chosen.colPivHouseholderQr().solve(-slope);
      if (multipliers.minCoeff() >= 0.0) {
        best = std::min(best, (slope + chosen * multipliers).norm());
      }
    }
    EXPECT_NEAR(first_order_residual(slope, MatrixXd(5, 0), active), best / slope.norm(), 1e-10);
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
