// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_verification.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "pose_graph/verification/loop_observations.h"

namespace plm_vins {
namespace {

constexpr int kCellColumns = 4;
constexpr int kCellRows = 3;

// Returns the tracks observed in the island, sorted.
std::vector<int64_t> TracksOf(const Island& island) {
  std::vector<int64_t> tracks;
  for (const Keyframe* keyframe : island.all) {
    for (const DescribedCorner& corner : keyframe->corners) {
      if (corner.track >= 0) tracks.push_back(corner.track);
    }
  }
  std::sort(tracks.begin(), tracks.end());
  tracks.erase(std::unique(tracks.begin(), tracks.end()), tracks.end());
  return tracks;
}

// Returns the tracks observed in both islands, sorted.
std::vector<int64_t> CommonTracks(const Island& earlier, const Island& later) {
  std::vector<int64_t> common;
  if (earlier.keyframe->world != later.keyframe->world) return common;
  const std::vector<int64_t> a = TracksOf(earlier);
  const std::vector<int64_t> b = TracksOf(later);
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return common;
}

// Returns the lines that the camera of an island observes, without duplicates, each from its newest
// keyframe.
std::vector<SpaceSegment> LinesOf(const Island& island) {
  std::map<int64_t, SpaceSegment> by_track;
  for (const Keyframe* keyframe : island.all) {
    for (const TrackedSegment& segment : keyframe->segments) {
      const bool is_seen = segment.observation.camera == island.camera;
      if (is_seen && segment.landmark) by_track[segment.observation.id] = *segment.landmark;
    }
  }
  std::vector<SpaceSegment> lines;
  lines.reserve(by_track.size());
  for (const auto& [track, line] : by_track) lines.push_back(line);
  return lines;
}

SeenPoint ToSeenPoint(const LandmarkMatch& match, const std::vector<DescribedCorner>& corners,
                      const std::vector<DescribedLandmark>& landmarks) {
  const DescribedLandmark& landmark = landmarks[match.landmark];
  return {landmark.p_O, corners[match.corner].xy.cast<double>(), landmark.track};
}

// Result of the guided search around predicted pixels: the number of matches and the inliers among
// them.
struct Search {
  size_t matches = 0;
  std::vector<SeenPoint> inliers;
  std::vector<Eigen::Vector2f> corners_px;  // corners of the inliers

