// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/stereo/line_stereo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/camera/image_format.h"
#include "tracking/stereo/epipolar_search.h"

namespace plm_vins {
namespace {

constexpr double kNearest = 0.3;  // [m]
constexpr double kInfinity_px =
    5.0;  // tolerance beyond infinity, since the extrinsics may be turned
constexpr double kAgreement_px = 2.0;
constexpr size_t kMinAgreeing = 4;
constexpr std::array<double, 5> kShares = {0.1, 0.3, 0.5, 0.7, 0.9};
// Intervals [images] at which lines without a match are searched for, and matches are confirmed.
constexpr int kRetryInterval = 4;
constexpr int kConfirmInterval = 16;
constexpr double kMinCrossing = 0.25;  // sine of the angle between line and epipolar line
// Lines are searched for if the sine exceeds this in the first image. The limit is lower because
// the line may be shorter, and so steeper, in the second image.
constexpr double kMinFirstCrossing = 0.5 * kMinCrossing;
constexpr int kSearch_px = 3;  // across the predicted line
// Standard deviations of an edge, and of the shift of the image across the epipolar curves due to
// errors of lens and extrinsics.
constexpr double kEdge_px = 0.3;
constexpr double kEpipolar_px = 0.5;

// Sine of the angle between a segment and the epipolar line through its middle. `baseline` is the
// position of the other camera.
double Crossing(const LineSegment& segment, const Eigen::Vector3d& baseline) {
  const Eigen::Vector2d along = baseline.head<2>() - segment.Midpoint() * baseline.z();
  return std::abs(segment.Normal().dot(along.normalized()));
}

}  // namespace

LineStereo::LineStereo(const LineTrackerConfig& config, const CameraPair& pair)
    : pair_(pair),
      p_C_S_(pair.T_S_C().Inverse().translation),
      refinement_(config, pair.second_camera()) {}

void LineStereo::CheckImage(const cv::Mat& second) const {
  CheckImageFormat(second, pair_.second().parameters());
}

void LineStereo::Match(const cv::Mat& first, const cv::Mat& second,
                       std::vector<LineTrack>* tracks) {
  ++unsearched_;
  for (LineTrack& track : *tracks) track.second.reset();
  if (second.empty()) return;
  ++searched_;
  for (LineTrack& track : *tracks) {
    const bool is_new = track.length <= unsearched_;
    if (track.inverse_depths || is_new || IsTurn(track, kRetryInterval)) {
      MatchOne({first, second}, &track);
    }
  }
  unsearched_ = 0;
}

void LineStereo::MatchOne(const Images& images, LineTrack* track) const {
  const bool is_known = track->inverse_depths && !IsTurn(*track, kConfirmInterval);
  if (!is_known) track->inverse_depths = FindDepths(images, track->segment);
  if (!track->inverse_depths) return;
  track->second = Locate(images.second, track->segment, *track->inverse_depths);
  if (track->second) {
    track->inverse_depths = DepthsBy(track->second->segment, track->segment);
  } else {
    track->inverse_depths.reset();
  }
}

bool LineStereo::IsTurn(const LineTrack& track, int interval) const {
  return (track.id + searched_) % interval == 0;
}

// Intersects the rays R x + rho t of the ends with the plane through the line and camera S.
Eigen::Vector2d LineStereo::DepthsBy(const LineSegment& second, const LineSegment& segment) const {
  const Eigen::Vector3d normal = second.start.homogeneous().cross(second.end.homogeneous());
  const double slope = normal.dot(pair_.T_S_C().translation);
  const auto inverse_depth = [&](const Eigen::Vector2d& xy) {
    return -normal.dot(pair_.T_S_C().rotation * xy.homogeneous()) / slope;
  };
  return {inverse_depth(segment.start), inverse_depth(segment.end)};
}

std::optional<Eigen::Vector2d> LineStereo::FindDepths(const Images& images,
                                                      const LineSegment& segment) const {
  if (Crossing(segment, p_C_S_) < kMinFirstCrossing) return std::nullopt;
  std::vector<LineDepth> samples;
  for (size_t i = 0; i < kShares.size(); ++i) {
    const auto inverse_depth = DepthAt(images, segment, kShares[i]);
    if (inverse_depth) samples.push_back({kShares[i], *inverse_depth});
    const size_t most = samples.size() + kShares.size() - 1 - i;
    if (most < kMinAgreeing) return std::nullopt;
  }
  return Agree(samples);
}

std::optional<double> LineStereo::DepthAt(const Images& images, const LineSegment& segment,
                                          double share) const {
  SearchedPoint point;
  point.xy = segment.start + share * (segment.end - segment.start);
  const auto pixel = pair_.first().Project(point.xy.homogeneous());
  if (!pixel) return std::nullopt;
  point.pixel = *pixel;
  const SearchRange range{-kInfinity_px * pair_.InverseDepthPerPixel(), 1 / kNearest, 0};
  const auto place = SearchAlongCurve(pair_, images.first, point, images.second, range);
  return place ? std::optional(place->inverse_depth) : std::nullopt;
}

// Fits a line to the samples that agree with the line through two of them, the pair with which most
// agree.
std::optional<Eigen::Vector2d> LineStereo::Agree(const std::vector<LineDepth>& samples) const {
  const double tolerance = kAgreement_px * pair_.InverseDepthPerPixel();
  std::vector<LineDepth> best;
  for (size_t i = 0; i < samples.size(); ++i) {
    for (size_t j = i + 1; j < samples.size(); ++j) {
      const double slope = (samples[j].inverse_depth - samples[i].inverse_depth) /
                           (samples[j].share - samples[i].share);
      std::vector<LineDepth> agreeing;
      for (const LineDepth& sample : samples) {
        const double line = samples[i].inverse_depth + slope * (sample.share - samples[i].share);
        if (std::abs(sample.inverse_depth - line) < tolerance) agreeing.push_back(sample);
      }
      if (agreeing.size() > best.size()) best = agreeing;
    }
  }
  if (best.size() < kMinAgreeing) return std::nullopt;
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const LineDepth& sample : best) {
    const Eigen::Vector2d weights(1 - sample.share, sample.share);
    H += weights * weights.transpose();
    b += weights * sample.inverse_depth;
  }
  return H.inverse() * b;
}

std::optional<SecondSegment> LineStereo::Locate(const cv::Mat& second, const LineSegment& segment,
                                                const Eigen::Vector2d& inverse_depths) const {
  const auto start = pair_.Transfer(segment.start, inverse_depths[0]);
  const auto end = pair_.Transfer(segment.end, inverse_depths[1]);
  if (!start || !end) return std::nullopt;
  const LineSegment predicted{*start, *end};
  const double crossing = Crossing(predicted, pair_.T_S_C().translation);
  if (!(crossing > kMinCrossing)) return std::nullopt;
  const auto found = refinement_.Refine(second, predicted, kSearch_px);
  if (!found) return std::nullopt;
  const double deviation =
      std::hypot(kEdge_px, kEpipolar_px * std::sqrt(std::max(1 - crossing * crossing, 0.0))) /
      pair_.second().FocalLength();
  return SecondSegment{*found, deviation};
}

}  // namespace plm_vins
