// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/term_evaluation.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/solver/ceres_adapters.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Jacobian = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

// r = (x y - 1, x^2 + z), whose Jacobian depends on the linearization point. Defined for x > 0.
class Bilinear final : public SizedFactor<2, 3> {
 public:
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double x = parameters[0][0], y = parameters[0][1], z = parameters[0][2];
    if (x <= 0) return false;
    residuals[0] = x * y - 1;
    residuals[1] = x * x + z;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Jacobian>{jacobians[0]} << y, x, 0, 2 * x, 0, 1;
    }
    return true;
  }
};

Jacobian BilinearJacobian(const Eigen::Vector3d& x) {
  Jacobian result;
  result << x[1], x[0], 0, 2 * x[0], 0, 1;
  return result;
}

class TermEvaluationTest : public ::testing::Test {
 protected:
  void MakeTerm(const ceres::LossFunction* loss, bool constant = false,
                const double* linearization = nullptr) {
    variables_ = {{{BlockKind::kPoint, 1}, values_.data(), constant, linearization}};
    term_.cost = &factor_;
    term_.loss = loss;
    term_.variables[0] = 0;
    term_.variable_count = 1;
  }

  Vector2d Residual() const { return Vector2d(evaluation_.residual.data()); }
  Jacobian FirstJacobian() const {
    return Eigen::Map<const Jacobian>(evaluation_.jacobians[0].data());
  }

  Eigen::Vector3d values_{1.5, -2.0, 0.7};
  std::vector<Variable> variables_;
  const Bilinear factor_{};
  ResidualTerm term_;
  TermEvaluation evaluation_;
};

TEST_F(TermEvaluationTest, WithoutLossIsTheCostFunctionItself) {
  MakeTerm(nullptr);
  ASSERT_TRUE(EvaluateTerm(term_, variables_, &evaluation_));
  EXPECT_EQ(evaluation_.rows, 2);
  EXPECT_MATRIX_NEAR(Residual(), Vector2d(-4, 2.95), 1e-15);
  EXPECT_MATRIX_NEAR(FirstJacobian(), BilinearJacobian(values_), 1e-15);
  EXPECT_NEAR(evaluation_.cost, 0.5 * Residual().squaredNorm(), 1e-12);
  EXPECT_EQ(evaluation_.cost, EvaluateTermCost(term_, variables_));
}

TEST_F(TermEvaluationTest, RobustCostAndGradientAgreeWithCeres) {
  for (const double scale : {0.1, 1.0, 20.0}) {
    const ceres::CauchyLoss loss(scale);
    MakeTerm(&loss);
    ASSERT_TRUE(EvaluateTerm(term_, variables_, &evaluation_));

    ceres::Problem problem;
    const Bilinear bilinear;
    problem.AddResidualBlock(new FactorCost(&bilinear, {3}), new ceres::CauchyLoss(scale),
                             values_.data());
    double cost = 0;
    std::vector<double> gradient;
    problem.Evaluate(ceres::Problem::EvaluateOptions(), &cost, nullptr, &gradient, nullptr);
    EXPECT_NEAR(evaluation_.cost, cost, 1e-12);
    EXPECT_NEAR(EvaluateTermCost(term_, variables_), cost, 1e-12);
    EXPECT_MATRIX_NEAR(FirstJacobian().transpose() * Residual(), Eigen::Vector3d(gradient.data()),
                       1e-12);
  }
}

TEST_F(TermEvaluationTest, TakesJacobiansAtTheLinearizationPoint) {
  const Eigen::Vector3d linearization(1.4, -1.8, 0.6);
  MakeTerm(nullptr, false, linearization.data());
  ASSERT_TRUE(EvaluateTerm(term_, variables_, &evaluation_));
  EXPECT_MATRIX_NEAR(Residual(), Vector2d(-4, 2.95), 1e-15);
  EXPECT_MATRIX_NEAR(FirstJacobian(), BilinearJacobian(linearization), 1e-15);
}

TEST_F(TermEvaluationTest, LeavesTheJacobianOfAConstantAlone) {
  const ceres::CauchyLoss robust(0.1);
  for (const ceres::LossFunction* loss :
       {static_cast<const ceres::CauchyLoss*>(nullptr), &robust}) {
    MakeTerm(loss, /*constant=*/true);
    evaluation_.jacobians[0].fill(7);
    ASSERT_TRUE(EvaluateTerm(term_, variables_, &evaluation_));
    EXPECT_MATRIX_NEAR(FirstJacobian(), Jacobian::Constant(7), 0.0);
  }
}

TEST_F(TermEvaluationTest, ReportsTermsThatCannotBeEvaluated) {
  MakeTerm(nullptr);
  EXPECT_TRUE(CanBeEvaluated(term_, variables_));
  values_[0] = -1;
  EXPECT_FALSE(EvaluateTerm(term_, variables_, &evaluation_));
  EXPECT_FALSE(CanBeEvaluated(term_, variables_));
  EXPECT_EQ(EvaluateTermCost(term_, variables_), std::numeric_limits<double>::infinity());
}

TEST_F(TermEvaluationTest, CannotBeEvaluatedWithoutJacobians) {
  const Eigen::Vector3d linearization(-1, 0, 0);
  MakeTerm(nullptr, false, linearization.data());
  EXPECT_FALSE(EvaluateTerm(term_, variables_, &evaluation_));
  EXPECT_FALSE(CanBeEvaluated(term_, variables_));
}

}  // namespace
}  // namespace plm_vins