  double share() const {
    return matches > 0 ? static_cast<double>(inliers.size()) / static_cast<double>(matches) : 0.0;
  }
};

Search SearchAroundImages(const LoopVerificationOptions& options,
                          const std::vector<DescribedCorner>& corners,
                          const std::vector<DescribedLandmark>& landmarks,
                          const LevelTransform& T_O_G, const Eigen::Quaterniond& R_G_C) {
  const Viewpoint viewpoint(T_O_G, R_G_C);
  Search search;
  for (const LandmarkMatch& match :
       MatchAroundImages(options.matching, corners, landmarks, T_O_G, R_G_C)) {
    ++search.matches;
    const SeenPoint seen = ToSeenPoint(match, corners, landmarks);
    if (viewpoint.Error(seen) > options.ransac.max_error) continue;
    search.inliers.push_back(seen);
    search.corners_px.push_back(corners[match.corner].uv_px);
  }
  return search;
}

int CountCells(const std::vector<Eigen::Vector2f>& corners_px, const CameraParameters& camera) {
  std::set<int> cells;
  for (const Eigen::Vector2f& uv : corners_px) {
    const int column = static_cast<int>(uv.x() * kCellColumns / camera.width);
    const int row = static_cast<int>(uv.y() * kCellRows / camera.height);
    cells.insert(row * kCellColumns + column);
  }
  return static_cast<int>(cells.size());
}

}  // namespace

// Intermediate results of a candidate between the gates. O1 and O2 are those of LoopObservations.
struct LoopVerification::Evidence {
  // Sorted. These tracks are no evidence for another visit, since odometry has tracked them
  // throughout.
  std::vector<int64_t> common_tracks;
  std::vector<DescribedCorner> corners_of_later;
  std::vector<DescribedLandmark> landmarks_O1;
  LevelTransform T_O1_O2;
  LoopObservations all;
};

LoopVerification::LoopVerification(const LoopVerificationOptions& options, CameraModels cameras)
    : options_(options), cameras_(std::move(cameras)) {}

LoopObservations LoopVerification::Verify(const Island& earlier, const Island& later,
                                          LoopCandidate* candidate) const {
  Evidence evidence;
  evidence.corners_of_later = later.keyframe->CornersIn(later.camera);
  evidence.all.earlier_camera = earlier.camera;
  evidence.all.later_camera = later.camera;
  evidence.all.T_O1_C = earlier.keyframe->T_O_C(earlier.camera);
  evidence.all.T_O2_C = later.keyframe->T_O_C(later.camera);
  const bool accepted =
      AreApart(earlier, later, candidate, &evidence) && FindPose(earlier, candidate, &evidence) &&
      HasInliers(candidate, &evidence) && HoldsBackwards(earlier, later, candidate, &evidence) &&
      Refine(candidate, &evidence) && LinesAgree(earlier, later, candidate, &evidence);
  if (accepted) {
    candidate->T_earlier_later =
        earlier.keyframe->T_O_L().Inverse() * evidence.T_O1_O2 * later.keyframe->T_O_L();
  }
  return evidence.all;
}

bool LoopVerification::AreApart(const Island& earlier, const Island& later,
                                LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kApart;
  evidence->common_tracks = CommonTracks(earlier, later);
  candidate->common_tracks = static_cast<int>(evidence->common_tracks.size());
  return *candidate->common_tracks <= options_.max_common_tracks;
}

bool LoopVerification::FindPose(const Island& earlier, LoopCandidate* candidate,
                                Evidence* evidence) const {
  candidate->failed = LoopGate::kMatches;
  evidence->landmarks_O1 = MergeLandmarks(earlier.all, earlier.camera, evidence->common_tracks);
  const std::vector<DescribedCorner>& corners = evidence->corners_of_later;
  std::vector<SeenPoint> seen;
  for (const LandmarkMatch& match :
       MatchLandmarks(options_.matching, corners, evidence->landmarks_O1)) {
    seen.push_back(ToSeenPoint(match, corners, evidence->landmarks_O1));
  }
  candidate->matches = static_cast<int>(seen.size());
  if (*candidate->matches < options_.min_matches) return false;

  candidate->failed = LoopGate::kPose;
  const Rigid3d& T_O2_C = evidence->all.T_O2_C;
  const auto pose = FindLevelPose(options_.ransac, seen, T_O2_C.rotation);
  candidate->pose_inliers = pose ? static_cast<int>(pose->inliers.size()) : 0;
  if (*candidate->pose_inliers < options_.min_pose_inliers) return false;
  for (const size_t i : pose->inliers) evidence->all.of_earlier.push_back(seen[i]);
  evidence->T_O1_O2 = pose->T_O_G * LevelTransform{0, T_O2_C.translation}.Inverse();
  return Refine(candidate, evidence);
}

bool LoopVerification::HasInliers(LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kInliers;
  const Rigid3d& T_O2_C = evidence->all.T_O2_C;
  const LevelTransform T_O1_G = evidence->T_O1_O2 * LevelTransform{0, T_O2_C.translation};
  Search search = SearchAroundImages(options_, evidence->corners_of_later, evidence->landmarks_O1,
                                     T_O1_G, T_O2_C.rotation);
  candidate->inliers = static_cast<int>(search.inliers.size());
  candidate->inlier_share = search.share();
  if (*candidate->inliers < options_.min_inliers) return false;
  if (search.share() < options_.min_inlier_share) return false;
  evidence->all.of_earlier = std::move(search.inliers);

  candidate->failed = LoopGate::kSpread;
  candidate->cells =
      CountCells(search.corners_px, cameras_[evidence->all.later_camera]->parameters());
  return *candidate->cells >= options_.min_cells;
}

bool LoopVerification::HoldsBackwards(const Island& earlier, const Island& later,
                                      LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kBackwards;
  const Rigid3d& T_O1_C = evidence->all.T_O1_C;
  const LevelTransform T_O2_G = evidence->T_O1_O2.Inverse() * LevelTransform{0, T_O1_C.translation};
  Search search = SearchAroundImages(
      options_, earlier.keyframe->CornersIn(earlier.camera),
      MergeLandmarks(later.all, later.camera, evidence->common_tracks), T_O2_G, T_O1_C.rotation);
  candidate->backward_inliers = static_cast<int>(search.inliers.size());
  candidate->backward_share = search.share();
  evidence->all.of_later = std::move(search.inliers);
  return *candidate->backward_inliers >= options_.min_backward_inliers &&
         *candidate->backward_share >= options_.min_backward_share &&
         *candidate->inliers + *candidate->backward_inliers >= options_.min_inliers_of_both;
}

bool LoopVerification::Refine(LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kRefinement;
  const auto refined = RefineLoop(options_.refinement, evidence->all, evidence->T_O1_O2);
  if (!refined) return false;
  evidence->T_O1_O2 = refined->T_O1_O2;
  candidate->covariance = refined->covariance;
  return true;
}

// Lines refine the pose after the points have determined it.
bool LoopVerification::LinesAgree(const Island& earlier, const Island& later,
                                  LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kLines;
  const Rigid3d T_O1_C = evidence->T_O1_O2.ToRigid() * evidence->all.T_O2_C;
  LineWitnesses witnesses =
      FindWitnesses(options_.witnesses, *cameras_[later.camera], T_O1_C, LinesOf(earlier),
                    later.keyframe->SegmentsIn(later.camera));
  candidate->visible_lines = witnesses.visible;
  candidate->line_share = witnesses.share();
  if (witnesses.visible >= options_.min_visible_lines &&
      witnesses.share() < options_.min_line_share) {
    return false;
  }
  evidence->all.lines = std::move(witnesses.seen);
  if (!evidence->all.lines.empty() && !Refine(candidate, evidence)) return false;
  candidate->failed.reset();
  return true;
}

}  // namespace plm_vins
