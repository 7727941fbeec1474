// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "common/measurements.h"
#include "offline/recordings/confirmed_stamp.h"
#include "offline/recordings/recording.h"

namespace plm_vins {

// The part of a recording to process, counted from its first image. IMU samples are used a little
// beyond both ends, so that the first and the last image are covered.
class RecordingInterval {
 public:
  enum class Part { kSkip, kUse, kEnd };

  // `start` and `duration` in seconds; both zero or more.
  RecordingInterval(double start, double duration) : start_(start), duration_(duration) {}
  RecordingInterval() : RecordingInterval(0, std::numeric_limits<double>::infinity()) {}

  // Where the event lies; events are shown in the order of the recording. kEnd: nothing is used
  // from here on.
  Part Locate(const RecordingEvent& event) {
    const bool is_image = event.kind == RecordingEvent::Kind::kImage;
    if (is_image) first_image_.Add(event.t_ns);
    if (!first_image_.Admits(event.t_ns)) return start_ > 0 ? Part::kSkip : Part::kUse;
    const double margin = is_image ? 0 : kImuMargin;
    const double t = ToSeconds(event.t_ns - *first_image_.t_ns()) - start_;
    if (is_image) {
      const bool beyond = t > duration_ + kImuMargin;
      if (beyond && beyond_) return Part::kEnd;
      beyond_ = beyond;
    }
    if (t > duration_ + margin) return Part::kSkip;
    begun_ = begun_ || t >= 0;
    return begun_ || t >= -margin ? Part::kUse : Part::kSkip;
  }

 private:
  static constexpr double kImuMargin = 0.2;  // [s], more than any time offset

  double start_;
  double duration_;
  ConfirmedStamp first_image_;
  bool beyond_ = false;  // the end, the last image; one alone may have a wrong stamp
  bool begun_ = false;   // from here on, stamps may jump back: that is for the next stages to judge
};

}  // namespace plm_vins
