// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/place_in_map.h"

namespace plm_vins {

void PlaceInMap::SetMap(const KeyframeMap& map) {
  covariances_.assign(map.keyframes.size(), Matrix4d::Zero());
}

void PlaceInMap::AddKeyframe(const KeyframeMap& map, bool continues) {
  const Keyframe& keyframe = map.keyframes.back();
  if (continues) {
    covariances_.push_back(CovarianceOf(keyframe, Fix(map)));
  } else {
    covariances_.push_back(keyframe.covariance);
    anchor_ = static_cast<int>(covariances_.size()) - 1;
  }
}

// A loop that is less sure than odometry since the last one tells nothing new.
void PlaceInMap::AddLoop(const KeyframeMap& map, const LevelEdge& loop, bool joins) {
  const MapFix fix = FixBy(
      map, loop.to, CovarianceInMap(map.graph.node(loop.from), covariances_[loop.from], loop));
  const auto position_variance = [](const Matrix4d& covariance) {
    return covariance.topLeftCorner<3, 3>().trace();
  };
  const Keyframe& newest = map.keyframes.back();
  const Matrix4d newest_covariance = CovarianceOf(newest, fix);
  joins = joins && map.keyframes[loop.from].world != newest.world;
  if (!joins && position_variance(newest_covariance) >= position_variance(covariances_.back())) {
    return;
  }
  anchor_ = loop.to;
  covariances_[anchor_] = fix.covariance;
  covariances_.back() = newest_covariance;
  for (size_t i = 0; joins && i < covariances_.size(); ++i) {
    if (map.keyframes[i].world == newest.world) {
      covariances_[i] = CovarianceOf(map.keyframes[i], fix);
    }
  }
}

MapFix PlaceInMap::FixBy(const KeyframeMap& map, int anchor, const Matrix4d& covariance) const {
  const Keyframe& keyframe = map.keyframes[anchor];
  return {map.T_M_O(map.graph.size() - 1), keyframe.T_O_L(), keyframe.covariance, covariance,
          noise_};
}

Matrix4d PlaceInMap::CovarianceOf(const Keyframe& keyframe, const MapFix& fix) const {
  return LevelCovarianceInMap(fix, keyframe.T_O_B.translation, keyframe.covariance);
}

}  // namespace plm_vins
