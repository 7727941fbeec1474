// SPDX-License-Identifier: BSD-3-Clause
// Data that the modules exchange. Read this file first.
//
// Timestamps are int64 nanoseconds; data of one image have exactly equal timestamps. Image
// coordinates with the suffix "_px" are pixels of the raw image; all others are normalized and
// undistorted: (x, y) of a ray (x, y, 1) in C.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace plm_vins {

constexpr double kNanosecondsPerSecond = 1e9;

inline double ToSeconds(int64_t t_ns) { return static_cast<double>(t_ns) / kNanosecondsPerSecond; }
inline int64_t ToNanoseconds(double seconds) {
  return static_cast<int64_t>(seconds * kNanosecondsPerSecond + (seconds < 0 ? -0.5 : 0.5));
}

// Valid timestamps are from zero to before kEndOfTime_ns, the range of ROS timestamps. Differences
// of any two, and sums with a time offset, do not overflow.
constexpr int64_t kEndOfTime_ns = (int64_t{1} << 32) * 1'000'000'000;
inline bool IsStamp(int64_t t_ns) { return t_ns >= 0 && t_ns < kEndOfTime_ns; }

// One gray image (CV_8UC1) as the camera delivered it, with lens distortion.
struct ImageSample {
  int64_t t_ns = 0;
  cv::Mat gray;                            // read-only: the pixels may be shared
  std::shared_ptr<const void> owner = {};  // owner of the pixels if `gray` is not; keep both
};

// Image of the depth along the optical axis, registered to camera 0: its size and lens apply.
struct DepthSample {
  int64_t t_ns = 0;
  cv::Mat depth;  // CV_16UC1 [depth_unit], 0 if unknown, or CV_32FC1 [m]; read only
  std::shared_ptr<const void> owner = {};  // owner of the pixels if `depth` is not; keep both
};

// One IMU reading in the body frame B.
struct ImuSample {
  int64_t t_ns = 0;
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   // angular velocity [rad/s]
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  // specific force [m/s^2]
  // Standard deviations in addition to the sensor noise, for replaced or saturated readings.
  double gyro_doubt = 0;   // [rad/s]
  double accel_doubt = 0;  // [m/s^2]
};

// Cameras of a rig have the numbers 0, 1, ...
constexpr int kMaxCameras = 4;

// Observation of a corner in one image.
struct PointObservation {
  int64_t id = -1;  // of the corner, never reused; equal ids in two cameras mean the same corner
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();        // normalized, undistorted
  Eigen::Vector2d uv_px = Eigen::Vector2d::Zero();     // raw pixel
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // d(xy)/dt [1/s]; zero when new
  int camera = 0;
  std::optional<double> depth = {};  // measured, along the camera's optical axis [m]
};

// All corners that the cameras observe at one time: those of camera 0 come first, then those of
// camera 1, ..., each in the order of its tracker. A camera observes an id at most once. May be
// empty.
struct PointFrame {
  int64_t t_ns = 0;
  std::vector<PointObservation> points;
};

inline bool Observes(const PointFrame& frame, int camera) {
  return std::any_of(frame.points.begin(), frame.points.end(),
                     [camera](const PointObservation& point) { return point.camera == camera; });
}

// Observation of a line segment in one image. The endpoints need not correspond to those in other
// images: only the line through them is measured.
struct LineObservation {
  int64_t id = -1;  // of the line, never reused; equal ids in two cameras mean the same line
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // normalized, undistorted
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    // normalized, undistorted
  int camera = 0;
  // Standard deviations of start and end across the line (normalized); zero: the noise of lines.
  Eigen::Vector2d deviation = Eigen::Vector2d::Zero();
};

// All line segments that the cameras observe at one time, in the order of PointFrame. May be empty.
struct LineFrame {
  int64_t t_ns = 0;
  std::vector<LineObservation> lines;
};

// Identifies the track of a feature in one camera.
template <typename Observation>
int64_t TrackKey(const Observation& observation) {
  return observation.id * kMaxCameras + observation.camera;
}

// Brings observations into the order of a frame.
template <typename Observation>
void SortByCamera(std::vector<Observation>* observations) {
  std::stable_sort(observations->begin(), observations->end(),
                   [](const auto& a, const auto& b) { return a.camera < b.camera; });
}

// Input of the estimator for one image: its features and the IMU samples up to it.
//
// `imu` covers the interval from the previous frame to this one and can be integrated directly: it
// starts with the sample interpolated at the time of the previous frame (identical to the last one
// of that frame's `imu`), continues with the samples in between, and ends with the sample
// interpolated at exactly t_ns + time_offset. For the first frame it starts with the first sample
// and may contain only one.
struct FrameMeasurement {
  int64_t t_ns = 0;          // image timestamp
  double time_offset = 0.0;  // td [s] that the IMU interval was computed with
  PointFrame points;
  std::optional<LineFrame> lines;  // nullopt without a line front end
  std::vector<ImuSample> imu;
};

// Appends samples that continue `joined`, without repeating the shared sample.
inline void JoinImu(const std::vector<ImuSample>& next, std::vector<ImuSample>* joined) {
  for (const ImuSample& sample : next) {
    if (joined->empty() || sample.t_ns > joined->back().t_ns) joined->push_back(sample);
  }
}

}  // namespace plm_vins
