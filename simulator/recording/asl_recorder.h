// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/io/output_file.h"
#include "simulator/recording/recorder.h"

namespace plm_vins::simulator {

// Writes the folders of the EuRoC dataset: DIR/mav0/cam0 and imu0. DIR must not contain a recording
// yet.
class AslRecorder : public Recorder {
 public:
  explicit AslRecorder(const std::string& folder);

  void Write(const ImuSample& sample) override;
  void Write(const ImageSample& image) override;
  void Finish() override;

  // Path of the recording's ground truth; the folder exists.
  static std::string GroundTruthFile(const std::string& folder);

 private:
  std::string image_folder_;
  OutputFile image_list_, imu_list_;
};

}  // namespace plm_vins::simulator
