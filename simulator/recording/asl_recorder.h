// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "common/io/output_file.h"
#include "simulator/recording/recorder.h"

namespace plm_vins::simulator {

// Writes the folders of the EuRoC dataset: DIR/mav0/cam0 and imu0; cam1, ... and depth0 if
// there are images of further cameras or of depth. DIR must not contain a recording yet.
class AslRecorder : public Recorder {
 public:
  explicit AslRecorder(const std::string& folder);

  void Write(const ImuSample& sample) override;
  void WriteImage(int camera, const ImageSample& image) override;
  void WriteDepth(int64_t t_ns, const cv::Mat1w& depth) override;
  void Finish() override;

  // Path of the recording's ground truth; the folder exists.
  static std::string GroundTruthFile(const std::string& folder);

 private:
  // A folder of pictures and their list.
  class Pictures {
   public:
    explicit Pictures(const std::string& folder);
    void Add(int64_t t_ns, const cv::Mat& picture);
    void Close() { list_.Close(); }

   private:
    std::string folder_;
    OutputFile list_;
  };

  std::string folder_;              // mav0
  std::map<int, Pictures> images_;  // by camera
  std::optional<Pictures> depths_;
  OutputFile imu_list_;
};

}  // namespace plm_vins::simulator
