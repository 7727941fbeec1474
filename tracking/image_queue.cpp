// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_queue.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/camera/image_format.h"
#include "common/format.h"
#include "tracking/image_check.h"

namespace plm_vins {
namespace {

// Newer images that end the wait if the gyroscope did not reach the previous image either.
constexpr size_t kMaxWaiting = 2;
constexpr int64_t kMaxWait_ns = 500'000'000;  // longest wait otherwise, up to the newest image

std::string Nearest(int64_t t_ns, const std::optional<int64_t>& last_ns) {
  if (!last_ns) return "none has come yet";
  const double later = 1e3 * ToSeconds(*last_ns - t_ns);
  return Format("the last one's timestamp is %.1f ms %s", std::abs(later),
                later < 0 ? "earlier" : "later");
}

}  // namespace

DropCounts ToDropCounts(const ImageCounts& counts) {
  DropCounts drops = {{"images_out_of_order", counts.out_of_order, ""},
                      {"images_ahead_of_time", counts.ahead, ""},
                      {"images_wrong_format", counts.wrong_format, counts.wrong_format_detail},
                      {"image_gaps", counts.gaps, ""},
                      {"image_restarts", counts.restarts, ""},
                      {"images_without_gyro", counts.without_gyro, ""}};
  for (const DropCount& companion :
       {counts.without_right, counts.without_depth, counts.right_repeated, counts.right_unusable,
        counts.depth_unusable}) {
    if (companion.count > 0) drops.push_back(companion);
  }
  return drops;
}

// The gyroscope cannot predict while the rotation between camera and IMU is still to be calibrated.
ImageQueue::ImageQueue(const Config& config, double max_wait)
    : sensor_(config.sensor),
      uses_gyro_(sensor_.estimate_extrinsic != SensorConfig::ExtrinsicMode::kCalibrateRotation),
      gyro_(sensor_.cameras[0].T_B_C, sensor_.td, sensor_.imu),
      rate_limiter_(config.publish_rate),
      order_(kImageJumps) {
  if (std::isfinite(max_wait)) max_wait_ns_ = ToNanoseconds(max_wait);
}

void ImageQueue::AddImage(ImageSample image) {
  ++counts_.images;
  if (!AcceptFormat(image)) return;
  const StampVerdict verdict = order_.Add(image.t_ns);
  const bool restart = verdict == StampVerdict::kRestarts;
  counts_.out_of_order += verdict == StampVerdict::kIsBack || restart;
  counts_.ahead += verdict == StampVerdict::kIsAhead;
  counts_.gaps += verdict == StampVerdict::kFollowsGap;
  counts_.restarts += restart;
  if (!StampOrder::IsAccepted(verdict)) return;
  if (restart) gyro_ = GyroPredictor(sensor_.cameras[0].T_B_C, sensor_.td, sensor_.imu);
  images_.push_back({std::move(image), restart});
}

bool ImageQueue::AcceptFormat(const ImageSample& image) {
  try {
    CheckImageFormat(image.gray, sensor_.cameras[0].parameters);
    return true;
  } catch (const std::invalid_argument& error) {
    if (counts_.wrong_format++ == 0) counts_.wrong_format_detail = error.what();
    return false;
  }
}

void ImageQueue::AddRight(ImageSample image) {
  if (sensor_.cameras.size() == 1) return;
  try {
    if (!image.gray.empty()) CheckImageFormat(image.gray, sensor_.cameras[1].parameters);
    right_.Add(std::move(image));
  } catch (const std::invalid_argument& error) {
    counts_.right_unusable.Add(error.what());
  }
}

void ImageQueue::AddDepth(DepthSample image) {
  if (!sensor_.depth) return;
  try {
    CheckDepthFormat(image.depth, sensor_.cameras[0].parameters);
    depth_.Add(std::move(image));
  } catch (const std::invalid_argument& error) {
    counts_.depth_unusable.Add(error.what());
  }
}

bool ImageQueue::IsComplete(int64_t t_ns) const {
  return (!uses_gyro_ || gyro_.Covers(t_ns)) && !right_.IsAwaited(t_ns) && !depth_.IsAwaited(t_ns);
}

ImageCompanions ImageQueue::TakeCompanions(int64_t t_ns) {
  ImageCompanions companions;
  auto right = right_.Take(t_ns);
  auto depth = depth_.Take(t_ns);
  if (sensor_.cameras.size() > 1 && !right)
    counts_.without_right.Add(Nearest(t_ns, right_.last_ns()));
  if (sensor_.depth && !depth) counts_.without_depth.Add(Nearest(t_ns, depth_.last_ns()));
  if (right) companions.right = std::move(*right);
  if (depth) companions.depth = std::move(*depth);
  return companions;
}

// Matches in a repeated image of the second camera contradict the motion of the first camera.
void ImageQueue::DropRepeated(const ImageSample& image, ImageSample* right) {
  if (right->gray.empty()) return;
  const bool is_repeated =
      AreSame(right->gray, last_right_.gray) && !AreSame(image.gray, last_left_.gray);
  last_left_ = image;
  last_right_ = *right;
  if (!is_repeated) return;
  counts_.right_repeated.Add("the second camera is frozen while the first one moves");
  *right = {};
}

void ImageQueue::DropTooLate() {
  if (!max_wait_ns_) return;
  while (images_.size() > 1) {
    const int64_t t_ns = images_.front().image.t_ns;
    const bool late = IsComplete(images_[1].image.t_ns) && gyro_.Covers(t_ns + *max_wait_ns_ + 1);
    if (!late && images_.back().image.t_ns - t_ns <= 2 * *max_wait_ns_) return;
    images_[1].restart = images_[1].restart || images_.front().restart;
    images_.pop_front();
    ++counts_.too_late;
  }
}

std::optional<ReadyImage> ImageQueue::Pop() {
  DropTooLate();
  if (images_.empty()) return std::nullopt;
  const bool in_time =
      images_.back().image.t_ns - images_.front().image.t_ns <= kMaxWait_ns && gyro_is_in_time_;
  const bool may_wait = images_.size() <= kMaxWaiting || in_time;
  if (may_wait && !IsComplete(images_.front().image.t_ns)) return std::nullopt;
  return Flush();
}

std::optional<ReadyImage> ImageQueue::Flush() {
  if (images_.empty()) return std::nullopt;
  ReadyImage ready;
  ready.image = std::move(images_.front().image);
  ready.restart = images_.front().restart;
  images_.pop_front();
  if (ready.restart) {
    rate_limiter_.Reset();
    handed_out_ns_.reset();
  }
  gyro_is_in_time_ = gyro_.Covers(ready.image.t_ns);
  if (handed_out_ns_ && uses_gyro_) {
    ready.R_C1_C0 = gyro_.Rotation(*handed_out_ns_, ready.image.t_ns);
    if (!ready.R_C1_C0) ++counts_.without_gyro;
  }
  ready.companions = TakeCompanions(ready.image.t_ns);
  ready.publish = rate_limiter_.Take(ready.image.t_ns);
  if (!ready.publish) ready.companions.right = {};  // matches would not be used
  DropRepeated(ready.image, &ready.companions.right);
  handed_out_ns_ = ready.image.t_ns;
  return ready;
}

}  // namespace plm_vins
