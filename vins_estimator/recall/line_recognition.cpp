// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/recall/line_recognition.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace plm_vins {
namespace {

SeenLine Rotated(const Eigen::Quaterniond& R_F_W, const SeenLine& line_W) {
  SeenLine line_F = line_W;
  line_F.start_F = R_F_W * line_W.start_F;
  line_F.end_F = R_F_W * line_W.end_F;
  return line_F;
}

// Returns whether two lines could be close: whether their bounding spheres touch.
bool MayTouch(const SeenLine& a, const SeenLine& b, double distance) {
  const double between = (a.start_F + a.end_F - b.start_F - b.end_F).norm();  // doubled
  const double lengths = (a.end_F - a.start_F).norm() + (b.end_F - b.start_F).norm();
  return between < lengths + 2 * (distance + kLineDeviations * (a.place_sigma + b.place_sigma));
}

// Largest distance of a landmark's observations from the projection of another line.
double DistanceInImages(const SlidingWindow& window, const PluckerLine& line_W,
                        const std::vector<LineLandmark::Observation>& observations) {
  double farthest = 0;
  for (const LineLandmark::Observation& observation : observations) {
    farthest = std::max(farthest, DistanceInImage(window, line_W, observation));
  }
  return farthest;
}

// Returns the id of the remembered line that a landmark matches, the nearest if there are several.
// All observations of the landmark must agree with it, since images are more precise than a first
// triangulation.
std::optional<int64_t> Recognize(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                                 const LocalMap& map, const LineLandmark& landmark,
                                 const SeenLine& seen_F) {
  const SeenLine seen_W = Rotated(R_F_W.conjugate(), seen_F);
  std::optional<int64_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, line] : map.memory.lines()) {
    if (id > landmark.id) break;
    if (!MayTouch(line.seen_W, seen_W, limits.distance) || map.lines.landmarks().count(id))
      continue;
    const LinePairGeometry pair = Compare(Rotated(R_F_W, line.seen_W), seen_F);
    if (pair.distance >= least || FindDifference(limits, pair) != LineDifference::kNone) continue;
    const PluckerLine line_W = LineThrough(line.seen_W.start_F, line.seen_W.end_F);
    if (DistanceInImages(map.window, line_W, OfHostCamera(landmark)) > limits.image_distance)
      continue;
    nearest = id;
    least = pair.distance;
  }
  return nearest;
}

// Returns the ids of the landmarks to search for in the memory, ascending: those with enough
// observations that are not in the memory.
std::vector<int64_t> CollectCandidates(const LocalMap& map) {
  std::vector<int64_t> candidates;
  for (const auto& [id, landmark] : map.lines.landmarks()) {
    const bool is_known = map.memory.Find(id) != nullptr;
    if (landmark.triangulated && HasEnoughObservations(landmark) && !is_known)
      candidates.push_back(id);
  }
  return candidates;
}

}  // namespace

std::vector<int64_t> RecognizeLines(const SameLineLimits& limits, const Eigen::Quaterniond& R_F_W,
                                    LocalMap* map) {
  std::vector<int64_t> recognized;
  for (const int64_t id : CollectCandidates(*map)) {
    const LineLandmark& landmark = map->lines.landmarks().at(id);
    const auto seen_F = See(map->window, R_F_W, limits.noise, landmark);
    if (!seen_F) continue;
    const auto older = Recognize(limits, R_F_W, *map, landmark, *seen_F);
    if (!older) continue;
    map->ReviveLine(id, *older);
    recognized.push_back(id);
  }
  return recognized;
}

}  // namespace plm_vins
