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

// Detects problems in the content and the timestamps of the input as a whole. Counts all input
// since construction, before anything is dropped.
class InputCheck {
 public:
  explicit InputCheck(const SensorConfig& sensor);

  // Must be called in order of arrival, with samples as they arrive.
  void AddImu(const ImuSample& sample);
  void AddImage(int64_t t_ns);

  // Returns the most serious finding, with the topic and what to do; empty if there is none.
  // `bursts` are those of the samples so far.
  std::string Finding(const ImuBursts& bursts) const;

 private:
  std::string BurstFinding(const ImuBursts& bursts) const;

  const std::string images_, imu_;  // keys and topics
  const int64_t td_ns_;
  ImuContent content_;
  ConstantStamp imu_stamps_;
  ClockCheck clocks_;
};

}  // namespace plm_vins
