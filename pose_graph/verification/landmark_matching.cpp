// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/landmark_matching.h"

#include <algorithm>

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

// The nearest candidate and the distance of the second nearest, for the ratio test.
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

// Nearest landmark of each corner, and nearest corner of each landmark.
class NearestTable {
 public:
  NearestTable(size_t corners, size_t landmarks) : of_corner_(corners), of_landmark_(landmarks) {}

  void Offer(size_t corner, size_t landmark, int distance) {
    of_corner_[corner].Offer(landmark, distance);
    of_landmark_[landmark].Offer(corner, distance);
  }

  std::vector<LandmarkMatch> Matches(const MatchingOptions& options) const {
    std::vector<LandmarkMatch> matches;
    for (size_t i = 0; i < of_corner_.size(); ++i) {
      const Nearest& nearest = of_corner_[i];
      if (nearest.distance > options.max_distance) continue;
      if (nearest.distance > options.max_ratio * nearest.next_distance) continue;
      if (of_landmark_[nearest.index].index == i) matches.push_back({i, nearest.index});
    }
    return matches;
  }

 private:
  std::vector<Nearest> of_corner_;
  std::vector<Nearest> of_landmark_;
};

}  // namespace

std::vector<DescribedLandmark> MergeLandmarks(const std::vector<const Keyframe*>& island,
                                              int camera, const std::vector<int64_t>& without) {
  std::vector<const DescribedCorner*> views;
  for (const Keyframe* keyframe : island) {
    for (const DescribedCorner& corner : keyframe->corners) {
      if (corner.camera != camera) continue;
      const bool is_left_out = std::binary_search(without.begin(), without.end(), corner.track);
      if (corner.p_O && !is_left_out) views.push_back(&corner);
    }
  }
  std::stable_sort(
      views.begin(), views.end(),
      [](const DescribedCorner* a, const DescribedCorner* b) { return a->track < b->track; });
  std::vector<DescribedLandmark> landmarks;
  for (size_t i = 0; i < views.size(); ++i) {
    if (i == 0 || views[i]->track != views[i - 1]->track) landmarks.emplace_back();
    landmarks.back().track = views[i]->track;
    landmarks.back().p_O = views[i]->p_O->cast<double>();
    landmarks.back().descriptors.push_back(views[i]->descriptor);
  }
  return landmarks;
}

PLM_COUNTS_BITS
std::vector<LandmarkMatch> MatchLandmarks(const MatchingOptions& options,
                                          const std::vector<DescribedCorner>& corners,
                                          const std::vector<DescribedLandmark>& landmarks) {
  NearestTable nearest(corners.size(), landmarks.size());
  for (size_t j = 0; j < landmarks.size(); ++j) {
    for (size_t i = 0; i < corners.size(); ++i) {
      nearest.Offer(i, j, Distance(corners[i].descriptor, landmarks[j]));
    }
  }
  return nearest.Matches(options);
}

PLM_COUNTS_BITS
std::vector<LandmarkMatch> MatchAroundImages(const MatchingOptions& options,
                                             const std::vector<DescribedCorner>& corners,
                                             const std::vector<DescribedLandmark>& landmarks,
                                             const LevelTransform& T_O_G,
                                             const Eigen::Quaterniond& R_G_C) {
  const LevelTransform T_G_O = T_O_G.Inverse();
  const auto radius = static_cast<float>(options.search_radius);
  NearestTable nearest(corners.size(), landmarks.size());
  for (size_t j = 0; j < landmarks.size(); ++j) {
    const Eigen::Vector3d p_C = R_G_C.conjugate() * (T_G_O * landmarks[j].p_O);
    if (p_C.z() <= 0) continue;
    const Eigen::Vector2f image = p_C.hnormalized().cast<float>();
    for (size_t i = 0; i < corners.size(); ++i) {
      if ((corners[i].xy - image).squaredNorm() > radius * radius) continue;
      nearest.Offer(i, j, Distance(corners[i].descriptor, landmarks[j]));
    }
  }
  return nearest.Matches(options);
}

}  // namespace plm_vins
