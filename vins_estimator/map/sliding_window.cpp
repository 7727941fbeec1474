// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/sliding_window.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace plm_vins {
namespace {

// Returns null if no frame has this time.
template <typename Frames>
auto FindIn(Frames* frames, int64_t t_ns) {
  const auto found = std::find_if(frames->begin(), frames->end(),
                                  [t_ns](const auto& frame) { return frame.state.t_ns == t_ns; });
  return found == frames->end() ? nullptr : &*found;
}

template <typename Frame>
Frame& Found(Frame* frame, int64_t t_ns) {
  if (frame == nullptr) {
    throw std::logic_error("no frame with stamp " + std::to_string(t_ns) + " in the window");
  }
  return *frame;
}

}  // namespace

Rigid3d WindowCamera::T_B_C() const {
  return {Eigen::Quaterniond(Eigen::Map<const Eigen::Quaterniond>(extrinsics.data() + 3)),
          Eigen::Map<const Eigen::Vector3d>(extrinsics.data())};
}

void WindowCamera::SetExtrinsics(const Rigid3d& T_B_C) {
  Eigen::Map<Eigen::Vector3d>(extrinsics.data()) = T_B_C.translation;
  Eigen::Map<Eigen::Quaterniond>(extrinsics.data() + 3) = T_B_C.rotation.normalized();
}

WindowFrame& SlidingWindow::FrameAt(int64_t t_ns) { return Found(FindIn(&frames, t_ns), t_ns); }

AnchorFrame& SlidingWindow::AnchorAt(int64_t t_ns) { return Found(FindIn(&anchors, t_ns), t_ns); }

const FrameState& SlidingWindow::StateAt(int64_t t_ns) const {
  if (const WindowFrame* frame = FindIn(&frames, t_ns)) return frame->state;
  return Found(FindIn(&anchors, t_ns), t_ns).state;
}

FrameState& SlidingWindow::StateAt(int64_t t_ns) {
  return const_cast<FrameState&>(static_cast<const SlidingWindow*>(this)->StateAt(t_ns));
}

void SlidingWindow::SetStillSince(std::optional<int64_t> still_since_ns, double flow) {
  newest().stationary = still_since_ns.has_value();
  newest().flow_at_rest = flow;
  newest().moving_since_ns = second_newest().state.t_ns;
  if (!still_since_ns) return;
  for (size_t i = frames.size() - 1; i > 0; --i) {
    if (frames[i - 1].moving_since_ns < *still_since_ns) return;
    frames[i - 1].stationary = true;
    frames[i - 1].flow_at_rest = std::max(frames[i - 1].flow_at_rest, flow);
  }
}

void SlidingWindow::IgnoreAccelerationSince(int64_t t_ns) {
  constexpr double kAnyAcceleration = 1;  // [m/s^2/sqrt(Hz)]
  for (size_t i = frames.size() - 1; i > 0 && frames[i].state.t_ns > t_ns; --i) {
    ImuNoise noise = frames[i].motion_since_previous->noise();
    if (noise.accel_density >= kAnyAcceleration) continue;
    noise.accel_density = kAnyAcceleration;
    frames[i].motion_since_previous->Reweigh(noise);
  }
}

bool SlidingWindow::HasStationary() const {
  return std::any_of(frames.begin(), frames.end(),
                     [](const WindowFrame& frame) { return frame.stationary; });
}

double SlidingWindow::LongestImuInterval() const {
  int64_t longest_ns = 0;
  for (const WindowFrame& frame : frames) {
    if (!frame.motion_since_previous) continue;
    const std::vector<ImuSample>& samples = frame.motion_since_previous->samples();
    for (size_t i = 1; i < samples.size(); ++i) {
      longest_ns = std::max(longest_ns, samples[i].t_ns - samples[i - 1].t_ns);
    }
  }
  return ToSeconds(longest_ns);
}

void SlidingWindow::RemoveSecondNewest() {
  const WindowFrame& second = second_newest();
  const std::shared_ptr<Preintegration> joined = second.motion_since_previous;
  joined->Join(*newest().motion_since_previous);
  newest().motion_since_previous = joined;
  if (!second.stationary) {
    newest().stationary = false;
    newest().moving_since_ns = second.moving_since_ns;
  }
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
