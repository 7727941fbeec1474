// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/measurements.h"
#include "common/streams/drop_counts.h"

namespace plm_vins {

// One measurement of a recording. The pixels of an image are loaded separately, since that is slow.
struct RecordingEvent {
  enum class Kind { kImage, kImu, kDepth };
  Kind kind = Kind::kImu;
  int64_t t_ns = 0;  // the sensor's timestamp
  ImuSample imu;     // if kind is kImu
  int camera = 0;    // if kind is kImage
};

// Images, IMU samples and, if requested, depth images of a recording, in the order of recording.
// Read on demand.
class Recording {
 public:
  virtual ~Recording() = default;

  // Returns the next measurement, or nullopt at the end of the readable data.
  virtual std::optional<RecordingEvent> Next() = 0;

  // Loads the image of the event that Next() returned last: CV_8UC1, or depth as in DepthSample.
  // Returns nullopt if it is unreadable, which problems() counts.
  virtual std::optional<cv::Mat> LoadImage() = 0;

  virtual std::string name() const = 0;  // for reports
  // Origin of the images of camera 0, of the IMU samples or of the depth images: a file, or a topic
  // and its key.
  virtual std::string Source(RecordingEvent::Kind kind) const = 0;

  // Approximate end of the recording; nullopt if not known in advance.
  virtual std::optional<int64_t> end_ns() const = 0;

  // Counts of unreadable data so far.
  virtual DropCounts problems() const = 0;
};

}  // namespace plm_vins
