#include "planner/maneuver_design/solver/active_set_qp.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planner/maneuver_design/solver/first_order.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return unit(random); });
}

QuadraticProblem random_problem(Eigen::Index size, bool convex, std::mt19937& random) {
  QuadraticProblem q;
  const Eigen::MatrixXd root = random_matrix(size, size, random);
  q.hessian =
      convex
          ? Eigen::MatrixXd(root.transpose() * root + 0.1 * Eigen::MatrixXd::Identity(size, size))
          : Eigen::MatrixXd(root.transpose() + root);
  q.gradient = random_matrix(size, 1, random);
  q.equalities = random_matrix(2, size, random);
  q.rows = random_matrix(3, size, random);
  q.room = random_matrix(3, 1, random).cwiseMax(0.0);
  q.lower = random_matrix(size, 1, random).cwiseMin(0.0);
  q.upper = random_matrix(size, 1, random).cwiseMax(0.0);
  return q;
}

double value(const QuadraticProblem& q, const Eigen::VectorXd& p) {
  return q.gradient.dot(p) + 0.5 * p.dot(q.hessian * p);
}

/// First-order residual at p, with every constraint that p touches.
double residual(const QuadraticProblem& q, const Eigen::VectorXd& p) {
  constexpr double kAt = 1e-9;
  std::vector<Eigen::VectorXd> active;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    if (p(i) > q.upper(i) - kAt) active.emplace_back(Eigen::VectorXd::Unit(p.size(), i));
    if (p(i) < q.lower(i) + kAt) active.emplace_back(-Eigen::VectorXd::Unit(p.size(), i));
  }
  for (Eigen::Index i = 0; i < q.rows.rows(); ++i) {
    if (q.rows.row(i).dot(p) > q.room(i) - kAt) active.emplace_back(q.rows.row(i).transpose());
  }
  Eigen::MatrixXd columns(p.size(), static_cast<Eigen::Index>(active.size()));
  for (std::size_t i = 0; i < active.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = active[i];
  }
  return first_order_residual(q.gradient + q.hessian * p, q.equalities.transpose(), columns);
}

void expect_feasible(const QuadraticProblem& q, const Eigen::VectorXd& p) {
  EXPECT_LT((q.equalities * p).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((q.rows * p - q.room).maxCoeff(), 1e-9);
  EXPECT_GT((p - q.lower).minCoeff(), -1e-12);
  EXPECT_GT((q.upper - p).minCoeff(), -1e-12);
}

TEST(ActiveSetQp, FindsAPointThatSatisfiesTheFirstOrderConditionsNeverWorseThanTheStart) {
  constexpr unsigned kSeed = 81;
  std::mt19937 random(kSeed);
  for (int run = 0; run < 400; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    const QuadraticProblem q = random_problem(3 + run % 8, run % 2 == 0, random);
    const Eigen::VectorXd p = local_minimum(q);
    expect_feasible(q, p);
    EXPECT_LE(value(q, p), 1e-12);
    EXPECT_LT(residual(q, p), 1e-7);
  }
}

TEST(ActiveSetQp, FindsTheOnlyMinimumOfAConvexProblem) {
  constexpr unsigned kSeed = 82;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 100; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    QuadraticProblem q = random_problem(3, true, random);
    q.equalities.resize(0, 3);
    const Eigen::VectorXd p = local_minimum(q);
    for (int other = 0; other < 200; ++other) {
      const Eigen::VectorXd r = Eigen::VectorXd::NullaryExpr(
          3, [&](Eigen::Index i) { return q.lower(i) + share(random) * (q.upper - q.lower)(i); });
      if ((q.rows * r - q.room).maxCoeff() <= 0.0) {
        EXPECT_LE(value(q, p), value(q, r) + 1e-12);
      }
    }
  }
}

TEST(ActiveSetQp, AConcaveProblemEndsInACorner) {
  QuadraticProblem q;
  q.hessian = -Eigen::MatrixXd::Identity(2, 2);
  q.gradient = Eigen::Vector2d(0.1, -0.2);
  q.equalities.resize(0, 2);
  q.rows.resize(0, 2);
  q.room.resize(0);
  q.lower = Eigen::Vector2d(-1.0, -1.0);
  q.upper = Eigen::Vector2d(1.0, 1.0);
  EXPECT_EQ(local_minimum(q), Eigen::Vector2d(-1.0, 1.0));
}

}  // namespace
}  // namespace hlc::maneuver_design
