// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/retrieval/place_recognition.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "common/measurements.h"
#include "pose_graph/keyframes/keyframe.h"

namespace plm_vins {
namespace {

constexpr double kMinTime = 15;          // age of an image that counts as another visit [s]
constexpr size_t kMaxIslands = 3;        // candidates for each image
constexpr double kMinScoreShare = 0.05;  // relative to the score of the preceding image
constexpr size_t kMemory = 2;  // preceding keyframes, one of which must have led to the same island

std::vector<Descriptor> DescriptorsOf(const Keyframe& keyframe, int camera) {
  std::vector<Descriptor> descriptors;
  for (const DescribedCorner& corner : keyframe.corners) {
    if (corner.camera == camera) descriptors.push_back(corner.descriptor);
  }
  return descriptors;
}

// Returns whether the keyframe belongs to another visit: another world, or long enough ago.
bool IsEarlierVisit(const Keyframe& newest, const Keyframe& other) {
  return other.world != newest.world || ToSeconds(newest.t_ns - other.t_ns) >= kMinTime;
}

using Scores = std::map<MapImage, double>;

double ScoreOf(const Scores& scores, const MapImage& image) {
  const auto found = scores.find(image);
  return found == scores.end() ? 0.0 : found->second;
}

// Score of the camera's preceding image, which normalizes the other scores. Without one, as for the
// first image of a world, it is estimated from the image's score with itself.
double ReferenceScore(const Scores& scores, const std::vector<Keyframe>& keyframes, int camera) {
  constexpr double kUsualShare = 0.24;  // typical ratio to the score with itself: median of V1_02
  const int newest = static_cast<int>(keyframes.size()) - 1;
  const bool is_first = newest == 0 || keyframes[newest - 1].world != keyframes[newest].world ||
                        (camera > 0 && scores.count({newest - 1, camera}) == 0);
  return is_first ? kUsualShare * ScoreOf(scores, {newest, camera})
                  : ScoreOf(scores, {newest - 1, camera});
}

double IslandScore(const Scores& scores, const std::vector<Keyframe>& keyframes,
                   const MapImage& image) {
  double sum = 0;
  for (const int i : NumbersAround(keyframes, image.keyframe, kIslandRadius)) {
    sum += ScoreOf(scores, {i, image.camera});
  }
  return sum;
}

}  // namespace

void PlaceRecognition::Add(const Keyframe& keyframe, int number) {
  for (int camera = 0; camera < keyframe.cameras(); ++camera) {
    index_.Add({number, camera}, DescriptorsOf(keyframe, camera));
  }
}

void PlaceRecognition::Remove(const Keyframe& keyframe, int number) {
  for (int camera = 0; camera < keyframe.cameras(); ++camera) {
    index_.Remove({number, camera}, DescriptorsOf(keyframe, camera));
  }
}

std::vector<PlaceCandidate> PlaceRecognition::Find(const std::vector<Keyframe>& keyframes) {
  std::vector<PlaceCandidate> candidates;
  for (int camera = 0; camera < keyframes.back().cameras(); ++camera) {
    FindFor(camera, keyframes, &candidates);
  }
  recent_.emplace_back();
  for (const PlaceCandidate& candidate : candidates) {
    if (candidate.similar) recent_.back().push_back(candidate.earlier);
  }
  if (recent_.size() > kMemory) recent_.pop_front();
  return candidates;
}

void PlaceRecognition::FindFor(int camera, const std::vector<Keyframe>& keyframes,
                               std::vector<PlaceCandidate>* candidates) const {
  const Keyframe& newest = keyframes.back();
  const Scores scores = index_.Scores(DescriptorsOf(newest, camera));
  std::vector<std::pair<double, MapImage>> islands;  // with scores
  for (const auto& [image, score] : scores) {
    if (!IsEarlierVisit(newest, keyframes[image.keyframe])) continue;
    islands.emplace_back(IslandScore(scores, keyframes, image), image);
  }
  std::stable_sort(islands.begin(), islands.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });

  const double reference = ReferenceScore(scores, keyframes, camera);
  std::vector<MapImage> taken;
  for (const auto& [island_score, image] : islands) {
    if (taken.size() == kMaxIslands) break;
    const auto is_same_island = [&, image = image](const MapImage& other) {
      return other.camera == image.camera &&
             std::abs(other.keyframe - image.keyframe) <= 2 * kIslandRadius;
    };
    if (std::any_of(taken.begin(), taken.end(), is_same_island)) continue;
    taken.push_back(image);
    PlaceCandidate& candidate = candidates->emplace_back();
    candidate.earlier = image;
    candidate.camera = camera;
    candidate.score_share = reference > 0 ? ScoreOf(scores, image) / reference : 0;
    candidate.similar = candidate.score_share >= kMinScoreShare;
    candidate.repeated = IsRepeated(image, keyframes);
  }
}

// Islands are compared by time only: while the body turns, another camera sees the place.
bool PlaceRecognition::IsRepeated(const MapImage& candidate,
                                  const std::vector<Keyframe>& keyframes) const {
  const int world = keyframes[candidate.keyframe].world;
  for (const std::vector<MapImage>& before : recent_) {
    for (const MapImage& other : before) {
      if (keyframes[other.keyframe].world == world &&
          std::abs(other.keyframe - candidate.keyframe) <= 2 * kIslandRadius) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace plm_vins
