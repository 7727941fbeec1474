// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/config/sensor_config.h"
#include "common/imu/imu_bursts.h"
#include "common/imu/imu_content.h"
#include "common/measurements.h"
#include "common/streams/clock_check.h"
#include "common/streams/constant_stamp.h"

namespace plm_vins {

// Recognizes what is wrong with the content and the stamps of the input as a whole. Counts what
// came since construction, before anything is dropped.
class InputCheck {
 public:
  explicit InputCheck(const SensorConfig& sensor);

  // Feed in order of arrival. Returns the sample with the stamp to use: that of a sample from a
  // burst is corrected (ImuBursts).
  ImuSample AddImu(const ImuSample& sample);
  void AddImage(int64_t t_ns);

  // Returns the most serious finding, with the topic and what to do; empty where there is none.
  std::string Finding() const;

 private:
  std::string BurstFinding() const;

  const std::string images_, imu_;  // keys and topics
  const int64_t td_ns_;
  ImuContent content_;
  ImuBursts bursts_;
  ConstantStamp imu_stamps_;
  ClockCheck clocks_;
};

}  // namespace plm_vins
