// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/covariance_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace plm_vins {
namespace {

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
