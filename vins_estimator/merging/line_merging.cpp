// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_merging.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "vins_estimator/geometry/line_fit.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;

// Returns the greater of the distances between each line's newest segment and the image of the
// other line.
double DistanceInImages(const SlidingWindow& window, const LineLandmark& a, const LineLandmark& b) {
  return std::max(DistanceInImage(window, LineInWorld(a, window), OfHostCamera(b).back()),
                  DistanceInImage(window, LineInWorld(b, window), OfHostCamera(a).back()));
}

// Returns whether two segments of one image overlap along their direction but are farther apart
// than their noise, so that they cannot be one line.
bool AreSideBySide(const SegmentEndPoints& a, const SegmentEndPoints& b, double noise) {
  constexpr double kNoiseFactor = 3.0;
  constexpr double kLeastOverlap = 0.2;  // fraction of the shorter segment
  const Vector2d along = (a.end - a.start).normalized();
  const auto [a_low, a_high] = std::minmax({along.dot(a.start), along.dot(a.end)});
  const auto [b_low, b_high] = std::minmax({along.dot(b.start), along.dot(b.end)});
  const double overlap = std::min(a_high, b_high) - std::max(a_low, b_low);
  if (overlap < kLeastOverlap * std::min(a_high - a_low, b_high - b_low)) return false;
  const Vector2d between = 0.5 * (b.start + b.end) - a.start;
  return std::abs(along.x() * between.y() - along.y() * between.x()) > kNoiseFactor * noise;
}

bool AreSeenSideBySide(const LineLandmark& a, const LineLandmark& b, double noise) {
  auto other = b.observations.begin();
  for (const LineLandmark::Observation& observation : a.observations) {
    while (other != b.observations.end() && *other < observation) ++other;
    if (other == b.observations.end()) return false;
    if (*other == observation && AreSideBySide(observation.segment, other->segment, noise)) {
      return true;
    }
  }
  return false;
}

// Merges the observations of both lines in their order; where one image has both, the longer
// segment is kept.
std::vector<LineLandmark::Observation> JoinObservations(const LineLandmark& a,
                                                        const LineLandmark& b) {
  std::vector<LineLandmark::Observation> joint;
  std::merge(a.observations.begin(), a.observations.end(), b.observations.begin(),
             b.observations.end(), std::back_inserter(joint));
  size_t last = 0;
  for (size_t i = 1; i < joint.size(); ++i) {
    if (!(joint[i] == joint[last])) {
      joint[++last] = joint[i];
    } else if (joint[i].Length() > joint[last].Length()) {
      joint[last] = joint[i];
    }
  }
  joint.resize(last + 1);
  return joint;
}

// Returns the 99.9 % quantile of the chi-square distribution ([Wilson1931]).
double ChiSquareLimit(int degrees_of_freedom) {
  constexpr double kNormalLimit = 3.09;
  const double v = 2.0 / (9.0 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1.0 - v + kNormalLimit * std::sqrt(v), 3);
}

// Fits a line to the observations of a landmark in its host's camera, starting from `line_W`.
// Returns nullopt if that passes through the host, where it has no coordinates.
std::optional<LineFit> Fit(const SlidingWindow& window, double noise, const LineLandmark& landmark,
                           const PluckerLine& line_W) {
  const auto observations = PosedOfHostCamera(landmark, window);
  const PluckerLine initial = observations.front().T_W_C.Inverse() * line_W;
  if (!(initial.moment.norm() > 0 && initial.direction.norm() > 0)) return std::nullopt;
  return FitLine(observations, noise, ToOrthonormal(initial));
}

