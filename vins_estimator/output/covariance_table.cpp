// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/covariance_table.h"

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr const char* kNames[] = {"px", "py", "pz", "rx", "ry", "rz"};

}  // namespace

std::string CovarianceHeader() {
  std::string header = "stamp_ns";
  for (int row = 0; row < 6; ++row) {
    for (int col = row; col < 6; ++col) header += Format(",%s_%s", kNames[row], kNames[col]);
  }
  return header + "\n";
}

void WriteCovarianceRow(int64_t t_ns, const Matrix6d& covariance, std::ostream* stream) {
  *stream << t_ns;
  for (int row = 0; row < 6; ++row) {
    for (int col = row; col < 6; ++col) *stream << Format(",%.8e", covariance(row, col));
  }
  *stream << "\n";
}

}  // namespace plm_vins
