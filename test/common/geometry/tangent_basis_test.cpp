// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/tangent_basis.h"

#include <gtest/gtest.h>

#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

TEST(TangentBasis, CompletesAnOrthonormalBasis) {
  simulator::Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::Matrix3d all;
    all.col(0) = random.NormalVector3().normalized();
    all.rightCols<2>() = TangentBasis(all.col(0));
    EXPECT_MATRIX_NEAR(Eigen::Matrix3d(all.transpose() * all), Eigen::Matrix3d::Identity(), 1e-12);
  }
}

}  // namespace
}  // namespace plm_vins
