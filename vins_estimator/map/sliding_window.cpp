// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/sliding_window.h"

#include <algorithm>

namespace plm_vins {

void SlidingWindow::SetExtrinsic(const Rigid3d& T_B_C) {
  Eigen::Map<Eigen::Vector3d>(extrinsic.data()) = T_B_C.translation;
  Eigen::Map<Eigen::Quaterniond>(extrinsic.data() + 3) = T_B_C.rotation.normalized();
}

const WindowFrame* SlidingWindow::Find(int64_t t_ns) const {
  const auto found = std::find_if(frames.begin(), frames.end(), [t_ns](const WindowFrame& frame) {
    return frame.state.t_ns == t_ns;
  });
  return found == frames.end() ? nullptr : &*found;
}

WindowFrame* SlidingWindow::Find(int64_t t_ns) {
  return const_cast<WindowFrame*>(static_cast<const SlidingWindow*>(this)->Find(t_ns));
}

const AnchorFrame* SlidingWindow::FindAnchor(int64_t t_ns) const {
  const auto found =
      std::find_if(anchors.begin(), anchors.end(),
                   [t_ns](const AnchorFrame& anchor) { return anchor.state.t_ns == t_ns; });
  return found == anchors.end() ? nullptr : &*found;
}

AnchorFrame* SlidingWindow::FindAnchor(int64_t t_ns) {
  return const_cast<AnchorFrame*>(static_cast<const SlidingWindow*>(this)->FindAnchor(t_ns));
}

const FrameState* SlidingWindow::FindState(int64_t t_ns) const {
  if (const WindowFrame* frame = Find(t_ns)) return &frame->state;
  const AnchorFrame* anchor = FindAnchor(t_ns);
  return anchor ? &anchor->state : nullptr;
}

void SlidingWindow::RemoveSecondNewest() {
  const WindowFrame& second = frames[frames.size() - 2];
  const std::shared_ptr<Preintegration> joined = second.motion_since_previous;
  for (const ImuSample& sample : newest().motion_since_previous->samples()) {
    if (sample.t_ns > joined->samples().back().t_ns) joined->Append(sample);
  }
  newest().motion_since_previous = joined;
  newest().stationary = newest().stationary && second.stationary;
  frames.erase(frames.end() - 2);
}

void SlidingWindow::RemoveOldest() {
  frames.erase(frames.begin());
  frames.front().motion_since_previous = nullptr;
}

void SlidingWindow::TurnOldestIntoAnchor() {
  anchors.push_back({frames.front().state, newest().state.t_ns});
  RemoveOldest();
}

void SlidingWindow::RemoveAnchor(int64_t t_ns) {
  anchors.erase(std::remove_if(anchors.begin(), anchors.end(),
                               [t_ns](const AnchorFrame& a) { return a.state.t_ns == t_ns; }),
                anchors.end());
}

}  // namespace plm_vins
