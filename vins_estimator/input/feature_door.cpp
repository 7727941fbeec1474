// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/feature_door.h"

#include <algorithm>
#include <string>
#include <vector>

namespace plm_vins {

FeatureDoor::FeatureDoor(const SensorConfig& sensor)
    : cameras_(static_cast<int>(sensor.cameras.size())), has_depth_(sensor.depth.has_value()) {}

void FeatureDoor::Admit(PointFrame* frame) {
  RemoveOtherCameras(&frame->points);
  for (PointObservation& point : frame->points) {
    if (!point.depth || has_depth_) continue;
    point.depth.reset();
    depths_.Add("the configuration has no depth_topic, but the tracker's has");
  }
}

void FeatureDoor::Admit(LineFrame* frame) { RemoveOtherCameras(&frame->lines); }

DropCounts FeatureDoor::Drops() const {
  DropCounts drops;
  for (const DropCount& drop : {of_other_cameras_, depths_}) {
    if (drop.count > 0) drops.push_back(drop);
  }
  return drops;
}

template <typename Observation>
void FeatureDoor::RemoveOtherCameras(std::vector<Observation>* observations) {
  const auto is_other = [&](const Observation& o) { return o.camera >= cameras_; };
  const auto end = std::remove_if(observations->begin(), observations->end(), is_other);
  for (auto removed = end; removed != observations->end(); ++removed) {
    of_other_cameras_.Add("the configuration has num_of_cam: " + std::to_string(cameras_) +
                          ", but the tracker's has more");
  }
  observations->erase(end, observations->end());
}

}  // namespace plm_vins
