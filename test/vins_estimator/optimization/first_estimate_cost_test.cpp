// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/optimization/first_estimate_cost.h"

#include <ceres/sized_cost_function.h>
#include <gtest/gtest.h>

namespace plm_vins {
namespace {

// r = x y^2, defined for x > 0.
class Product final : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double x = parameters[0][0], y = parameters[1][0];
    if (x <= 0) return false;
    residuals[0] = x * y * y;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) jacobians[0][0] = y * y;
    if (jacobians[1] != nullptr) jacobians[1][0] = 2 * x * y;
    return true;
  }
};

class FirstEstimateCostTest : public ::testing::Test {
 protected:
  bool Evaluate(bool with_jacobians) {
    const double* parameters[] = {&x_, &y_};
    double* jacobians[] = {&d_x_, &d_y_};
    return cost_.Evaluate(parameters, &residual_, with_jacobians ? jacobians : nullptr);
  }

  double x_ = 2, y_ = 3, first_x_ = 5;
  double residual_ = 0, d_x_ = 0, d_y_ = 0;
  const Product product_;
  const FirstEstimateCost cost_{&product_, {&first_x_, nullptr}};
};

TEST_F(FirstEstimateCostTest, ResidualAtTheValuesJacobiansAtTheFirstEstimates) {
  ASSERT_TRUE(Evaluate(true));
  EXPECT_EQ(residual_, 2 * 9);
  EXPECT_EQ(d_x_, 9);
  EXPECT_EQ(d_y_, 2 * 5 * 3);
  ASSERT_TRUE(Evaluate(false));
  EXPECT_EQ(residual_, 2 * 9);
}

TEST_F(FirstEstimateCostTest, HasTheBlocksOfTheCost) {
  EXPECT_EQ(cost_.num_residuals(), 1);
  EXPECT_EQ(cost_.parameter_block_sizes(), product_.parameter_block_sizes());
}

TEST_F(FirstEstimateCostTest, FailsWhereEitherFails) {
  x_ = -1;
  EXPECT_FALSE(Evaluate(true));
  EXPECT_FALSE(Evaluate(false));
  x_ = 2;
  first_x_ = -1;
  EXPECT_FALSE(Evaluate(true));
}

}  // namespace
}  // namespace plm_vins
