// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/tum_format.h"

#include <cinttypes>

#include "common/format.h"

namespace plm_vins {

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

}  // namespace plm_vins
