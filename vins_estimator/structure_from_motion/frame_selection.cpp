// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/frame_selection.h"

#include <utility>

#include "common/features/common_points.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

// Returns the progress of each frame in the sequence, 0 to 1: the mean of its share of the time and
// its share of the image motion.
std::vector<double> Progress(const std::deque<FrameMeasurement>& frames) {
  std::vector<double> flow(frames.size(), 0.0);
  for (size_t i = 1; i < frames.size(); ++i) {
    flow[i] = flow[i - 1] + MedianFlow(frames[i - 1].points, frames[i].points);
  }
  const double duration = ToSeconds(frames.back().t_ns - frames.front().t_ns);
  std::vector<double> progress(frames.size());
  for (size_t i = 0; i < frames.size(); ++i) {
    const double time = ToSeconds(frames[i].t_ns - frames.front().t_ns) / duration;
    progress[i] = flow.back() > 0 ? 0.5 * (time + flow[i] / flow.back()) : time;
  }
  return progress;
}

}  // namespace

int CountCommonPoints(const PointFrame& first, const PointFrame& second) {
  return static_cast<int>(CommonPointsOfOneCamera(first, second).size());
}

double MedianFlow(const PointFrame& first, const PointFrame& second) {
  std::vector<double> ways;
  for (const CommonPoint& point : CommonPointsOfOneCamera(first, second)) {
    ways.push_back((point.second->xy - point.first->xy).norm());
  }
  return Median(std::move(ways));
}

std::vector<size_t> SelectFrames(const std::deque<FrameMeasurement>& frames, size_t max_frames) {
  std::vector<size_t> selected = {0};
  const std::vector<double> progress = Progress(frames);
  for (size_t k = 1; k < max_frames; ++k) {
    const double target = static_cast<double>(k) / static_cast<double>(max_frames - 1);
    // Finds the first frame at the target, up to rounding.
    size_t i = selected.back() + 1;
    while (i + 1 < frames.size() && progress[i] < target - 1e-9) ++i;
    if (i < frames.size()) selected.push_back(i);
  }
  if (selected.back() + 1 != frames.size()) selected.back() = frames.size() - 1;
  return selected;
}

std::vector<FrameMeasurement> JoinFrames(const std::deque<FrameMeasurement>& frames,
                                         const std::vector<size_t>& indices) {
  std::vector<FrameMeasurement> joined;
  size_t next = indices.front();
  for (const size_t index : indices) {
    std::vector<ImuSample> imu;
    for (; next <= index; ++next) JoinImu(frames[next].imu, &imu);
    joined.push_back(frames[index]);
    joined.back().imu = std::move(imu);
  }
  return joined;
}

}  // namespace plm_vins
