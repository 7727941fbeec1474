// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/keyframes/keyframe_assembly.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace plm_vins {
namespace {

// The estimator decides within these images whether an image is a keyframe: three seconds at 20 Hz.
// More images are kept at higher rates, up to 100 MB of small images.
constexpr size_t kFewStamps = 60;
constexpr size_t kMaxStamps = 300;
constexpr int64_t kMaxAge_ns = 2'000'000'000;

}  // namespace

bool KeyframeAssembly::HasTooMany() const {
  const int64_t age_ns = parts_.rbegin()->first - parts_.begin()->first;
  return parts_.size() > kMaxStamps || (parts_.size() > kFewStamps && age_ns > kMaxAge_ns);
}

KeyframeAssembly::Parts& KeyframeAssembly::PartsAt(int64_t t_ns) {
  const auto [parts, is_new] = parts_.try_emplace(t_ns);
  parts->second.frame.t_ns = t_ns;
  while (is_new && HasTooMany()) {
    const auto oldest = parts == parts_.begin() ? std::next(parts) : parts_.begin();
    Forget(oldest, std::next(oldest));
  }
  return parts->second;
}

KeyframeAssembly::Stamps::iterator KeyframeAssembly::Forget(Stamps::iterator begin,
                                                            Stamps::iterator end) {
  without_image_ +=
      std::count_if(begin, end, [](const auto& entry) { return entry.second.LacksImage(); });
  return parts_.erase(begin, end);
}

void KeyframeAssembly::AddImage(int camera, const ImageSample& image) {
  if (camera == 0) return AddImageOfFirst(image);
  std::deque<ImageSample>& images = further_images_[camera];
  if (!images.empty() && image.t_ns <= images.back().t_ns) images.clear();
  images.push_back(image);
  const auto is_old = [&](const ImageSample& other) {
    return images.size() > kMaxStamps ||
           (images.size() > kFewStamps && image.t_ns - other.t_ns > kMaxAge_ns);
  };
  while (is_old(images.front())) images.pop_front();
}

void KeyframeAssembly::AddImageOfFirst(const ImageSample& image) {
  const StampVerdict verdict = image_order_.Add(image.t_ns);
  if (verdict == StampVerdict::kIsAhead) return;
  if (verdict == StampVerdict::kRestarts) parts_.clear();
  Parts& parts = PartsAt(image.t_ns);
  parts.frame.images[0] = {image.gray, image.owner};
}

void KeyframeAssembly::AddPose(int64_t t_ns, const Rigid3d& T_O_B,
                               const Eigen::Matrix<double, 6, 6>& covariance) {
  Parts& parts = PartsAt(t_ns);
  parts.frame.T_O_B = T_O_B;
  parts.frame.covariance = covariance;
  parts.has_pose = true;
}

void KeyframeAssembly::AddCorners(int64_t t_ns, std::vector<TrackedCorner> corners) {
  Parts& parts = PartsAt(t_ns);
  parts.frame.corners = std::move(corners);
  parts.has_corners = true;
}

void KeyframeAssembly::AddSegments(int64_t t_ns, std::vector<TrackedSegment> segments) {
  Parts& parts = PartsAt(t_ns);
  parts.frame.segments = std::move(segments);
  parts.has_segments = true;
}

std::optional<OdometryFrame> KeyframeAssembly::Pop() {
  auto first = parts_.end();
  bool next_is_complete = false;
  for (auto it = parts_.begin(); it != parts_.end(); ++it) {
    if (!it->second.AreComplete()) continue;
    next_is_complete = first != parts_.end();
    if (next_is_complete) break;
    first = it;
  }
  if (first == parts_.end() || !(first->second.has_segments || next_is_complete)) {
    return std::nullopt;
  }
  OdometryFrame frame = std::move(first->second.frame);
  parts_.erase(Forget(parts_.begin(), first));
  TakeFurtherImages(&frame);
  return frame;
}

// Drops older images.
void KeyframeAssembly::TakeFurtherImages(OdometryFrame* frame) {
  for (auto& [camera, images] : further_images_) {
    while (!images.empty() && images.front().t_ns < frame->t_ns - tolerance_ns_) images.pop_front();
    if (images.empty() || images.front().t_ns > frame->t_ns + tolerance_ns_) continue;
    frame->images[camera] = {images.front().gray, images.front().owner};
  }
}

void KeyframeAssembly::Clear() {
  parts_.clear();
  further_images_.clear();
  image_order_.Clear();
}

}  // namespace plm_vins
