// SPDX-License-Identifier: BSD-3-Clause
// Numeric derivatives for tests of analytic Jacobians, and comparison of matrices.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace plm_vins::testing {

// Central differences of `function` (Point -> Eigen vector) at `x` in the tangent space of `plus`
// (Point, Eigen::VectorXd of length `tangent_size` -> Point). The result has one column per tangent
// direction. With values of order one the error is about 1e-16 / step + step^2.
template <typename Function, typename Point, typename Plus>
Eigen::MatrixXd NumericJacobian(const Function& function, const Point& x, int tangent_size,
                                const Plus& plus, double step = 1e-6) {
  Eigen::MatrixXd jacobian;
  for (int i = 0; i < tangent_size; ++i) {
    const Eigen::VectorXd delta = step * Eigen::VectorXd::Unit(tangent_size, i);
    const Eigen::VectorXd forward = function(plus(x, delta));
    const Eigen::VectorXd backward = function(plus(x, Eigen::VectorXd(-delta)));
    if (i == 0) jacobian.resize(forward.size(), tangent_size);
    jacobian.col(i) = (forward - backward) / (2 * step);
  }
  return jacobian;
}

// Central differences for a function of a vector.
template <typename Function, int kSize>
Eigen::MatrixXd NumericJacobian(const Function& function, const Eigen::Matrix<double, kSize, 1>& x,
                                double step = 1e-6) {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  const auto plus = [](const Vector& point, const Eigen::VectorXd& delta) {
    return Vector(point + delta);
  };
  return NumericJacobian(function, x, static_cast<int>(x.size()), plus, step);
}

// Succeeds if sizes are equal and all entries agree within `tolerance`; NaN never does.
inline ::testing::AssertionResult MatrixNear(const char* actual_text, const char* expected_text,
                                             const char* /*tolerance_text*/,
                                             const Eigen::MatrixXd& actual,
                                             const Eigen::MatrixXd& expected, double tolerance) {
  const bool same_size = actual.rows() == expected.rows() && actual.cols() == expected.cols();
  if (same_size && ((actual - expected).array().abs() <= tolerance).all()) {
    return ::testing::AssertionSuccess();
  }
  ::testing::AssertionResult failure = ::testing::AssertionFailure();
  failure << actual_text << " =\n" << actual << "\n" << expected_text << " =\n" << expected;
  if (same_size) {
    failure << "\nlargest difference " << (actual - expected).cwiseAbs().maxCoeff()
            << ", tolerance " << tolerance;
  }
  return failure;
}

}  // namespace plm_vins::testing

#define EXPECT_MATRIX_NEAR(actual, expected, tolerance) \
  EXPECT_PRED_FORMAT3(::plm_vins::testing::MatrixNear, actual, expected, tolerance)
#define ASSERT_MATRIX_NEAR(actual, expected, tolerance) \
  ASSERT_PRED_FORMAT3(::plm_vins::testing::MatrixNear, actual, expected, tolerance)
