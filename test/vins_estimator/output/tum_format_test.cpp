// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/tum_format.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(TumFormat, HasNineDecimalsAndTheExactStamp) {
  const Rigid3d T_W_B(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d(1, -2.5, 1.0 / 3));
  EXPECT_EQ(FormatTumRow(1403636579763555584, T_W_B),
            "1403636579.763555584 1.000000000 -2.500000000 0.333333333 "
            "-0.500000000 0.500000000 -0.500000000 0.500000000\n");
}

TEST(TumFormat, PadsTheFractionOfTheStamp) {
  EXPECT_EQ(FormatTumRow(5'000'000'007, Rigid3d()).substr(0, 12), "5.000000007 ");
}

TEST(TumFormat, MarksANewWorldFrameInAComment) {
  EXPECT_EQ(FormatTumRestart("why"), "# the world frame starts anew: why\n");
}

}  // namespace
}  // namespace plm_vins
