// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/pose_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

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

TEST(CovarianceTable, HasTheUpperTriangleRowByRow) {
  Matrix6d covariance;
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) covariance(row, col) = std::min(row, col) + 1;
  }
  covariance(4, 5) = covariance(5, 4) = -1.25e-9;

  std::ostringstream stream;
  stream << CovarianceHeader();
  WriteCovarianceRow(1403636579763555584, covariance, &stream);
  EXPECT_EQ(stream.str(),
            "stamp_ns,px_px,px_py,px_pz,px_rx,px_ry,px_rz,py_py,py_pz,py_rx,py_ry,py_rz,"
            "pz_pz,pz_rx,pz_ry,pz_rz,rx_rx,rx_ry,rx_rz,ry_ry,ry_rz,rz_rz\n"
            "1403636579763555584,1.00000000e+00,1.00000000e+00,1.00000000e+00,1.00000000e+00,"
            "1.00000000e+00,1.00000000e+00,2.00000000e+00,2.00000000e+00,2.00000000e+00,"
            "2.00000000e+00,2.00000000e+00,3.00000000e+00,3.00000000e+00,3.00000000e+00,"
            "3.00000000e+00,4.00000000e+00,4.00000000e+00,4.00000000e+00,5.00000000e+00,"
            "-1.25000000e-09,6.00000000e+00\n");
}

}  // namespace

}  // namespace plm_vins
