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

bool IsCertain(const UncertainState& start, const UncertainState& end) {
  const auto variance = [&start](const UncertainState& estimate) {
    return PositionVarianceFrom(start.state.position(), estimate.state,
                                estimate.covariance.topLeftCorner<6, 6>());
  };
  return end.state.t_ns - start.state.t_ns <= kMaxDuration_ns &&
         variance(end) - variance(start) <= kMaxDeviation * kMaxDeviation;
}

}  // namespace

void FrameBridge::AddTracked(const std::vector<ImuSample>& samples, const FrameState& state,
                             const std::optional<Matrix15d>& covariance) {
  const UncertainState estimate{state, covariance.value_or(Matrix15d::Zero())};
  images_.push_back({samples, estimate, covariance.has_value()});
  const int64_t last_believed_ns = state.t_ns - kTrouble_ns;
  while (images_.size() > 1 && images_[1].estimate.state.t_ns <= last_believed_ns) {
    images_.pop_front();
  }
}

bool FrameBridge::Begin(const std::string& why) {
  if (images_.empty()) return false;
  const UncertainState& start = images_.front().estimate;
  const int64_t trouble_ns = images_.back().estimate.state.t_ns - start.state.t_ns;
  if (trouble_ns < kTrouble_ns || !images_.front().is_certain) return false;
  for (size_t i = 1; i < images_.size(); ++i) Cross(images_[i - 1], &images_[i]);
  why_ = why;
  begun_ = IsCertain(start, images_.back().estimate);
  return begun_;
}

void FrameBridge::AddLost(const std::vector<ImuSample>& samples, int64_t t_ns) {
  if (!begun_ || ended_) return;
  UncertainState there = images_.back().estimate;
  there.state.t_ns = t_ns;
  Image next{samples, there};
  Cross(images_.back(), &next);
  ended_ = !IsCertain(images_.front().estimate, next.estimate);
  if (!ended_) images_.push_back(next);
}

void FrameBridge::Cross(const Image& from, Image* to) const {
  const int64_t t_ns = to->estimate.state.t_ns;
  Preintegration motion(noise_, from.estimate.state.bias());
  for (const ImuSample& sample : to->samples) motion.Append(sample);
  to->estimate = Propagate(from.estimate, motion, gravity_W_);
  to->estimate.state.t_ns = t_ns;
}

void FrameBridge::Clear() {
  images_.clear();
  begun_ = ended_ = false;
}

bool FrameBridge::CanConnect(std::optional<int64_t> begin_ns) const {
  return !ended_ || (begin_ns && At(*begin_ns) != nullptr);
}

const UncertainState* FrameBridge::At(int64_t t_ns) const {
  const auto image = std::find_if(images_.begin(), images_.end(), [&](const Image& candidate) {
    return candidate.estimate.state.t_ns == t_ns;
  });
  return image == images_.end() ? nullptr : &image->estimate;
}

}  // namespace plm_vins
