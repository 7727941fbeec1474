// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/finding.h"
#include "common/streams/constant_stamp.h"
#include "common/streams/drop_counts.h"
#include "offline/pipeline/feature_file.h"
#include "offline/pipeline/feature_trackers.h"
#include "offline/pipeline/run_ahead.h"
#include "offline/recordings/confirmed_stamp.h"
#include "offline/recordings/recording.h"
#include "offline/recordings/recording_interval.h"
#include "tracking/image_schedule.h"
#include "vins_estimator/estimation_stage.h"

namespace plm_vins {

// Results of the pipeline for one image.
struct PipelineFrame {
  EstimatorOutput output;
  std::vector<ImageSample> images;  // by camera; without pixels unless loops are closed
  std::vector<ImuSample> imu;       // samples of the estimator, without those of the previous frame
  int64_t imu_ns = 0;               // IMU time of the state, which is that of the last sample
  PointFrame points;
  LineFrame lines;
  double point_tracking_ms = 0;
  double line_tracking_ms = 0;  // including detection
  PointTrackerStatistics point_tracking;
  LineTrackerStatistics line_tracking;
};

// Runs front ends and back end over a recording.
//
// With two threads the front end runs ahead of the back end by a few images; with three, points and
// lines are tracked concurrently as well; with four, images are read and decoded ahead of both. The
// input of each stage and its order do not depend on the threads, so the results are bit-identical.
class OdometryPipeline {
 public:
  using FrameCallback = std::function<void(const PipelineFrame&)>;
  // Receives an image with its points, and with its lines (CV_8UC3; empty if lines are not used).
  using TrackImageCallback =
      std::function<void(int64_t t_ns, const cv::Mat& points, const cv::Mat& lines)>;

  explicit OdometryPipeline(const Config& config);

  // Saves the tracked features to this file from now on; null disables saving.
  void SaveFeatures(FeatureFileWriter* file) { saved_features_ = file; }

  // Calls back about every `interval` [s] of the recording, in the thread of the trackers.
  void ShowTracks(double interval, TrackImageCallback on_images);

  // `is_end` is called before each measurement, in the reading thread; once true, the recording
  // ends.
  void EndWhere(std::function<bool()> is_end) { is_end_ = std::move(is_end); }

  // Ignores from the start what another run over the same input found out: wrong lengths, and parts
  // of the image that stand still.
  void LearnFrom(const OdometryPipeline& earlier);

  // Returns whether Run() has found something to ignore, and ended early, since the poses before
  // depend on it; another run can learn from it.
  bool must_repeat() const { return back_end_.has_found_wrong_length() || trackers_.HasLearned(); }

  // Processes the recording; `on_frame` is called in the caller's thread, in temporal order.
  void Run(Recording* recording, RecordingInterval interval, int threads,
           const FrameCallback& on_frame);

  // Processes saved features instead of images. With the same estimator configuration, the results
  // are bit-identical to those of the run that saved them.
  void Run(FeatureFileReader* features, RecordingInterval interval, const FrameCallback& on_frame);

  // Statistics, valid after Run().
  int64_t images() const { return images_; }
  // Number of images that were not thinned out by `freq` but did not reach the estimator either.
  int64_t unused_images() const { return images() - thinned_images_ - estimated_images_; }
  std::optional<int64_t> first_image_ns() const { return first_image_.t_ns(); }
  std::optional<int64_t> last_image_ns() const { return last_image_ns_; }  // used or not
  std::optional<int64_t> last_frame_ns() const { return last_frame_ns_; }  // last estimated frame
  // First timestamp of all samples that were read, whether used or not.
  std::optional<int64_t> first_imu_ns() const { return first_imu_.t_ns(); }
  DropCounts drops() const;
  // Returns what is wrong with the timestamps of the images or with the input as a whole, and what
  // to do; empty if nothing is. Names the topics as configured.
  std::string InputFinding() const;
  std::string StillPartsFinding() const { return still_parts_.finding().text; }
  std::vector<ResidualRing> residual_rings() const { return back_end_.ResidualRings(); }
  // Describes what is wrong with the input, the most probable cause of errors first.
  std::vector<std::string> Findings() const;

  // An image of the second half of the run with its points or lines drawn (CV_8UC3); empty without
  // images, or if lines are not used.
  const cv::Mat& points_image() const { return points_image_; }
  const cv::Mat& lines_image() const { return lines_image_; }

 private:
  static constexpr int64_t kMinContradicted = 20;

  struct LoadedEvent {
    RecordingEvent event;
    // nullopt if the event is not a readable image; empty if the image need not be searched.
    std::optional<cv::Mat> image;
  };
  using EventReceiver = ItemReceiver<LoadedEvent>;
  using TrackedReceiver = ItemReceiver<TrackedItem>;

  std::optional<cv::Mat> Load(const RecordingEvent& event, Recording* recording);
  void Read(Recording* recording, RecordingInterval interval, const EventReceiver& emit);
  void RunTrackers(Recording* recording, const RecordingInterval& interval, bool reads_ahead,
                   const TrackedReceiver& emit);
  bool Feed(LoadedEvent loaded, const TrackedReceiver& emit);
  void AddImage(const RecordingEvent& event, cv::Mat image);
  void AddImageStamp(int64_t t_ns);
  bool EmitTracked(TrackedFeatures frame, const TrackedReceiver& emit);
  void ShowTracksIfDue(int64_t t_ns);
  void Consume(TrackedItem item, const FrameCallback& on_frame);
  void AddFeatures(TrackedFeatures tracked);
  void Report(EstimatedFrame estimated, const FrameCallback& on_frame);

  const bool use_lines_;
  const bool keeps_pixels_;
  const std::string image_topic_;
  ImageSchedule schedule_;
  FeatureTrackers trackers_;
  EstimationStage back_end_;
  std::function<bool()> is_end_ = [] { return false; };
  ConfirmedStamp first_image_, first_imu_;
  ConstantStamp image_stamps_;
  FindingMemory stamp_faults_, still_parts_, sensor_faults_;
  std::string imu_contradiction_;    // the last one that was not empty
  int64_t contradicted_images_ = 0;  // images with a contradiction
  std::optional<int64_t> last_image_ns_, last_frame_ns_;
  int64_t images_ = 0;
  int64_t unreadable_images_ = 0;
  int64_t tracked_images_ = 0;
  std::optional<int64_t> learned_ns_;  // since when trackers know more than at first
  int64_t thinned_images_ = 0;         // skipped to reach the rate `freq`
  int64_t estimated_images_ = 0;
  std::optional<int64_t> last_imu_ns_;  // last IMU timestamp of the previous frame
  FeatureFileWriter* saved_features_ = nullptr;
  TrackImageCallback on_track_images_;
  int64_t track_image_interval_ns_ = 0;
  std::optional<int64_t> last_track_image_ns_;
  cv::Mat points_image_;
  cv::Mat lines_image_;
  std::map<int64_t, PipelineFrame> unfinished_;  // not estimated yet, by timestamp
};

}  // namespace plm_vins
