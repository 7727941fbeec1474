// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/map_trajectory.h"

#include <cstddef>
#include <vector>

namespace plm_vins {

Rigid3d PoseInMap(const KeyframeMap& map, const OdometryPose& pose) {
  const std::vector<Keyframe>& keyframes = map.keyframes;
  const Keyframe& before = keyframes[pose.keyframe];
  const LevelTransform T_M_O = map.T_M_O(pose.keyframe);
  const int next = pose.keyframe + 1;
  if (static_cast<size_t>(next) == keyframes.size() || keyframes[next].world != before.world) {
    return T_M_O.ToRigid() * pose.T_O_B;
  }
  const double share = static_cast<double>(pose.t_ns - before.t_ns) /
                       static_cast<double>(keyframes[next].t_ns - before.t_ns);
  // Interpolates between the corrections of both keyframes, in position and in yaw.
  const LevelTransform T_O_L = {0, pose.T_O_B.translation};
  const LevelTransform from = T_M_O * T_O_L;
  const LevelTransform to = map.T_M_O(next) * T_O_L;
  LevelTransform between;
  between.translation = from.translation + share * (to.translation - from.translation);
  between.yaw = from.yaw + share * WrapAngle(to.yaw - from.yaw);
  return {between.rotation() * pose.T_O_B.rotation, between.translation};
}

}  // namespace plm_vins
