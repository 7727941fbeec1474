// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_verification.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/so3.h"

namespace plm_vins {
namespace {

constexpr int kCellColumns = 4;
constexpr int kCellRows = 3;

std::set<int64_t> TracksOf(const Island& island) {
  std::set<int64_t> tracks;
  for (const Keyframe* keyframe : island.all) {
    for (const DescribedCorner& corner : keyframe->corners) {
      if (corner.track >= 0) tracks.insert(corner.track);
    }
  }
  return tracks;
}

// The lines of an island, each once, as its newest keyframe has them.
std::vector<LineEnds> LinesOf(const Island& island) {
  std::map<int64_t, LineEnds> by_track;
  for (const Keyframe* keyframe : island.all) {
    for (const TrackedSegment& segment : keyframe->segments) {
      if (segment.landmark) by_track[segment.observation.id] = *segment.landmark;
    }
  }
  std::vector<LineEnds> lines;
  for (const auto& [track, line] : by_track) lines.push_back(line);
  return lines;
}

std::vector<PointSighting> ToSightings(const std::vector<LandmarkMatch>& matches,
                                       const std::vector<DescribedCorner>& corners,
                                       const std::vector<DescribedLandmark>& landmarks) {
  std::vector<PointSighting> sightings;
  for (const LandmarkMatch& match : matches) {
    sightings.push_back({landmarks[match.landmark].p_O, corners[match.corner].xy.cast<double>()});
  }
  return sightings;
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

// What is known of a candidate on its way through the gates. A and B as in LoopSightings.
struct LoopVerification::Evidence {
  std::vector<LandmarkMatch> matches;       // of the later image with the earlier landmarks
  std::vector<PointSighting> sightings;     // one for each match
  std::vector<size_t> inliers;              // of them
  std::vector<Eigen::Vector2f> corners_px;  // of the inliers
  LevelTransform T_A_B;
  LoopSightings all;
};

LoopVerification::LoopVerification(const LoopVerificationOptions& options,
                                   std::shared_ptr<const CameraModel> camera)
    : options_(options), camera_(std::move(camera)) {}

std::vector<Eigen::Vector2f> LoopVerification::Verify(const Island& earlier, const Island& later,
                                                      LoopCandidate* candidate) const {
  Evidence evidence;
  evidence.all.T_A_C = earlier.keyframe->T_O_C();
  evidence.all.T_B_C = later.keyframe->T_O_C();
  const bool accepted = AreApart(earlier, later, candidate) &&
                        FindPose(earlier, *later.keyframe, candidate, &evidence) &&
                        ManhattanAgrees(*earlier.keyframe, *later.keyframe, candidate, evidence) &&
                        HasInliers(*later.keyframe, candidate, &evidence) &&
                        HoldsBackwards(*earlier.keyframe, later, candidate, &evidence) &&
                        Refine(candidate, &evidence) &&
                        LinesAgree(earlier, *later.keyframe, candidate, &evidence);
  if (!accepted) return {};
  candidate->T_earlier_later =
      earlier.keyframe->T_O_L().Inverse() * evidence.T_A_B * later.keyframe->T_O_L();
  return evidence.corners_px;
}

bool LoopVerification::AreApart(const Island& earlier, const Island& later,
                                LoopCandidate* candidate) const {
  candidate->failed = LoopGate::kApart;
  candidate->common_tracks = 0;
  if (earlier.keyframe->world == later.keyframe->world) {
    const std::set<int64_t> tracks = TracksOf(earlier);
    for (const int64_t track : TracksOf(later)) {
      if (tracks.count(track) > 0) ++*candidate->common_tracks;
    }
  }
  return candidate->common_tracks == 0;
}

bool LoopVerification::FindPose(const Island& earlier, const Keyframe& later,
                                LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kMatches;
  const std::vector<DescribedLandmark> landmarks = MergeLandmarks(earlier.all);
  evidence->matches = MatchLandmarks(options_.matching, later.corners, landmarks);
  evidence->sightings = ToSightings(evidence->matches, later.corners, landmarks);
  candidate->matches = static_cast<int>(evidence->matches.size());
  if (*candidate->matches < options_.min_matches) return false;

  candidate->failed = LoopGate::kPose;
  const Rigid3d& T_B_C = evidence->all.T_B_C;
  auto pose = FindLevelPose(options_.ransac, evidence->sightings, T_B_C.rotation);
  if (!pose) return false;
  evidence->inliers = std::move(pose->inliers);
  evidence->T_A_B = pose->T_A_G * LevelTransform{0, T_B_C.translation}.Inverse();
  return true;
}

bool LoopVerification::ManhattanAgrees(const Keyframe& earlier, const Keyframe& later,
                                       LoopCandidate* candidate, const Evidence& evidence) const {
  candidate->failed = LoopGate::kManhattan;
  if (!earlier.R_O_M || !later.R_O_M) return true;
  const double turn = evidence.T_A_B.yaw + Yaw(*later.R_O_M) - Yaw(*earlier.R_O_M);
  candidate->manhattan_error = std::remainder(turn, M_PI / 2);
  return std::abs(*candidate->manhattan_error) <= options_.max_manhattan_error;
}

bool LoopVerification::HasInliers(const Keyframe& later, LoopCandidate* candidate,
                                  Evidence* evidence) const {
  candidate->failed = LoopGate::kInliers;
  for (const size_t i : evidence->inliers) {
    evidence->all.of_earlier.push_back(evidence->sightings[i]);
    evidence->corners_px.push_back(later.corners[evidence->matches[i].corner].uv_px);
  }
  candidate->inliers = static_cast<int>(evidence->inliers.size());
  candidate->inlier_share = static_cast<double>(*candidate->inliers) / *candidate->matches;
  if (*candidate->inliers < options_.min_inliers) return false;
  if (*candidate->inlier_share < options_.min_inlier_share) return false;

  candidate->failed = LoopGate::kSpread;
  candidate->cells = CountCells(evidence->corners_px, camera_->parameters());
  return *candidate->cells >= options_.min_cells;
}

bool LoopVerification::HoldsBackwards(const Keyframe& earlier, const Island& later,
                                      LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kBackwards;
  const std::vector<DescribedLandmark> landmarks = MergeLandmarks(later.all);
  const auto matches = MatchLandmarks(options_.matching, earlier.corners, landmarks);
  const auto sightings = ToSightings(matches, earlier.corners, landmarks);
  const Rigid3d& T_A_C = evidence->all.T_A_C;
  const LevelTransform T_B_G = evidence->T_A_B.Inverse() * LevelTransform{0, T_A_C.translation};
  for (const PointSighting& sighting : sightings) {
    if (SightingError(sighting, T_B_G, T_A_C.rotation) <= options_.ransac.max_error) {
      evidence->all.of_later.push_back(sighting);
    }
  }
  const size_t inliers = evidence->all.of_later.size();
  candidate->backward_inliers = static_cast<int>(inliers);
  candidate->backward_share =
      sightings.empty() ? 0 : static_cast<double>(inliers) / static_cast<double>(sightings.size());
  return *candidate->backward_inliers >= options_.min_backward_inliers &&
         *candidate->backward_share >= options_.min_backward_share;
}

bool LoopVerification::Refine(LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kRefinement;
  const auto refined = RefineLoop(options_.refinement, evidence->all, evidence->T_A_B);
  if (!refined) return false;
  evidence->T_A_B = refined->T_A_B;
  candidate->covariance = refined->covariance;
  return true;
}

// Lines take part in the pose once the points have found it.
bool LoopVerification::LinesAgree(const Island& earlier, const Keyframe& later,
                                  LoopCandidate* candidate, Evidence* evidence) const {
  candidate->failed = LoopGate::kLines;
  const Rigid3d T_A_C = evidence->T_A_B.ToRigid() * evidence->all.T_B_C;
  LineWitnesses witnesses =
      FindWitnesses(options_.witnesses, *camera_, T_A_C, LinesOf(earlier), later.segments);
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
