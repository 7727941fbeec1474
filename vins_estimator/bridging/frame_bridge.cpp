// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/bridging/frame_bridge.h"

#include <algorithm>
#include <cmath>

#include "vins_estimator/imu/preintegration.h"
#include "vins_estimator/state/derived_covariance.h"

namespace plm_vins {
namespace {

// Contradictions are noticed after half a second (ContradictionMonitor), and may begin gradually.
constexpr int64_t kTrouble_ns = 1'000'000'000;

constexpr int64_t kMaxDuration_ns = 2'000'000'000;
constexpr double kMaxDeviation = 0.1;  // position uncertainty that the bridge may add [m]

}  // namespace

void FrameBridge::AddTracked(const std::vector<ImuSample>& samples, const FrameState& state,
                             const std::optional<Matrix15d>& covariance) {
  images_.push_back({samples, state, covariance});
  const int64_t last_believed_ns = state.t_ns - kTrouble_ns;
  while (images_.size() > 1 && images_[1].state.t_ns <= last_believed_ns) images_.pop_front();
}

bool FrameBridge::Begin(const std::string& why) {
  if (images_.empty()) return false;
  const Image& start = images_.front();
  const int64_t trouble_ns = images_.back().state.t_ns - start.state.t_ns;
  if (trouble_ns < kTrouble_ns || !start.covariance) return false;
  for (size_t i = 1; i < images_.size(); ++i) Cross(images_[i - 1], &images_[i]);
  why_ = why;
  begun_ = IsCertain(start, images_.back());
  return begun_;
}

void FrameBridge::AddLost(const std::vector<ImuSample>& samples, int64_t t_ns) {
  if (!begun_ || ended_) return;
  Image next{samples, images_.back().state};
  next.state.t_ns = t_ns;
  Cross(images_.back(), &next);
  ended_ = !IsCertain(images_.front(), next);
  if (!ended_) images_.push_back(next);
}

bool FrameBridge::IsCertain(const Image& start, const Image& end) {
  const auto variance = [&start](const Image& image) {
    return PositionVarianceFrom(start.state.position(), image.state,
                                image.covariance->topLeftCorner<6, 6>());
  };
  return end.state.t_ns - start.state.t_ns <= kMaxDuration_ns &&
         variance(end) - variance(start) <= kMaxDeviation * kMaxDeviation;
}

void FrameBridge::Cross(const Image& from, Image* to) const {
  const int64_t t_ns = to->state.t_ns;
  Preintegration motion(noise_, from.state.bias());
  for (const ImuSample& sample : to->samples) motion.Append(sample);
  const UncertainState there = Propagate({from.state, from.covariance.value()}, motion, gravity_W_);
  to->state = there.state;
  to->state.t_ns = t_ns;
  to->covariance = there.covariance;
}

void FrameBridge::Clear() {
  images_.clear();
  begun_ = ended_ = false;
}

bool FrameBridge::CanConnect(std::optional<int64_t> begin_ns) const {
  return !ended_ || (begin_ns && At(*begin_ns));
}

std::optional<UncertainState> FrameBridge::At(int64_t t_ns) const {
  const auto image = std::find_if(images_.begin(), images_.end(), [t_ns](const Image& candidate) {
    return candidate.state.t_ns == t_ns;
  });
  if (image == images_.end() || !image->covariance) return std::nullopt;
  return UncertainState{image->state, *image->covariance};
}

}  // namespace plm_vins
