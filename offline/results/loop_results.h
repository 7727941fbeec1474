// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/io/output_file.h"
#include "map_bundle/map_bundle.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/results/timed_file.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/loop_tally.h"
#include "pose_graph/map/map_trajectory.h"
#include "vins_estimator/output/json.h"
#include "vins_estimator/output/series_summary.h"

namespace plm_vins {

// Runs loop closure in an offline run and writes its files to the result folder: trajectory_map.tum
// (causal estimates, from the first fix in the map on) with covariance_map.csv,
// trajectory_final.tum (final estimates) and loops.csv. At the end the whole map is
// bundle-adjusted.
class LoopResults {
 public:
  // Opens the files and starts from `map` if given. Throws std::runtime_error with the file name if
  // a file cannot be written; so does Finish().
  LoopResults(const Config& config, const std::string& folder, std::optional<KeyframeMap> map);

  // Processes the next image. Throws std::runtime_error if it has no pixels.
  void Add(const PipelineFrame& frame);

  // Number of keyframes that AdjustMap() would optimize; zero if there is nothing to adjust.
  size_t KeyframesToAdjust() const;

  // To be called after the last image and before the functions below. Stops early, with the result
  // so far, if `is_end` returns true.
  MapBundleSummary AdjustMap(const std::function<bool()>& is_end);

  // Completes all files.
  void Finish();

  // The map in the form from which another run can start. Keyframe numbers are those of loops.csv.
  const KeyframeMap& map() const { return adjusted_ ? adjusted_->rebuilt : loops_.map(); }

  // Counts and times, for summary.json.
  Json Summary() const;

  // A line for the terminal: the loops, and when the loaded map was recognized.
  std::string Line() const;

  // Returns what is wrong if a map was loaded and never recognized; otherwise an empty string.
  std::string Finding() const;

 private:
  // The map after bundle adjustment.
  struct Adjusted {
    KeyframeMap moved;    // with unchanged odometry poses
    KeyframeMap rebuilt;  // with odometry poses replaced by adjusted ones
  };

  std::string File(const std::string& name) const;
  void Count(const LoopClosure& closure, double milliseconds);
  void Remember(const PipelineFrame& frame, const LoopClosure& closure);
  // The map after loop closure and bundle adjustment, with the measurements of odometry and loops.
  const KeyframeMap& measured_map() const { return adjusted_ ? adjusted_->moved : loops_.map(); }
  void WriteFinalTrajectory() const;
  Json BundleSummary() const;

  std::string folder_;
  CameraModels cameras_;  // configured cameras
  LoopCloser loops_;
  std::optional<MapBundle> bundle_;
  std::optional<Adjusted> adjusted_;
  double bundle_ms_ = 0;
  TimedFile trajectory_;
  TimedFile covariance_;
  OutputFile table_;
  std::string restart_reason_;  // reason for a world without a pose yet; empty if none
  std::vector<OdometryPose> poses_;
  std::vector<std::pair<size_t, std::string>> worlds_;  // first pose, reason; without the first
  std::optional<double> first_fix_;                     // since the first pose [s]
  int loaded_keyframes_ = 0;                            // of the map that was loaded
  int64_t recognitions_ = 0;                            // of these keyframes
  int64_t keyframes_ = 0;
  LoopTally tally_;
  Series keyframe_ms_;
};

}  // namespace plm_vins
