// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/measurements.h"
#include "common/streams/drop_counts.h"

namespace plm_vins {

// One measurement of a recording. The pixels of an image are fetched apart, since they are costly.
struct RecordingEvent {
  enum class Kind { kImage, kImu };
  Kind kind = Kind::kImu;
  int64_t t_ns = 0;  // the sensor's stamp
  ImuSample imu;     // where kind is kImu
};

// Images and IMU samples of one camera-IMU recording, in the order in which they were recorded,
// read as they are asked for.
class Recording {
 public:
  virtual ~Recording() = default;

  // The next measurement; nothing at the end of what is readable.
  virtual std::optional<RecordingEvent> Next() = 0;

  // The grey image of the event that Next() gave last. Nothing where it is unreadable; problems()
  // count that.
  virtual std::optional<cv::Mat> LoadImage() = 0;

  virtual std::string name() const = 0;  // for reports
  // Where its images or IMU samples come from: a file, or a topic and its key.
  virtual std::string Source(RecordingEvent::Kind kind) const = 0;

  // About when the recording ends; nothing where that is not known beforehand.
  virtual std::optional<int64_t> end_ns() const = 0;

  // What could not be read so far.
  virtual DropCounts problems() const = 0;
};

}  // namespace plm_vins
