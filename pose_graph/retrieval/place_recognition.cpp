// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/retrieval/place_recognition.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "common/measurements.h"
#include "pose_graph/keyframes/keyframe_neighbors.h"

namespace plm_vins {
namespace {

std::vector<Descriptor> DescriptorsOf(const Keyframe& keyframe) {
  std::vector<Descriptor> descriptors;
  for (const DescribedCorner& corner : keyframe.corners) descriptors.push_back(corner.descriptor);
  return descriptors;
}

// Returns whether the keyframe belongs to another visit: another world, or long enough ago.
bool IsEarlierVisit(const Keyframe& newest, const Keyframe& other, double min_time) {
  return other.world != newest.world || ToSeconds(newest.t_ns - other.t_ns) >= min_time;
}

double ScoreOf(const std::map<int, double>& scores, int number) {
  const auto found = scores.find(number);
  return found == scores.end() ? 0.0 : found->second;
}

// Score of the preceding image, which normalizes the other scores. For the first image of a world
// it is estimated from the image's score with itself.
double ReferenceScore(const std::map<int, double>& scores, const std::vector<Keyframe>& keyframes) {
  constexpr double kUsualShare = 0.24;  // typical ratio to the score with itself: median of V1_02
  const int newest = static_cast<int>(keyframes.size()) - 1;
  const bool is_first = newest == 0 || keyframes[newest - 1].world != keyframes[newest].world;
  return is_first ? kUsualShare * ScoreOf(scores, newest) : ScoreOf(scores, newest - 1);
}

double IslandScore(const std::map<int, double>& scores, const std::vector<Keyframe>& keyframes,
                   int number, int radius) {
  double sum = 0;
  for (const int i : NumbersAround(keyframes, number, radius)) sum += ScoreOf(scores, i);
  return sum;
}

}  // namespace

PlaceRecognition::PlaceRecognition(const PlaceRecognitionOptions& options)
    : options_(options), index_(options.index) {}

void PlaceRecognition::Add(const Keyframe& keyframe, int number) {
  index_.Add(number, DescriptorsOf(keyframe));
}

void PlaceRecognition::Remove(const Keyframe& keyframe, int number) {
  index_.Remove(number, DescriptorsOf(keyframe));
}

std::vector<PlaceCandidate> PlaceRecognition::Find(const std::vector<Keyframe>& keyframes) {
  const int newest = static_cast<int>(keyframes.size()) - 1;
  const std::map<int, double> scores = index_.Scores(DescriptorsOf(keyframes[newest]));
  std::vector<std::pair<double, int>> islands;  // score, keyframe number
  for (const auto& [number, score] : scores) {
    if (!IsEarlierVisit(keyframes[newest], keyframes[number], options_.min_time)) continue;
    islands.emplace_back(IslandScore(scores, keyframes, number, options_.island_radius), number);
  }
  std::stable_sort(islands.begin(), islands.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });

  const double reference = ReferenceScore(scores, keyframes);
  std::vector<PlaceCandidate> candidates;
  for (const auto& [island_score, number] : islands) {
    if (static_cast<int>(candidates.size()) == options_.max_islands) break;
    const bool taken = std::any_of(
        candidates.begin(), candidates.end(), [&, number = number](const PlaceCandidate& other) {
          return std::abs(other.keyframe - number) <= 2 * options_.island_radius;
        });
    if (taken) continue;
    PlaceCandidate candidate;
    candidate.keyframe = number;
    candidate.score_share = reference > 0 ? ScoreOf(scores, number) / reference : 0;
    candidate.similar = candidate.score_share >= options_.min_score_share;
    candidate.repeated = IsRepeated(keyframes[number], number, keyframes);
    candidates.push_back(candidate);
  }
  recent_.emplace_back();
  for (const PlaceCandidate& candidate : candidates) {
    if (candidate.similar) recent_.back().push_back(candidate.keyframe);
  }
  if (static_cast<int>(recent_.size()) > options_.memory) recent_.pop_front();
  return candidates;
}

bool PlaceRecognition::IsRepeated(const Keyframe& candidate, int number,
                                  const std::vector<Keyframe>& keyframes) const {
  for (const std::vector<int>& before : recent_) {
    for (const int other : before) {
      if (keyframes[other].world == candidate.world &&
          std::abs(other - number) <= 2 * options_.island_radius) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace plm_vins
