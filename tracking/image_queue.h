// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/config/config.h"
#include "common/measurements.h"
#include "common/streams/backward_jump.h"
#include "common/streams/drop_counts.h"
#include "common/streams/forward_jump.h"
#include "tracking/gyro_predictor.h"
#include "tracking/rate_limiter.h"

namespace plm_vins {

// An image whose turn it is, and what a tracker needs to know of it.
struct ReadyImage {
  ImageSample image;
  // Takes directions of the camera at the image before to this one. Nothing where the gyro does not
  // provide it.
  std::optional<Eigen::Quaterniond> R_C1_C0;
  bool restart = false;  // stamps jumped back: a new recording begins here, what was before is void
  bool publish = true;   // false: the features of this image are not for the estimator (`freq`)
};

// Images that came in and what was wrong with them. All counts are since construction.
struct ImageCounts {
  int64_t images = 0;
  int64_t out_of_order = 0;  // stamp not after the one before (repeated or backwards)
  int64_t ahead = 0;         // more than a second after the one before, and alone there so far
  int64_t restarts = 0;      // stamps jumped back for good: a new recording
  int64_t wrong_format = 0;  // not grey or not of the calibrated size
  int64_t gaps = 0;          // more than a second without images
  int64_t without_gyro = 0;  // handed out without R_C1_C0, as the gyro did not cover it
  std::string wrong_format_detail;
};

DropCounts ToDropCounts(const ImageCounts& counts);

// Brings images to a tracker: checks them and lets each wait (a little) until the gyro reaches it.
// Two queues that are given the same input decide the same on every image, so that the features of
// different trackers have equal stamps. Synchronous; feed in order of arrival and pop until nothing
// is ready, as with MeasurementSync.
class ImageQueue {
 public:
  explicit ImageQueue(const Config& config);

  void AddImu(const ImuSample& sample) { gyro_.AddImu(sample); }

  // Stamps must increase; an image that goes back in time is dropped, unless more and more of them
  // follow: then it is a new recording. An image that leaps ahead is dropped, too, unless the next
  // one confirms the leap.
  void AddImage(ImageSample image);

  // The next image in order of time, or nothing yet. An image waits for the gyro until two newer
  // images have come.
  std::optional<ReadyImage> Pop();

  // The same without waiting for the gyro.
  std::optional<ReadyImage> Flush();

  bool empty() const { return images_.empty(); }
  const ImageCounts& counts() const { return counts_; }

 private:
  struct WaitingImage {
    ImageSample image;
    bool restart = false;
  };

  // False, and counted, where the image is not grey or not of the calibrated size.
  bool AcceptFormat(const ImageSample& image);

  SensorConfig sensor_;
  bool uses_gyro_;
  GyroPredictor gyro_;
  RateLimiter rate_limiter_;
  ImageCounts counts_;
  std::deque<WaitingImage> images_;
  std::optional<int64_t> accepted_ns_;    // stamp of the last image taken in
  std::optional<int64_t> handed_out_ns_;  // stamp of the last image handed out
  BackwardJumpDetector jump_;
  ForwardJumpDetector leap_;
};

}  // namespace plm_vins
