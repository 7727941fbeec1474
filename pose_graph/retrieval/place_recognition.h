// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/retrieval/corner_index.h"

namespace plm_vins {

constexpr int kIslandRadius = 3;  // neighboring keyframes on each side that show the same place

// An island (images of one camera, adjacent in time) that is similar to an image of the newest
// keyframe.
struct PlaceCandidate {
  MapImage earlier;        // the most similar image
  int camera = 0;          // of the newest keyframe's image
  double score_share = 0;  // relative to the score of the preceding image
  bool similar = false;    // `score_share` reaches the minimum
  bool repeated = false;   // a preceding keyframe led to the same island
};

// Proposes images of earlier visits that may show the same place as one of the newest keyframe. The
// cameras may differ: one that looks back recognizes what another one saw ahead.
class PlaceRecognition {
 public:
  // Adds a keyframe, which must be keyframes[number] in each following Find().
  void Add(const Keyframe& keyframe, int number);

  void Remove(const Keyframe& keyframe, int number);

  // Returns candidates for each image of the newest keyframe by camera, best first. The keyframe
  // must have been added.
  std::vector<PlaceCandidate> Find(const std::vector<Keyframe>& keyframes);

 private:
  void FindFor(int camera, const std::vector<Keyframe>& keyframes,
               std::vector<PlaceCandidate>* candidates) const;
  bool IsRepeated(const MapImage& candidate, const std::vector<Keyframe>& keyframes) const;

  CornerIndex index_;
  std::deque<std::vector<MapImage>> recent_;  // candidates of the preceding keyframes, newest last
};

}  // namespace plm_vins
