// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/segment_end_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(EndPointDistances, AreThoseInTheImage) {
  const Vector3d moment = Vector3d(3, 4, -10);  // of the image line 3 x + 4 y = 10
  const SegmentEndPoints view{{0, 0}, {2, 4}};
  Vector2d distances;
  ASSERT_TRUE(EndPointDistances(view, moment, &distances, nullptr));
  EXPECT_MATRIX_NEAR(distances, Vector2d(-2, 2.4), 1e-12);
  ASSERT_TRUE(EndPointDistances(view, 7 * moment, &distances, nullptr));
  EXPECT_MATRIX_NEAR(distances, Vector2d(-2, 2.4), 1e-12);
}

TEST(EndPointDistances, DerivativeIsExact) {
  simulator::Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const SegmentEndPoints view{random.NormalVector3().head<2>(), random.NormalVector3().head<2>()};
    const Vector3d moment = random.NormalVector3();
    const auto distances = [&view](const Vector3d& m) {
      Vector2d result;
      EXPECT_TRUE(EndPointDistances(view, m, &result, nullptr));
      return Eigen::VectorXd(result);
    };
    Vector2d at_moment;
    Eigen::Matrix<double, 2, 3> derivative;
    ASSERT_TRUE(EndPointDistances(view, moment, &at_moment, &derivative));
    EXPECT_MATRIX_NEAR(at_moment, distances(moment), 0.0);
    const Eigen::MatrixXd numeric = testing::NumericJacobian(distances, moment);
    EXPECT_MATRIX_NEAR(derivative, numeric, 1e-6 * (1 + numeric.norm()));
  }
}

TEST(EndPointDistances, NeedALineThatHasAnImage) {
  Vector2d distances;
  const SegmentEndPoints view{{0, 0}, {1, 0}};
  EXPECT_FALSE(EndPointDistances(view, Vector3d::Zero(), &distances, nullptr));
  EXPECT_FALSE(EndPointDistances(view, Vector3d::UnitZ(), &distances, nullptr));
  EXPECT_FALSE(EndPointDistances(view, Vector3d::Constant(std::nan("")), &distances, nullptr));
}

}  // namespace
}  // namespace plm_vins
