// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/streams/drop_counts.h"
#include "vins_estimator/output/frame_columns.h"
#include "vins_estimator/output/json.h"
#include "vins_estimator/output/series_summary.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Accumulates summary.json frame by frame. Its memory does not grow with the run.
class RunSummary {
 public:
  // `columns` has the names of the columns of each frame.
  explicit RunSummary(const FrameColumns& columns = {});

  // Adds a frame; frames must be in order of time.
  void Add(const EstimatorOutput& output, const FrameColumns& columns);

  int64_t frames() const { return frames_; }
  int64_t poses() const { return poses_; }
  // Calibration at the last pose.
  const Calibration& calibration() const { return calibration_; }
  const std::string& last_reason() const { return last_reason_; }  // why there was no pose

  // Properties of the run other than those of its frames.
  struct Run {
    std::string input;
    int64_t images = 0;  // read, whether usable or not
    std::optional<int64_t> first_image_ns;
    double wall_time = 0;    // [s]
    int64_t map_points = 0;  // landmarks written to the map
    int64_t map_lines = 0;   // lines written to the map
    DropCounts drops;
    std::vector<std::string> findings;  // possible faults, the likeliest cause first
    std::vector<ResidualRing> residual_rings;
  };
  Json ToJson(const Run& run) const;

 private:
  void AddPose(const EstimatorOutput& output);

  int64_t frames_ = 0;
  int64_t points_ = 0;  // observed, sum over all frames
  int64_t poses_ = 0;
  int64_t stationary_ = 0;
  int64_t keyframes_ = 0;
  int64_t resets_ = 0;
  int64_t bridged_losses_ = 0;  // tracking losses without a new world frame
  int64_t imu_doubts_ = 0;
  double accel_density_ = 0, gyro_density_ = 0;  // sums over all poses
  int64_t imu_noisy_ = 0;                        // poses with a noise scale above 1
  int64_t merged_lines_ = 0;
  int64_t recognized_lines_ = 0;
  int64_t manhattan_ = 0;   // poses with a Manhattan frame
  double path_length_ = 0;  // [m]
  std::optional<Eigen::Vector3d> last_position_;
  Calibration calibration_;  // at the last pose
  std::optional<int64_t> first_pose_ns_;
  std::optional<int64_t> last_frame_ns_;
  int64_t duration_ns_ = 0;
  std::string last_reason_;
  // One value for each frame.
  std::vector<Column<Series>> timings_, counts_;
};

}  // namespace plm_vins
