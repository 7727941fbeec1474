// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "offline/recordings/recording.h"
#include "test/testing/still_scene.h"

namespace plm_vins::testing {

inline constexpr int64_t kStart = 1403636579763555584;
inline constexpr int64_t kMillisecond = 1'000'000;

// A recording in memory with constant images, or unreadable ones.
class MemoryRecording : public Recording {
 public:
  void AddImage(int64_t milliseconds, const cv::Mat& picture = StillPicture()) {
    events_.push_back(
        {RecordingEvent::Kind::kImage, kStart + milliseconds * kMillisecond, ImuSample()});
    pictures_[events_.size()] = picture;
  }
  void AddImu(int64_t milliseconds) {
    const ImuSample sample = StillImu(kStart + milliseconds * kMillisecond);
    events_.push_back({RecordingEvent::Kind::kImu, sample.t_ns, sample});
  }
  void Fail() { failing_ = true; }  // throws at the end, as on a disk failure
  std::vector<RecordingEvent>& events() { return events_; }

  std::optional<RecordingEvent> Next() override {
    if (next_ == events_.size() && failing_) throw std::runtime_error("disk error");
    if (next_ == events_.size()) return std::nullopt;
    return events_[next_++];
  }
  std::optional<cv::Mat> LoadImage() override {
    const cv::Mat picture = pictures_.at(next_);
    return picture.empty() ? std::nullopt : std::make_optional(picture);
  }
  std::string name() const override { return "memory"; }
  std::string Source(RecordingEvent::Kind) const override { return "memory"; }
  std::optional<int64_t> end_ns() const override { return std::nullopt; }
  DropCounts problems() const override { return {}; }

 private:
  std::vector<RecordingEvent> events_;
  std::map<size_t, cv::Mat> pictures_;  // by the number of events up to and including the image
  size_t next_ = 0;
  bool failing_ = false;
};

// IMU samples at 200 Hz, images at 20 Hz.
inline MemoryRecording StillRecording(int milliseconds) {
  MemoryRecording recording;
  for (int t = 0; t <= milliseconds; t += 5) {
    recording.AddImu(t);
    if (t % 50 == 10) recording.AddImage(t);
  }
  return recording;
}

}  // namespace plm_vins::testing
