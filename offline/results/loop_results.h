// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/io/output_file.h"
#include "map_bundle/map_bundle.h"
#include "offline/pipeline/odometry_pipeline.h"
#include "offline/results/timed_file.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/loop_tally.h"
#include "pose_graph/map/map_trajectory.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// Loop closure over an offline run and its files in the folder of results: trajectory_map.tum (as
// known at each time, once the place in the map is known) with covariance_map.csv,
// trajectory_final.tum (as known in the end), loops.csv, pose_graph.g2o and the COLMAP model in
// colmap/. In the end the map is adjusted as a whole.
class LoopResults {
 public:
  // Opens the files; starts in a map where there is one. Here and in Finish() std::runtime_error
  // names the file that cannot be written.
  LoopResults(const Config& config, const std::string& folder, std::optional<KeyframeMap> map);

  // Takes the next image. Throws std::runtime_error where it has no pixels.
  void Add(const PipelineFrame& frame);

  // How many keyframes AdjustMap() would take; zero: it has nothing to do.
  size_t KeyframesToAdjust() const;

  // After the last image, before all that follows. Ends early where `is_end` says so, with what is
  // found by then.
  MapBundleSummary AdjustMap(const std::function<bool()>& is_end);

  // Completes all files.
  void Finish();

  // As another run may start in it. With numbers as in loops.csv.
  const KeyframeMap& map() const { return adjusted_ ? adjusted_->rebuilt : loops_.map(); }

  // Counts and times, for summary.json.
  Json Summary() const;

 private:
  // The map after the bundle adjustment.
  struct Adjusted {
    KeyframeMap moved;    // with odometry as it was
    KeyframeMap rebuilt;  // with all as if odometry had found it so
  };

  std::string File(const std::string& name) const;
  void Count(const LoopClosure& closure, double milliseconds);
  void Remember(const PipelineFrame& frame, const LoopClosure& closure);
  // The map as of loops and bundle, with what odometry and loops measured.
  const KeyframeMap& measured_map() const { return adjusted_ ? adjusted_->moved : loops_.map(); }
  void WriteFinalTrajectory() const;
  Json BundleSummary() const;

  std::string folder_;
  std::shared_ptr<const CameraModel> camera_;  // as configured
  CameraParameters refined_camera_;            // as of the last pose in M: of the keyframes' rays
  LoopCloser loops_;
  std::optional<MapBundle> bundle_;
  std::optional<Adjusted> adjusted_;
  double bundle_ms_ = 0;
  TimedFile trajectory_;
  TimedFile covariance_;
  OutputFile table_;
  std::string restart_reason_;  // of a world without a pose yet; empty: there is none
  std::vector<OdometryPose> poses_;
  std::vector<std::pair<size_t, std::string>> worlds_;  // first pose of each but the first, reason
  std::optional<double> first_fix_;                     // since the first pose [s]
  int64_t keyframes_ = 0;
  LoopTally tally_;
  std::vector<std::array<double, 1>> keyframe_ms_;
};

}  // namespace plm_vins
