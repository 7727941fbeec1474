// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/measurements.h"
#include "common/stopwatch.h"
#include "tracking/image_mask.h"
#include "tracking/image_queue.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// The features of one image with statistics and processing time.
template <typename Tracker>
struct Tracked {
  ImageSample image;  // the image with these features
  typename Tracker::Features features;
  typename Tracker::Statistics statistics;
  bool restart = false;    // see ReadyImage
  bool publish = true;     // see ReadyImage
  double tracking_ms = 0;  // [ms]
};

// A front end, as used by the nodes and the offline runner: an ImageQueue followed by a tracker.
// `kSection` is the tracker's part of the configuration. Synchronous; add in order of arrival and
// pop until nullopt.
template <typename Tracker, auto kSection>
class TrackingStage {
 public:
  using Frame = Tracked<Tracker>;

  // For `max_wait` see ImageQueue. Throws ConfigError if the tracker rejects its part of the
  // configuration.
  explicit TrackingStage(const Config& config,
                         double max_wait = std::numeric_limits<double>::infinity())
      : queue_(config, max_wait), tracker_(MakeTracker(config)) {}

  // See ImageQueue.
  void AddImu(const ImuSample& sample) { queue_.AddImu(sample); }
  void AddImage(ImageSample image) { queue_.AddImage(std::move(image)); }
  void AddRight(ImageSample image) { queue_.AddRight(std::move(image)); }
  void AddDepth(DepthSample image) { queue_.AddDepth(std::move(image)); }
  bool waiting() const { return !queue_.empty(); }
  const ImageCounts& counts() const { return queue_.counts(); }

  // Returns the features of the next image in temporal order, or nullopt if it still waits.
  std::optional<Frame> Pop() { return Track(queue_.Pop()); }

  // Returns the features of the next image without waiting.
  std::optional<Frame> Flush() { return Track(queue_.Flush()); }

  const Tracker& tracker() const { return tracker_; }
  Tracker& tracker() { return tracker_; }

 private:
  // Adds the file name to errors of the tracker, which name the key only.
  static Tracker MakeTracker(const Config& config) {
    try {
      const CameraParameters& camera = config.sensor.cameras[0].parameters;
      return Tracker(config.*kSection, CameraModel::Create(camera),
                     ReadMask(config.points.fisheye_mask, {camera.width, camera.height}),
                     CameraPairOf(config.sensor));
    } catch (const std::invalid_argument& error) {
      throw ConfigError({config.file + ": " + error.what()});
    }
  }

  std::optional<Frame> Track(const std::optional<ReadyImage>& next) {
    if (!next) return std::nullopt;
    if (next->restart) tracker_.Reset();
    const Stopwatch stopwatch;
    Frame frame;
    frame.image = next->image;
    frame.features = tracker_.Track(next->image, next->R_C1_C0, next->companions);
    frame.tracking_ms = stopwatch.Milliseconds();
    frame.statistics = tracker_.statistics();
    frame.restart = next->restart;
    frame.publish = next->publish;
    return frame;
  }

  ImageQueue queue_;
  Tracker tracker_;
};

}  // namespace plm_vins
