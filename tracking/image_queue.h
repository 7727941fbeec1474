// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/config/stereo_pairs.h"
#include "common/measurements.h"
#include "common/streams/drop_counts.h"
#include "common/streams/stamp_order.h"
#include "tracking/gyro_predictor.h"
#include "tracking/image_schedule.h"
#include "tracking/missing_images.h"
#include "tracking/pairing_queue.h"

namespace plm_vins {

// The next image to be tracked, with its prediction and flags.
struct ReadyImage {
  // By camera. An image that is missing, or that need not be searched, has no pixels.
  std::vector<ImageSample> images;
  DepthSample depth;  // without pixels: none
  // Rotates directions from the frame of camera 0 in the previous image to this one's. nullopt if
  // the gyroscope does not cover the interval.
  std::optional<Eigen::Quaterniond> R_now_then;
  bool restart = false;  // timestamps jumped back: a new recording begins; drop earlier state
  bool publish = true;   // false: not for the estimator, by the rate `freq`
};

// Faults of the images of a camera other than 0.
struct OtherImageCounts {
  explicit OtherImageCounts(int camera);

  MissingImages missing;
  DropCount repeated, unusable;
};

// Counts of received images of camera 0 and their faults since construction.
struct ImageCounts {
  int64_t images = 0;
  int64_t out_of_order = 0;  // timestamp repeated or earlier than the previous one
  int64_t ahead = 0;         // more than a second ahead, not confirmed by the next image
  int64_t restarts = 0;      // permanent backward jumps: new recordings
  int64_t wrong_format = 0;  // not CV_8UC1 or not of the calibrated size
  int64_t gaps = 0;          // intervals of more than a second without images
  int64_t without_gyro = 0;  // returned without R_now_then, since the gyroscope did not cover it
  int64_t too_late = 0;      // dropped after waiting for too long; not in ToDropCounts()
  std::string wrong_format_detail;
  DropCount flat{"images_without_contrast", 0, ""};  // tracked nevertheless
  DropCount bayer{"images_raw_bayer", 0, ""};        // likewise
  std::vector<OtherImageCounts> others;              // of cameras 1, 2, ...
  MissingImages without_depth{"images_without_depth"};
  DropCount depth_unusable{"depth_images_wrong_format", 0, ""};
};

DropCounts ToDropCounts(const ImageCounts& counts);

// Input queue of a tracker: checks images and holds each image of camera 0 back briefly until the
// gyroscope samples reach it. The images of other cameras and of depth are paired with those of
// camera 0 whose timestamps agree within stamp_tolerance; one that is late or missing delays others
// at most briefly. The result depends on the input only: queues of different trackers select the
// same images, so that their features have equal timestamps. Synchronous; add in order of arrival
// and pop until nullopt, as with MeasurementSync.
class ImageQueue {
 public:
  // While newer images wait, an image that the gyroscope leads by more than `max_wait` [s], or the
  // newest image by twice that, is dropped: a tracker that is too slow for the rate skips images.
  explicit ImageQueue(const Config& config,
                      double max_wait = std::numeric_limits<double>::infinity());

  void AddImu(const ImuSample& sample) { gyro_.AddImu(sample); }

  // Timestamps of a camera must increase. An image that goes back in time is dropped, unless enough
  // images follow it there: then a new recording begins. An image that jumps ahead is dropped,
  // unless the next one confirms the jump. An image of another camera than 0 that need not be
  // searched has no pixels. Ignores cameras and depth that the configuration does not have.
  void AddImage(int camera, ImageSample image);
  void AddDepth(DepthSample image);

  // Returns the next image in temporal order, or nullopt if it still waits. An image waits for the
  // gyroscope and the other images during half a second of newer images, so that a transport stall
  // changes nothing; after the gyroscope missed an image, it waits for two newer images only.
  std::optional<ReadyImage> Pop();

  // Returns the next image without waiting.
  std::optional<ReadyImage> Flush();

  bool empty() const { return images_.empty(); }
  const ImageCounts& counts() const { return counts_; }

 private:
  struct WaitingImage {
    ImageSample image;
    bool restart = false;
  };

  // A camera other than 0.
  struct OtherCamera {
    explicit OtherCamera(double tolerance) : waiting(tolerance) {}

    PairingQueue<ImageSample> waiting;
    ImageSample last, last_of_first;  // the last pair that was searched, with camera 0
  };

  void AddImageOfFirst(ImageSample image);
  // Returns false, and counts the image, if it is not CV_8UC1 or not of the calibrated size.
  bool AcceptFormat(const ImageSample& image);
  bool IsComplete(int64_t t_ns) const;
  void DropTooLate();
  void TakeOthers(ReadyImage* ready);
  void DropRepeated(int camera, std::vector<ImageSample>* images);

  SensorConfig sensor_;
  std::optional<int64_t> max_wait_ns_;  // nullopt: unlimited
  bool uses_gyro_;
  GyroPredictor gyro_;
  RateLimiter rate_limiter_;
  ImageCounts counts_;
  std::deque<WaitingImage> images_;
  std::vector<StereoPair> pairs_;
  std::vector<OtherCamera> others_;  // cameras 1, 2, ...
  PairingQueue<DepthSample> depth_;
  std::optional<int64_t> handed_out_ns_;  // timestamp of the last image that was returned
  bool gyro_is_in_time_ = false;          // samples reached the last image that was returned
  StampOrder order_;
};

}  // namespace plm_vins
