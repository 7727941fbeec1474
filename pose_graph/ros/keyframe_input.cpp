// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ros/keyframe_input.h"

#include <cmath>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

#include "common/camera/image_format.h"
#include "common/config/stereo_pairs.h"
#include "common/ros/camera_info_conversion.h"
#include "common/ros/geometry_conversion.h"
#include "common/ros/keyframe_conversion.h"

namespace plm_vins {
namespace {

constexpr double kUnitTolerance = 1e-2;  // error of a quaternion's norm in single precision

bool IsUnit(const Eigen::Quaterniond& q) { return std::abs(q.norm() - 1) < kUnitTolerance; }

// Rejects another camera than the configured one: its rays would not match.
void CheckSameKind(const CameraParameters& ours, const CameraParameters& refined) {
  if (refined.model == ours.model && refined.width == ours.width && refined.height == ours.height) {
    return;
  }
  throw std::invalid_argument("its camera model or image size differs from the configuration");
}

// Runs `take` and counts exceptions, whose text tells what is wrong with a message.
void CountFailure(DropCount* failures, const std::function<void()>& take) {
  try {
    take();
  } catch (const std::exception& error) {
    failures->Add(error.what());
  }
}

}  // namespace

KeyframeInput::KeyframeInput(const SensorConfig& sensor)
    : sensor_(sensor), assembly_(sensor.stamp_tolerance) {
  const std::vector<StereoPair> pairs = StereoPairs(sensor);
  for (int camera = 0; camera < static_cast<int>(sensor.cameras.size()); ++camera) {
    if (IsTracked(camera, pairs)) cameras_.push_back(camera);
    refined_.push_back(sensor.cameras[camera].parameters);
    T_B_C_.push_back(sensor.cameras[camera].T_B_C);
  }
}

bool KeyframeInput::Accepts(const nav_msgs::Odometry& message) {
  const auto& p = message.pose.pose.position;
  const auto& q = message.pose.pose.orientation;
  const bool is_possible = Eigen::Vector3d(p.x, p.y, p.z).allFinite() &&
                           IsUnit(Eigen::Quaterniond(q.w, q.x, q.y, q.z)) &&
                           Eigen::Map<const RowMajor6d>(message.pose.covariance.data()).allFinite();
  if (!is_possible) ++poses_.count;
  return is_possible;
}

// Rejects images of another size than calibrated: descriptors would be taken at wrong pixels.
void KeyframeInput::AddImage(int camera, const ImageSample& image) {
  CountFailure(&images_, [&] {
    CheckImageFormat(image.gray, sensor_.cameras[camera].parameters);
    assembly_.AddImage(camera, image);
  });
}

void KeyframeInput::AddPose(const nav_msgs::Odometry& message) {
  if (!Accepts(message)) return;
  // An unknown covariance becomes zero, so that odometry edges get the minimum of OdometryNoise.
  const auto covariance = CovarianceOf(message.pose).value_or(Eigen::Matrix<double, 6, 6>::Zero());
  assembly_.AddPose(ToNanoseconds(message.header.stamp), ToRigid(message.pose.pose), covariance);
}

void KeyframeInput::AddPoints(const sensor_msgs::PointCloud& message) {
  CountFailure(&malformed_, [&] {
    assembly_.AddCorners(ToNanoseconds(message.header.stamp), ToCorners(message, &features_.count));
  });
}

void KeyframeInput::AddLines(const sensor_msgs::PointCloud& message) {
  CountFailure(&malformed_, [&] {
    assembly_.AddSegments(ToNanoseconds(message.header.stamp),
                          ToSegments(message, &features_.count));
  });
}

// CameraModel::Create() throws if the model is invalid.
void KeyframeInput::AddCamera(int camera, const sensor_msgs::CameraInfo& message) {
  CountFailure(&cameras_refused_, [&] {
    const CameraParameters refined = ToCameraParameters(message);
    CheckSameKind(sensor_.cameras[camera].parameters, refined);
    CameraModel::Create(refined);
    refined_[camera] = refined;
  });
}

void KeyframeInput::AddExtrinsics(int camera, const nav_msgs::Odometry& message) {
  if (Accepts(message)) T_B_C_[camera] = ToRigid(message.pose.pose);
}

std::optional<OdometryFrame> KeyframeInput::Pop() {
  std::optional<OdometryFrame> frame = assembly_.Pop();
  if (!frame) return std::nullopt;
  frame->T_B_C = T_B_C_;
  frame->refined = refined_;
  return frame;
}

}  // namespace plm_vins
