// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/landmark_matching.h"

#include <algorithm>
#include <map>

namespace plm_vins {
namespace {

constexpr int kFar = kDescriptorBits + 1;

int Distance(const Descriptor& descriptor, const DescribedLandmark& landmark) {
  int distance = kFar;
  for (const Descriptor& other : landmark.descriptors) {
    distance = std::min(distance, HammingDistance(descriptor, other));
  }
  return distance;
}

// The nearest of several, and how near the next one comes.
struct Nearest {
  size_t index = 0;
  int distance = kFar;
  int next_distance = kFar;

  void Offer(size_t candidate, int candidate_distance) {
    if (candidate_distance < distance) {
      next_distance = distance;
      distance = candidate_distance;
      index = candidate;
    } else {
      next_distance = std::min(next_distance, candidate_distance);
    }
  }
};

}  // namespace

std::vector<DescribedLandmark> MergeLandmarks(const std::vector<const Keyframe*>& island) {
  std::map<int64_t, DescribedLandmark> by_track;
  for (const Keyframe* keyframe : island) {
    for (const DescribedCorner& corner : keyframe->corners) {
      if (!corner.p_O) continue;
      DescribedLandmark& landmark = by_track[corner.track];
      landmark.p_O = corner.p_O->cast<double>();
      landmark.descriptors.push_back(corner.descriptor);
    }
  }
  std::vector<DescribedLandmark> landmarks;
  for (auto& [track, landmark] : by_track) landmarks.push_back(std::move(landmark));
  return landmarks;
}

std::vector<LandmarkMatch> MatchLandmarks(const MatchingOptions& options,
                                          const std::vector<DescribedCorner>& corners,
                                          const std::vector<DescribedLandmark>& landmarks) {
  std::vector<Nearest> of_corner(corners.size());
  std::vector<Nearest> of_landmark(landmarks.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = 0; j < landmarks.size(); ++j) {
      const int distance = Distance(corners[i].descriptor, landmarks[j]);
      of_corner[i].Offer(j, distance);
      of_landmark[j].Offer(i, distance);
    }
  }
  std::vector<LandmarkMatch> matches;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Nearest& nearest = of_corner[i];
    if (nearest.distance > options.max_distance) continue;
    if (nearest.distance > options.max_ratio * nearest.next_distance) continue;
    if (of_landmark[nearest.index].index == i) matches.push_back({i, nearest.index});
  }
  return matches;
}

}  // namespace plm_vins
