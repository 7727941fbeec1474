// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/pose_rows.h"

#include <cinttypes>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr const char* kNames[] = {"px", "py", "pz", "rx", "ry", "rz"};

}  // namespace

std::string FormatTumRow(int64_t t_ns, const Rigid3d& T_W_B) {
  constexpr int64_t kSecond_ns = 1'000'000'000;
  const Eigen::Vector3d& p = T_W_B.translation;
  const Eigen::Quaterniond& q = T_W_B.rotation;
  return Format("%" PRId64 ".%09" PRId64 " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", t_ns / kSecond_ns,
                t_ns % kSecond_ns, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

std::string FormatTumRestart(const std::string& reason) {
  return "# the world frame starts anew: " + reason + "\n";
}

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
