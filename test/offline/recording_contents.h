// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "offline/recordings/recording.h"
#include "test/testing/message_of.h"

namespace plm_vins::testing {

// All data of a recording.
struct RecordingContents {
  std::string order;  // one letter per event: m for IMU, i for an image, x for an unreadable one
  std::vector<int64_t> stamps;
  std::vector<cv::Mat> images;
  std::vector<ImuSample> imu;
  std::map<std::string, int64_t> problems;
};

inline RecordingContents ReadAll(Recording* recording) {
  RecordingContents contents;
  while (const auto event = recording->Next()) {
    contents.stamps.push_back(event->t_ns);
    if (event->kind == RecordingEvent::Kind::kImu) {
      contents.order += 'm';
      contents.imu.push_back(event->imu);
    } else if (const auto image = recording->LoadImage()) {
      contents.order += 'i';
      contents.images.push_back(*image);
    } else {
      contents.order += 'x';
    }
  }
  for (const DropCount& drop : recording->problems()) contents.problems[drop.cause] = drop.count;
  return contents;
}

}  // namespace plm_vins::testing
