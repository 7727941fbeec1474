// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "common/measurements.h"
#include "offline/recordings/confirmed_stamp.h"
#include "offline/recordings/recording.h"

namespace plm_vins {

// The part of a recording to process, relative to its first image. Other measurements are used
// slightly beyond both ends, so that the first and last images are covered.
class RecordingInterval {
 public:
  enum class Part { kSkip, kUse, kEnd };

  // `start` and `duration` are in seconds and not negative.
  RecordingInterval(double start, double duration) : start_(start), duration_(duration) {}
  RecordingInterval() : RecordingInterval(0, std::numeric_limits<double>::infinity()) {}

  // Locates an event relative to the interval; to be called for all events in the order of the
  // recording. kEnd: no later event will be used.
  Part Locate(const RecordingEvent& event) {
    const bool is_image = event.kind == RecordingEvent::Kind::kImage;
    const bool is_imu = event.kind == RecordingEvent::Kind::kImu;
    if (is_image) first_image_.Add(event.t_ns);
    if (!first_image_.Admits(event.t_ns)) return start_ > 0 ? Part::kSkip : Part::kUse;
    const double margin = is_image ? 0 : kImuMargin;
    const double t = ToSeconds(event.t_ns - *first_image_.t_ns()) - start_;
    const bool beyond = t > duration_ + kImuMargin;
    if (is_image && beyond && image_beyond_ && (imu_beyond_ || t > duration_ + kLongestLead)) {
      return Part::kEnd;
    }
    if (is_image) image_beyond_ = beyond;
    if (is_imu) imu_beyond_ = beyond;
    if (t > duration_ + margin) return Part::kSkip;
    begun_ = begun_ || t >= 0;
    return begun_ || t >= -margin ? Part::kUse : Part::kSkip;
  }

 private:
  static constexpr double kImuMargin = 0.2;    // [s], exceeds any time offset
  static constexpr double kLongestLead = 5.0;  // [s] of images before the IMU in a recording

  double start_;
  double duration_;
  ConfirmedStamp first_image_;
  // Whether the last event of the kind is beyond the end; a single image may have a wrong
  // timestamp.
  bool image_beyond_ = false, imu_beyond_ = false;
  bool begun_ = false;  // after the start, backward jumps are left to the next stages
};

}  // namespace plm_vins
