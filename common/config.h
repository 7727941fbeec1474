// SPDX-License-Identifier: BSD-3-Clause
// The whole configuration of the suite. One YAML file serves all nodes, so every node checks all of
// it. Keys, units, ranges: config/reference.yaml.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/camera_model.h"
#include "common/imu_noise.h"
#include "common/rigid3.h"

namespace plm_vins {

// The sensors: topics, calibration, noise.
struct SensorConfig {
  std::string image_topic = "/cam0/image_raw";
  std::string imu_topic = "/imu0";
  CameraParameters camera;
  Rigid3d T_B_C;  // camera in the body (IMU) frame
  enum class ExtrinsicMode { kFixed = 0, kRefine = 1, kCalibrateRotation = 2 };
  ExtrinsicMode estimate_extrinsic = ExtrinsicMode::kFixed;
  double td = 0.0;  // t_imu = t_image + td [s]
  bool estimate_td = false;
  ImuNoise imu_noise;
  double gravity_norm = 9.81;  // [m/s^2]
};

enum class CornerDetectorType { kShiTomasi, kHarris };

struct PointTrackerConfig {
  CornerDetectorType corner_detector = CornerDetectorType::kShiTomasi;
  bool corner_subpixel = true;  // refine corners to subpixel (the paper, section III.A)
  int max_cnt = 150;            // corners per image
  double min_dist = 20;         // least distance between corners [px]
  double f_threshold = 1.0;     // epipolar RANSAC threshold [px]
  bool equalize = true;         // CLAHE
  std::string fisheye_mask;     // image file, non-zero where corners are allowed; empty: everywhere
  double quality_level = 0.03;  // corner response relative to the image's best
  int klt_window = 16;          // [px]
  int klt_levels = 3;           // pyramid levels above the image itself
  double forward_backward = 0.5;  // KLT there and back must return this close [px]
};

enum class LineDetectorType { kFld, kLsd, kEdLines };
enum class LineMatcherType { kFlow, kLbd };

struct LineTrackerConfig {
  LineDetectorType line_detector = LineDetectorType::kFld;
  LineMatcherType line_matcher = LineMatcherType::kFlow;
  bool half_resolution = true;       // detect at half resolution; lines are refined at the full one
  bool join_fragments = true;        // join collinear fragments of one image
  int max_lines = 60;                // lines per image
  double min_length = 0.08;          // shortest line, as a share of the image's short side
  double border = 4;                 // lines keep this far from the image's edge [px]
  double min_gradient = 5;           // least slope across a line [grey levels/px]
  double spacing = 5;                // least distance between parallel lines side by side [px]
  double refill_below = 0.9;         // detect where fewer than this share of max_lines is tracked
  int refill_interval = 3;           // and at most every so many images
  double max_angle = 10;             // between where a line is predicted and found [deg]
  double max_distance = 40;          // the same, across the line [px]
  double min_overlap = 0.5;          // the same, as a share of the shorter one
  double min_correlation = 0.6;      // of the brightness around a line from image to image
  int max_descriptor_distance = 50;  // LBD: differing bits of 256
};

// Of the window; see docs/solver.md.
enum class SolverType { kSchur, kCeres };

struct EstimatorConfig {
  int window_size = 10;             // keyframes kept beside the newest frame
  double keyframe_parallax = 20.0;  // mean parallax that makes a keyframe [px]
  int max_num_iterations = 8;       // of the window optimisation
  SolverType solver = SolverType::kSchur;
  double point_noise = 0.7;  // standard deviation of a corner [px]
  double line_noise = 0.5;   // standard deviation of a line's end across the line [px]

  double line_outlier_distance = 10.0;     // longest line that is believed [m]
  bool line_merging = true;                // one landmark for what is one line
  double line_merge_distance = 0.1;        // between lines that are merged, in space [m]
  double line_merge_image_distance = 5.0;  // the same, in the image [px]
  double line_merge_angle = 3.0;           // between their directions [deg]
  int line_anchors = 24;                   // frames kept for the sake of lines that come back
  bool manhattan_constraints = true;       // lines on a Manhattan axis hold the heading
  double manhattan_noise = 1.0;            // of a line's direction from its axis [deg]

  bool zero_velocity_update = true;
  bool verbose = false;
};

struct OutputConfig {
  std::string world_frame = "world";
  std::string body_frame = "body";
  std::string camera_frame = "camera";
  std::string base_frame;  // of a robot whose own tree leads to the body; empty: none
  bool publish_tf = true;
};

struct Config {
  std::string file;                       // where it was read from, for messages
  std::vector<std::string> ignored_keys;  // accepted from VINS files, without effect here
  SensorConfig sensor;
  double publish_rate = 0;  // images whose features the estimator gets [Hz]; 0: all
  bool show_track = true;   // publish annotated images
  PointTrackerConfig points;
  bool use_lines = true;  // beside the points
  LineTrackerConfig lines;
  EstimatorConfig estimator;
  OutputConfig output;
};

// Every problem of a configuration, one per line, each naming file and key.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::vector<std::string>& problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

// Reads a VINS-format YAML file ("%YAML:1.0"); `overrides` replace scalar keys by their text.
// Throws ConfigError with *all* problems: missing, unknown (with the nearest known key), of a wrong
// type, out of range, contradictory.
Config LoadConfig(const std::string& file,
                  const std::map<std::string, std::string>& overrides = {});

}  // namespace plm_vins
