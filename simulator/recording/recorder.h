// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "common/config/config.h"
#include "common/measurements.h"

namespace plm_vins::simulator {

// Writes a recording sample by sample in temporal order. Throws std::runtime_error with the name of
// a file that cannot be written; if the disk is full, in Finish() at the latest.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void Write(const ImuSample& sample) = 0;
  virtual void WriteImage(int camera, const ImageSample& image) = 0;
  // Takes depths along the optical axis [mm]; 0 is unknown.
  virtual void WriteDepth(int64_t t_ns, const cv::Mat1w& depth) = 0;
  // Flushes all files; must be the last call.
  virtual void Finish() = 0;
};

// Creates a ROS bag with the topics of the configuration. Throws std::runtime_error if the file
// cannot be written or the program was built without ROS.
std::unique_ptr<Recorder> MakeBagRecorder(const std::string& file, const SensorConfig& sensors);

}  // namespace plm_vins::simulator
