// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/odometry_frame.h"
#include "pose_graph/map/keyframe_map.h"
#include "pose_graph/map/map_fix.h"
#include "pose_graph/map/map_thinning.h"
#include "pose_graph/map/place_in_map.h"
#include "pose_graph/retrieval/place_recognition.h"
#include "pose_graph/verification/loop_acceptance.h"
#include "pose_graph/verification/loop_candidate.h"
#include "pose_graph/verification/loop_verification.h"

namespace plm_vins {

// A place recognized in the newest keyframe.
struct RecognizedPlace {
  int earlier = -1;               // number of the earlier visit's keyframe
  LoopObservations observations;  // landmarks and lines observed in both visits
};

// Result of processing one image.
struct LoopClosure {
  bool is_keyframe = false;
  std::vector<LoopCandidate> candidates;    // all that were examined
  std::vector<LoopCandidate> confirmed;     // waited for an agreeing loop before; now judged again
  std::vector<LoopCandidate> reconsidered;  // rejected by the graph before; now accepted
  std::vector<LevelEdge> dropped;           // earlier loops that now contradict the graph
  std::optional<RecognizedPlace> place;     // set if all gates before kGraph were passed
  std::optional<MapFix> fix;                // nullopt while the pose in the map is unknown
};

// Loop closure: recognizes places and corrects odometry drift in a pose graph. The map frame M is
// the world of the first odometry or that of a loaded map. Odometry poses themselves are not
// changed. One call for each image; synchronous and deterministic.
class LoopCloser {
 public:
  // Limits in pixels are those of camera 0.
  explicit LoopCloser(const CameraModels& cameras);

  // Starts from a loaded map. Must be called before the first Add(). Throws std::runtime_error if
  // the map's keyframes have more cameras.
  void SetMap(KeyframeMap map);

  // Processes the next image for which odometry has a pose.
  LoopClosure Add(const OdometryFrame& frame);

  // Processes a complete keyframe, for example one of a saved map.
  LoopClosure Add(Keyframe keyframe);

  const KeyframeMap& map() const { return map_; }

 private:
  bool IsKeyframe(const OdometryFrame& frame) const;
  bool HasKeyframeOf(int world) const;
  void ConnectToPrevious(int number);
  void LookForLoops(LoopClosure* closure);
  LoopCandidate Examine(const PlaceCandidate& place, LoopObservations* observations);
  Island IslandOf(const MapImage& image) const;
  void AddLoops(const std::vector<LoopCandidate*>& loops);
  // Optimizes the graph and marks the new loops that it rejects.
  void Optimize(const std::vector<LoopCandidate*>& loops, LoopClosure* closure);
  // Accepts loops that the graph has rejected so far, if they are consistent with each other and
  // the loops that contradict them are then dropped. Returns whether it did.
  bool Reconsider(const std::vector<LoopCandidate*>& loops, LoopClosure* closure);
  void Thin();
  std::optional<MapFix> Fix() const;

  CameraModels cameras_;
  PlaceRecognition recognition_;
  LoopVerification verification_;
  LoopAcceptance acceptance_;
  MapThinning thinning_{MapThinningOptions()};
  KeyframeMap map_;
  PlaceInMap place_{OdometryNoise()};
  std::vector<LoopCandidate> rejected_;  // the newest loops that the graph rejected
  int world_ = 0;
  double path_ = 0;                                 // distance traveled in this world [m]
  std::optional<Eigen::Vector3d> last_position_O_;  // for path_
};

}  // namespace plm_vins
