// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/feature_door.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

namespace plm_vins {
namespace {

// Joins the observations of camera 1 to those of camera 0 with the same id.
template <typename Observation, typename Join>
void JoinSecondCamera(std::vector<Observation>* observations, const Join& join) {
  std::unordered_map<int64_t, Observation*> by_id;
  for (Observation& observation : *observations) {
    if (observation.camera == 0) by_id.emplace(observation.id, &observation);
    const auto first = by_id.find(observation.id);
    if (observation.camera == 1 && first != by_id.end()) join(observation, first->second);
  }
  observations->erase(std::remove_if(observations->begin(), observations->end(),
                                     [](const auto& o) { return o.camera > 0; }),
                      observations->end());
}

}  // namespace

FeatureDoor::FeatureDoor(const SensorConfig& sensor)
    : cameras_(static_cast<int>(sensor.cameras.size())), has_depth_(sensor.depth.has_value()) {}

void FeatureDoor::Admit(PointFrame* frame) {
  RemoveOtherCameras(&frame->points);
  for (PointObservation& point : frame->points) {
    if (!point.depth || has_depth_) continue;
    point.depth.reset();
    depths_.Add("the configuration has no depth_topic, but the tracker's has");
  }
  JoinSecondCamera(&frame->points, [](const PointObservation& second, PointObservation* first) {
    first->right = second.xy;
  });
}

void FeatureDoor::Admit(LineFrame* frame) {
  RemoveOtherCameras(&frame->lines);
  JoinSecondCamera(&frame->lines, [](const LineObservation& second, LineObservation* first) {
    first->right = RightSegment{second.start, second.end, second.deviation};
  });
}

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
