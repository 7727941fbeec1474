// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/retrieval/corner_index.h"

namespace plm_vins {

struct PlaceRecognitionOptions {
  CornerIndexOptions index;
  double min_time = 15;           // age of an image that counts as another visit [s]
  int island_radius = 3;          // neighboring keyframes on each side that show the same place
  int max_islands = 3;            // candidates for each image
  double min_score_share = 0.05;  // relative to the score of the preceding image
  int memory = 2;                 // preceding images, one of which must have led to the same island
};

// An island (keyframes adjacent in time) that is similar to the newest image.
struct PlaceCandidate {
  int keyframe = -1;       // number of the most similar keyframe
  double score_share = 0;  // relative to the score of the preceding image
  bool similar = false;    // `score_share` reaches the minimum
  bool repeated = false;   // a preceding image led to the same island
};

// Proposes keyframes of earlier visits that may show the same place as the newest one.
class PlaceRecognition {
 public:
  explicit PlaceRecognition(const PlaceRecognitionOptions& options);

  // Adds a keyframe, which must be keyframes[number] in each following Find().
  void Add(const Keyframe& keyframe, int number);

  void Remove(const Keyframe& keyframe, int number);

  // Returns candidates for the newest keyframe, best first. The keyframe must have been added.
  std::vector<PlaceCandidate> Find(const std::vector<Keyframe>& keyframes);

 private:
  bool IsRepeated(const Keyframe& candidate, int number,
                  const std::vector<Keyframe>& keyframes) const;

  PlaceRecognitionOptions options_;
  CornerIndex index_;
  std::deque<std::vector<int>> recent_;  // candidates of the preceding images, newest last
};

}  // namespace plm_vins
