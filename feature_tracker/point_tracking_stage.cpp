// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracking_stage.h"

#include <stdexcept>
#include <utility>

#include "common/stopwatch.h"

namespace plm_vins {
namespace {

constexpr size_t kMaxWaiting = 2;  // newer images that an image lets pass for the gyro
constexpr int64_t kImageGap_ns = 1'000'000'000;
constexpr int kRefusedUntilRestart = 10;  // images from the past in a row
constexpr size_t kFewPoints = 10;         // too few to tell the motion of the camera from

}  // namespace

DropCounts ToDropCounts(const PointTrackingCounts& counts) {
  return {{"images_out_of_order", counts.out_of_order, ""},
          {"images_wrong_format", counts.wrong_format, counts.wrong_format_detail},
          {"image_gaps", counts.gaps, ""},
          {"image_restarts", counts.restarts, ""},
          {"images_with_few_points", counts.few_points, ""},
          {"images_without_gyro", counts.without_gyro, ""}};
}

PointTrackingStage::PointTrackingStage(const Config& config)
    : config_(config),
      tracker_(config.points, CameraModel::Create(config.sensor.camera)),
      gyro_(config.sensor.T_B_C, config.sensor.td),
      rate_limiter_(config.points.publish_rate) {}

void PointTrackingStage::AddImu(const ImuSample& sample) { gyro_.AddImu(sample); }

void PointTrackingStage::AddImage(ImageSample image) {
  ++counts_.images;
  const int64_t t_ns = image.t_ns;
  bool restart = false;
  if (accepted_ns_ && t_ns <= *accepted_ns_) {
    ++counts_.out_of_order;
    if (!IsNewRecording(t_ns)) return;
    restart = true;
    ++counts_.restarts;
    gyro_ = GyroPredictor(config_.sensor.T_B_C, config_.sensor.td);
  } else if (accepted_ns_ && t_ns - *accepted_ns_ > kImageGap_ns) {
    ++counts_.gaps;
  }
  refused_in_a_row_ = 0;
  accepted_ns_ = t_ns;
  images_.push_back({std::move(image), restart});
}

bool PointTrackingStage::IsNewRecording(int64_t refused_ns) {
  refused_in_a_row_ = refused_ns > refused_ns_ ? refused_in_a_row_ + 1 : 1;
  refused_ns_ = refused_ns;
  return refused_in_a_row_ > kRefusedUntilRestart;
}

bool PointTrackingStage::UsesGyro() const {
  return config_.sensor.estimate_extrinsic != SensorConfig::ExtrinsicMode::kCalibrateRotation;
}

std::optional<TrackedFrame> PointTrackingStage::Pop() {
  if (images_.empty()) return std::nullopt;
  const bool wait = UsesGyro() && images_.size() <= kMaxWaiting;
  if (wait && !gyro_.Covers(images_.front().image.t_ns)) return std::nullopt;
  return Flush();
}

std::optional<TrackedFrame> PointTrackingStage::Flush() {
  while (!images_.empty()) {
    try {
      return TrackFront();
    } catch (const std::invalid_argument& error) {
      if (counts_.wrong_format++ == 0) counts_.wrong_format_detail = error.what();
      images_.pop_front();
    }
  }
  return std::nullopt;
}

TrackedFrame PointTrackingStage::TrackFront() {
  const WaitingImage& front = images_.front();
  if (front.restart) {
    tracker_.Reset();
    rate_limiter_.Reset();
    tracked_ns_.reset();
    restart_pending_ = true;
  }
  const Stopwatch stopwatch;
  TrackedFrame frame;
  frame.points = tracker_.Track(front.image, PredictRotation(front.image.t_ns));
  frame.tracking_ms = stopwatch.Milliseconds();
  if (frame.points.points.size() < kFewPoints) ++counts_.few_points;
  frame.restart = std::exchange(restart_pending_, false);
  frame.publish = rate_limiter_.Take(front.image.t_ns);
  tracked_ns_ = front.image.t_ns;
  images_.pop_front();
  return frame;
}

std::optional<Eigen::Quaterniond> PointTrackingStage::PredictRotation(int64_t t_ns) {
  if (!tracked_ns_ || !UsesGyro()) return std::nullopt;
  const auto R_C1_C0 = gyro_.Rotation(*tracked_ns_, t_ns);
  if (!R_C1_C0) ++counts_.without_gyro;
  return R_C1_C0;
}

}  // namespace plm_vins