// Returns the older line with the observations of both, refitted; nullopt if no single line fits
// them, or if it fits significantly worse than two lines do, or if the cameras differ.
std::optional<LineLandmark> Join(const SlidingWindow& window, double noise,
                                 const LineLandmark& older, const LineLandmark& newer) {
  if (older.host().camera != newer.host().camera) return std::nullopt;
  LineLandmark joint = older;
  joint.observations = JoinObservations(older, newer);
  for (const LineLandmark::Observation& observation : newer.anchor_observations) {
    AddAnchorObservation(observation, &joint.anchor_observations);
  }
  const auto joint_fit = Fit(window, noise, joint, LineInWorld(older, window));
  const auto older_fit = Fit(window, noise, older, LineInWorld(older, window));
  const auto newer_fit = Fit(window, noise, newer, LineInWorld(newer, window));
  if (!joint_fit || !older_fit || !newer_fit) return std::nullopt;
  const int degrees_of_freedom =
      2 * static_cast<int>(OfHostCamera(joint).size()) - kLineTangentSize;
  const double rise = joint_fit->cost - older_fit->cost - newer_fit->cost;
  if (degrees_of_freedom <= 0 || joint_fit->cost > ChiSquareLimit(degrees_of_freedom) ||
      rise > ChiSquareLimit(kLineTangentSize)) {
    return std::nullopt;
  }
  joint.coordinates = joint_fit->line;
  if (!ObservedSegment(joint, window)) return std::nullopt;
  return joint;
}

// The landmarks that may be merged, by ascending id, and their observed segments in F.
struct Candidates {
  std::vector<LineLandmark*> landmarks;
  std::vector<SeenLine> seen;
};

Candidates Collect(const Eigen::Quaterniond& R_F_W, double noise, LocalMap* map) {
  Candidates candidates;
  for (auto& [id, landmark] : map->lines.landmarks()) {
    if (!landmark.triangulated) continue;
    const auto seen = See(map->window, R_F_W, noise, landmark);
    if (!seen) continue;
    candidates.landmarks.push_back(&landmark);
    candidates.seen.push_back(*seen);
  }
  return candidates;
}

enum class MergeRejection { kDirection, kDistance, kGap, kSideBySide, kDistanceInImages, kFit };

// Returns the first condition, in space or in the images, that two lines violate; nullopt if they
// meet all.
std::optional<MergeRejection> FindRejection(const SameLineLimits& limits,
                                            const SlidingWindow& window, const LineLandmark& a,
                                            const LineLandmark& b, const LinePairGeometry& pair) {
  switch (FindDifference(limits, pair)) {
    case LineDifference::kDirection:
      return MergeRejection::kDirection;
    case LineDifference::kDistance:
      return MergeRejection::kDistance;
    case LineDifference::kGap:
      return MergeRejection::kGap;
    case LineDifference::kNone:
      break;
  }
  if (AreSeenSideBySide(a, b, limits.noise)) return MergeRejection::kSideBySide;
  if (DistanceInImages(window, a, b) > limits.image_distance) {
    return MergeRejection::kDistanceInImages;
  }
  return std::nullopt;
}

void Count(MergeRejection rejection, LineMergingCounts* counts) {
  counts->other_direction += rejection == MergeRejection::kDirection;
  counts->distant += rejection == MergeRejection::kDistance;
  counts->apart += rejection == MergeRejection::kGap;
  counts->seen_side_by_side += rejection == MergeRejection::kSideBySide;
  counts->distant_in_image += rejection == MergeRejection::kDistanceInImages;
  counts->inconsistent += rejection == MergeRejection::kFit;
}

}  // namespace

MergedLines MergeLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                       LocalMap* map) {
  const SlidingWindow& window = map->window;
  auto [landmarks, seen] = Collect(R_F_W, limits.noise, map);
  MergedLines result;
  LineMergingCounts& counts = result.counts;
  for (const auto& [newer, older] : FindNearPairs(seen, limits.distance)) {
    if (landmarks[newer] == nullptr || landmarks[older] == nullptr) continue;  // merged already
    ++counts.candidates;
    const auto rejection = FindRejection(limits, window, *landmarks[older], *landmarks[newer],
                                         Compare(seen[older], seen[newer]));
    if (rejection) {
      Count(*rejection, &counts);
      continue;
    }
    const auto joint = Join(window, limits.noise, *landmarks[older], *landmarks[newer]);
    if (!joint) {
      Count(MergeRejection::kFit, &counts);
      continue;
    }
    seen[older] = See(window, R_F_W, limits.noise, *joint).value_or(seen[older]);
    result.absorbed.push_back(landmarks[newer]->id);
    map->AbsorbLine(landmarks[newer]->id, *joint);
    landmarks[newer] = nullptr;
    ++counts.merged;
  }
  return result;
}

}  // namespace plm_vins
