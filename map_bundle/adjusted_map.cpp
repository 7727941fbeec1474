// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/adjusted_map.h"

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

// Transforms all members of the keyframe that are expressed in the odometry world O.
void Move(const LevelTransform& T_new_old, Keyframe* keyframe) {
  keyframe->T_O_B = T_new_old.ToRigid() * keyframe->T_O_B;
  for (DescribedCorner& corner : keyframe->corners) {
    if (corner.p_O) corner.p_O = (T_new_old * corner.p_O->cast<double>()).cast<float>();
  }
  for (TrackedSegment& segment : keyframe->segments) {
    if (!segment.landmark) continue;
    segment.landmark->start_O = T_new_old * segment.landmark->start_O;
    segment.landmark->end_O = T_new_old * segment.landmark->end_O;
  }
}

void TakeLandmarks(const AdjustedMap& adjusted, const LevelTransform& T_O_M, Keyframe* keyframe) {
  for (DescribedCorner& corner : keyframe->corners) {
    const auto landmark = adjusted.p_M.find({keyframe->world, corner.track});
    if (!corner.p_O || landmark == adjusted.p_M.end()) continue;
    corner.p_O = (T_O_M * landmark->second).cast<float>();
  }
}

}  // namespace

void MoveNodes(const AdjustedMap& adjusted, KeyframeMap* map) {
  for (const auto& [number, T_M_B] : adjusted.T_M_B) {
    const Rigid3d& T_O_B = map->keyframes[number].T_O_B;
    const double yaw = Yaw(T_M_B.rotation * T_O_B.rotation.conjugate());
    map->graph.SetNode(number, {yaw, T_M_B.translation});
  }
}

KeyframeMap RebuiltMap(const AdjustedMap& adjusted, const KeyframeMap& map) {
  KeyframeMap rebuilt = map;
  std::map<int, LevelTransform> worlds;  // T_M_O, one for all keyframes of a world
  for (const int number : map.NumbersInMap()) {
    Keyframe& keyframe = rebuilt.keyframes[number];
    LevelTransform T_M_O = map.T_M_O(number);
    const auto found = adjusted.T_M_B.find(number);
    if (found != adjusted.T_M_B.end()) {
      const LevelTransform former_T_M_O = T_M_O;
      T_M_O = worlds.emplace(keyframe.world, former_T_M_O).first->second;
      Move(T_M_O.Inverse() * former_T_M_O, &keyframe);
      keyframe.T_O_B = T_M_O.Inverse().ToRigid() * found->second;
      keyframe.T_B_C = adjusted.T_B_C;
      rebuilt.graph.SetNode(number, T_M_O * keyframe.T_O_L());
    }
    TakeLandmarks(adjusted, T_M_O.Inverse(), &keyframe);
  }
  rebuilt.graph.TakeNodesAsMeasured();
  return rebuilt;
}

}  // namespace plm_vins
