// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/input_check.h"

#include "common/format.h"

namespace plm_vins {

InputCheck::InputCheck(const SensorConfig& sensor)
    : images_("image_topic " + sensor.cameras[0].image_topic),
      imu_("imu_topic " + sensor.imu_topic),
      td_ns_(ToNanoseconds(sensor.td)),
      content_(sensor.gravity_norm) {}

void InputCheck::AddImu(const ImuSample& sample) {
  content_.Add(sample);
  imu_stamps_.Add(sample.t_ns);
  clocks_.AddImu(sample.t_ns);
}

void InputCheck::AddImage(int64_t t_ns) { clocks_.AddImage(t_ns + td_ns_); }

// Bursts repeat their stamps, too, for another reason.
std::string InputCheck::Finding(const ImuBursts& bursts) const {
  for (const std::string& finding :
       {bursts.size() == 0 ? imu_stamps_.Finding(imu_) : "", clocks_.Finding(images_, imu_),
        content_.Finding(imu_), BurstFinding(bursts)}) {
    if (!finding.empty()) return finding;
  }
  return "";
}

std::string InputCheck::BurstFinding(const ImuBursts& bursts) const {
  if (bursts.size() == 0) return "";
  return "samples on " + imu_ +
         Format(" come in bursts of %zu, stamped on arrival or rounded", bursts.size()) +
         Format(": their stamps are spread by %.1f ms each", 1e3 * bursts.interval()) +
         "; let the driver stamp each sample, or set estimate_td: 1";
}

}  // namespace plm_vins
