// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/image_queue.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/camera/image_format.h"
#include "tracking/images/image_check.h"

namespace plm_vins {
namespace {

// Newer images that end the wait if the gyroscope did not reach the previous image either.
constexpr size_t kMaxWaiting = 2;
constexpr int64_t kMaxWait_ns = 500'000'000;  // longest wait otherwise, up to the newest image

}  // namespace

OtherImageCounts::OtherImageCounts(int camera)
    : missing("images_without_camera" + std::to_string(camera)) {
  const std::string name = "camera" + std::to_string(camera);
  repeated.cause = name + "_images_repeated";
  unusable.cause = name + "_images_wrong_format";
}

DropCounts ToDropCounts(const ImageCounts& counts) {
  DropCounts drops = {{"images_out_of_order", counts.out_of_order, ""},
                      {"images_ahead_of_time", counts.ahead, ""},
                      {"images_wrong_format", counts.wrong_format, counts.wrong_format_detail},
                      {"image_gaps", counts.gaps, ""},
                      {"image_restarts", counts.restarts, ""},
                      {"images_without_gyro", counts.without_gyro, ""}};
  const auto add = [&drops](const DropCount& drop) {
    if (drop.count > 0) drops.push_back(drop);
  };
  for (const OtherImageCounts& other : counts.others) {
    add(other.missing.count());
    add(other.repeated);
    add(other.unusable);
  }
  add(counts.flat);
  add(counts.bayer);
  add(counts.without_depth.count());
  add(counts.depth_unusable);
  return drops;
}

// The gyroscope cannot predict while the rotation between camera and IMU is still to be calibrated.
ImageQueue::ImageQueue(const Config& config, double max_wait)
    : sensor_(config.sensor),
      uses_gyro_(sensor_.estimate_extrinsic != SensorConfig::ExtrinsicMode::kCalibrateRotation),
      gyro_(sensor_.cameras[0].T_B_C, sensor_.td, sensor_.imu),
      rate_limiter_(config.publish_rate),
      pairs_(StereoPairs(sensor_)),
      others_(sensor_.cameras.size() - 1, OtherCamera(sensor_.stamp_tolerance)),
      depth_(sensor_.stamp_tolerance),
      order_(kImageJumps) {
  for (size_t i = 0; i < others_.size(); ++i) {
    counts_.others.emplace_back(static_cast<int>(i) + 1);
  }
  if (std::isfinite(max_wait)) max_wait_ns_ = ToNanoseconds(max_wait);
}

void ImageQueue::AddImage(int camera, ImageSample image) {
  if (camera == 0) return AddImageOfFirst(std::move(image));
  if (camera > static_cast<int>(others_.size())) return;
  const int64_t t_ns = image.t_ns;
  try {
    if (!image.gray.empty()) CheckImageFormat(image.gray, sensor_.cameras[camera].parameters);
    others_[camera - 1].waiting.Add(std::move(image));
  } catch (const std::invalid_argument& error) {
    counts_.others[camera - 1].unusable.Add(error.what());
    counts_.others[camera - 1].missing.AddUnusable(t_ns, error.what());
  }
}

void ImageQueue::AddImageOfFirst(ImageSample image) {
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
    const std::string flat = DescribeIfFlat(image.gray);
    if (!flat.empty()) counts_.flat.Add(flat);
    const std::string bayer = DescribeIfBayer(image.gray);
    if (!bayer.empty()) counts_.bayer.Add(bayer);
    return true;
  } catch (const std::invalid_argument& error) {
    if (counts_.wrong_format++ == 0) counts_.wrong_format_detail = error.what();
    return false;
  }
}

void ImageQueue::AddDepth(DepthSample image) {
  if (!sensor_.depth) return;
  const int64_t t_ns = image.t_ns;
  try {
    CheckDepthFormat(image.depth, sensor_.cameras[0].parameters);
    depth_.Add(std::move(image));
  } catch (const std::invalid_argument& error) {
    counts_.depth_unusable.Add(error.what());
    counts_.without_depth.AddUnusable(t_ns, error.what());
  }
}

bool ImageQueue::IsComplete(int64_t t_ns) const {
  const bool awaits = std::any_of(others_.begin(), others_.end(), [t_ns](const auto& other) {
    return other.waiting.IsAwaited(t_ns);
  });
  return (!uses_gyro_ || gyro_.Covers(t_ns)) && !awaits && !depth_.IsAwaited(t_ns);
}

// Matches in images that are not published would not be used.
void ImageQueue::TakeOthers(ReadyImage* ready) {
  const int64_t t_ns = ready->images[0].t_ns;
  for (size_t i = 0; i < others_.size(); ++i) {
    const int camera = static_cast<int>(i) + 1;
    auto image = others_[i].waiting.Take(t_ns);
    MissingImages& missing = counts_.others[i].missing;
    if (!image) {
      missing.AddMissing(t_ns, others_[i].waiting.last_ns());
      continue;
    }
    missing.AddPaired(t_ns);
    if (ready->publish || IsTracked(camera, pairs_)) {
      ready->images[camera] = std::move(*image);
      DropRepeated(camera, &ready->images);
    }
  }
  if (!sensor_.depth) return;
  if (auto depth = depth_.Take(t_ns)) {
    counts_.without_depth.AddPaired(t_ns);
    ready->depth = std::move(*depth);
  } else {
    counts_.without_depth.AddMissing(t_ns, depth_.last_ns());
  }
}

// Observations in repeated images contradict the motion of camera 0.
void ImageQueue::DropRepeated(int camera, std::vector<ImageSample>* images) {
  ImageSample& image = (*images)[camera];
  if (image.gray.empty()) return;
  OtherCamera& other = others_[camera - 1];
  const bool is_repeated =
      AreSame(image.gray, other.last.gray) && !AreSame((*images)[0].gray, other.last_of_first.gray);
  other.last_of_first = (*images)[0];
  other.last = image;
  if (!is_repeated) return;
  counts_.others[camera - 1].repeated.Add("the camera is frozen while camera 0 moves");
  image = {};
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
  ready.images.resize(sensor_.cameras.size());
  ready.images[0] = std::move(images_.front().image);
  const int64_t t_ns = ready.images[0].t_ns;
  ready.restart = images_.front().restart;
  images_.pop_front();
  if (ready.restart) {
    rate_limiter_.Reset();
    handed_out_ns_.reset();
  }
  gyro_is_in_time_ = gyro_.Covers(t_ns);
  if (handed_out_ns_ && uses_gyro_) {
    ready.R_now_then = gyro_.Rotation(*handed_out_ns_, t_ns);
    if (!ready.R_now_then) ++counts_.without_gyro;
  }
  ready.publish = rate_limiter_.Take(t_ns);
  TakeOthers(&ready);
  handed_out_ns_ = t_ns;
  return ready;
}

}  // namespace plm_vins
