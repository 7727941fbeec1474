// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>

#include "common/config.h"
#include "common/drop_counts.h"
#include "feature_tracker/point_tracking_stage.h"
#include "vins_estimator/estimation_stage.h"
#include "vins_estimator/offline/recording.h"
#include "vins_estimator/offline/recording_interval.h"

namespace plm_vins {

// What the pipeline says about one image.
struct PipelineFrame {
  EstimatorOutput output;
  double point_tracking_ms = 0;
};

// Front end and back end in a row, fed from a recording.
//
// The two may run in threads of their own, the front end ahead by a few images. What each is given,
// and in which order, does not depend on that, so the results are the same bit by bit.
class OdometryPipeline {
 public:
  enum class Threads { kOne, kTwo };
  using FrameCallback = std::function<void(const PipelineFrame&)>;

  explicit OdometryPipeline(const Config& config);

  // Processes the recording; `on_frame` is called in the caller's thread, in order of time.
  void Run(Recording* recording, RecordingInterval interval, Threads threads,
           const FrameCallback& on_frame);

  // After Run().
  int64_t images() const { return front_end_.counts().images; }
  std::optional<int64_t> first_image_ns() const { return first_image_ns_; }
  DropCounts drops() const;

  // An image of the second half of the run with its tracks drawn (CV_8UC3); empty without images.
  const cv::Mat& annotated_image() const { return annotated_image_; }

 private:
  // What flows from the front end to the back end, in order.
  struct Item {
    std::optional<TrackedFrame> frame;
    ImuSample imu;  // where there is no frame
  };
  using ItemCallback = std::function<bool(Item)>;  // false: no more are wanted

  void RunFrontEnd(Recording* recording, RecordingInterval interval, const ItemCallback& emit);
  bool Feed(const RecordingEvent& event, Recording* recording, const ItemCallback& emit);
  bool EmitTracked(TrackedFrame frame, const ItemCallback& emit);
  void RunInTwoThreads(Recording* recording, const RecordingInterval& interval,
                       const FrameCallback& on_frame);
  void Consume(Item item, const FrameCallback& on_frame);
  void Report(EstimatedFrame estimated, const FrameCallback& on_frame);

  PointTrackingStage front_end_;
  EstimationStage back_end_;
  std::optional<int64_t> first_image_ns_;
  int64_t tracked_images_ = 0;
  cv::Mat annotated_image_;
  std::map<int64_t, double> tracking_ms_;  // by stamp, of frames that the back end has not finished
};

}  // namespace plm_vins
