// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <vector>

#include "pose_graph/keyframes/keyframe.h"
#include "pose_graph/retrieval/corner_index.h"

namespace plm_vins {

struct PlaceRecognitionOptions {
  CornerIndexOptions index;
  double min_time = 15;           // since an image that counts as another visit [s]
  int island_radius = 3;          // keyframes to each side that show the same place
  int max_islands = 3;            // looked at for one image
  double min_score_share = 0.05;  // of the score of the image's predecessor
  int memory = 2;                 // images before, one of which must have led to the same island
};

// An island of keyframes, neighbours in time, that look like an image.
struct PlaceCandidate {
  int keyframe = -1;       // the most similar
  double score_share = 0;  // of the score of the image's own predecessor, with which it shares most
  bool similar = false;    // the share is enough
  bool repeated = false;   // one of the images before led here as well
};

// Names keyframes of earlier visits that may show the same place as the newest, without vocabulary.
class PlaceRecognition {
 public:
  explicit PlaceRecognition(const PlaceRecognitionOptions& options);

  // Takes in a keyframe, which is keyframes[number] in each Find() that follows.
  void Add(const Keyframe& keyframe, int number);

  void Remove(const Keyframe& keyframe, int number);

  // Candidates for the newest keyframe, the best first. It has been added before.
  std::vector<PlaceCandidate> Find(const std::vector<Keyframe>& keyframes);

 private:
  bool IsRepeated(const Keyframe& candidate, int number,
                  const std::vector<Keyframe>& keyframes) const;

  PlaceRecognitionOptions options_;
  CornerIndex index_;
  std::deque<std::vector<int>> recent_;  // candidates of the images before, newest last
};

}  // namespace plm_vins
