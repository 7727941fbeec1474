// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/camera/camera_model.h"
#include "pose_graph/description/corner_selection.h"
#include "pose_graph/graph/pose_graph.h"
#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/keyframes/keyframe_policy.h"
#include "pose_graph/keyframes/odometry_frame.h"
#include "pose_graph/keyframes/odometry_noise.h"
#include "pose_graph/map/keyframe_map.h"
#include "pose_graph/map/map_fix.h"
#include "pose_graph/map/map_thinning.h"
#include "pose_graph/map/place_in_map.h"
#include "pose_graph/retrieval/place_recognition.h"
#include "pose_graph/verification/loop_acceptance.h"
#include "pose_graph/verification/loop_candidate.h"
#include "pose_graph/verification/loop_verification.h"

namespace plm_vins {

struct LoopCloserOptions {
  explicit LoopCloserOptions(const CameraModel& camera) : verification(camera.FocalLength()) {}

  KeyframeSpacing spacing;
  // While the place in the map is unknown, to find it soon.
  KeyframeSpacing lost_spacing = {0.1, 5 * M_PI / 180, 0.5};
  CornerSelectionOptions corners;
  OdometryNoise odometry;
  PlaceRecognitionOptions recognition;
  LoopVerificationOptions verification;
  LoopAcceptanceOptions acceptance;
  MapThinningOptions thinning;
};

// A place that the newest keyframe sees again.
struct RecognisedPlace {
  int earlier = -1;         // keyframe of the earlier visit, by number
  LoopSightings sightings;  // of what both visits see
};

// What an image brought.
struct LoopClosure {
  bool is_keyframe = false;
  std::vector<LoopCandidate> candidates;    // that were looked at
  std::vector<LoopCandidate> confirmed;     // that had waited for one that agrees, judged again
  std::vector<LoopCandidate> reconsidered;  // that the graph had refused, accepted by now
  std::vector<LevelEdge> dropped;           // loops of before that the graph contradicts by now
  std::optional<RecognisedPlace> place;     // passed all gates but the graph's
  std::optional<MapFix> fix;                // nothing while the place in the map is unknown
};

// Recognises places and corrects the odometry's drift: the map M is the world of the first odometry
// or that of a map which is loaded; the poses of odometry themselves are never touched. One call
// per image, synchronous and deterministic.
class LoopCloser {
 public:
  LoopCloser(const LoopCloserOptions& options, std::shared_ptr<const CameraModel> camera);

  // Starts in a map of earlier. Before the first Add().
  void SetMap(KeyframeMap map);

  // Takes the next image that odometry has a pose for.
  LoopClosure Add(const OdometryFrame& frame);

  // Takes a keyframe that is made already, as those of a map are.
  LoopClosure Add(Keyframe keyframe);

  const KeyframeMap& map() const { return map_; }

 private:
  bool IsKeyframe(const OdometryFrame& frame) const;
  bool HasKeyframeOf(int world) const;
  void ConnectToPrevious(int number);
  void LookForLoops(LoopClosure* closure);
  LoopCandidate Examine(const PlaceCandidate& place, LoopSightings* sightings);
  Island IslandOf(int number) const;
  void AddLoops(const std::vector<LoopCandidate*>& loops);
  // Says of the new loops which the graph contradicts.
  void Optimize(const std::vector<LoopCandidate*>& loops, LoopClosure* closure);
  // Takes loops that the graph has refused so far, if they are right together and those wrong that
  // contradict them. Says whether it did.
  bool Reconsider(const std::vector<LoopCandidate*>& loops, LoopClosure* closure);
  void Thin();
  std::optional<MapFix> Fix() const;

  LoopCloserOptions options_;
  std::shared_ptr<const CameraModel> camera_;
  PlaceRecognition recognition_;
  LoopVerification verification_;
  LoopAcceptance acceptance_;
  MapThinning thinning_;
  KeyframeMap map_;
  PlaceInMap place_;
  std::vector<LoopCandidate> refused_;  // by the graph; the newest of them
  int world_ = 0;
  double path_ = 0;                                 // in this world [m]
  std::optional<Eigen::Vector3d> last_position_O_;  // for path_
};

}  // namespace plm_vins
