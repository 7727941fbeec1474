// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/stereo/line_stereo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/camera/image_format.h"
#include "tracking/stereo/epipolar_search.h"

namespace plm_vins {
namespace {

constexpr double kNearest = 0.3;      // [m]
constexpr double kInfinity_px = 5.0;  // beyond infinity: the mounting may be turned
constexpr double kAgain_px = 6.0;     // search range around the last match
constexpr double kAgreement_px = 2.0;
// Samples that must agree; fewer near the last match.
constexpr size_t kMinAgreeing = 4;
constexpr size_t kMinAgreeingAgain = 3;
constexpr std::array<double, 5> kShares = {0.1, 0.3, 0.5, 0.7, 0.9};
constexpr int kRetryInterval = 4;      // images between searches for a line that was not found
constexpr double kMinCrossing = 0.25;  // sine of the angle between line and epipolar curve
constexpr int kSearch_px = 3;          // across the predicted line
// Standard deviations: of an edge, and of how far lens and mounting move the image across the
// epipolar curves.
constexpr double kEdge_px = 0.3;
constexpr double kEpipolar_px = 0.5;

double Interpolate(const Eigen::Vector2d& ends, double share) {
  return (1 - share) * ends[0] + share * ends[1];
}

}  // namespace

LineStereo::LineStereo(const LineTrackerConfig& config, const CameraPair& pair)
    : pair_(pair), refinement_(config, pair.second_camera()) {}

void LineStereo::CheckRight(const cv::Mat& right) const {
  CheckImageFormat(right, pair_.second().parameters());
}

void LineStereo::Match(const cv::Mat& left, const cv::Mat& right, std::vector<LineTrack>* tracks) {
  ++images_;
  for (LineTrack& track : *tracks) {
    track.right.reset();
    if (right.empty()) continue;
    const bool is_turn = track.length == 1 || (track.id + images_) % kRetryInterval == 0;
    if (track.inverse_depths || is_turn) MatchOne({left, right}, &track);
  }
}

void LineStereo::MatchOne(const Images& images, LineTrack* track) const {
  track->inverse_depths = FindDepths(images, track->segment, track->inverse_depths);
  if (!track->inverse_depths) return;
  track->right = Locate(images.right, track->segment, *track->inverse_depths);
  if (!track->right) track->inverse_depths.reset();
}

std::optional<Eigen::Vector2d> LineStereo::FindDepths(
    const Images& images, const LineSegment& segment,
    const std::optional<Eigen::Vector2d>& expected) const {
  std::vector<DepthSample> samples;
  for (const double share : kShares) {
    SearchedPoint point;
    point.xy = segment.start + share * (segment.end - segment.start);
    const auto pixel = pair_.first().Project(point.xy.homogeneous());
    if (!pixel) continue;
    point.pixel = *pixel;
    SearchRange range{-kInfinity_px * pair_.InverseDepthPerPixel(), 1 / kNearest, 0};
    if (expected) {
      const double reach = kAgain_px * pair_.InverseDepthPerPixel();
      range.from = Interpolate(*expected, share) - reach;
      range.to = Interpolate(*expected, share) + reach;
    }
    const auto place = SearchAlongCurve(pair_, images.left, point, images.right, range);
    if (place) samples.push_back({share, place->inverse_depth});
  }
  return Agree(samples, expected ? kMinAgreeingAgain : kMinAgreeing);
}

// Fits a line to the samples that agree with the line through any two of them: those of the line
// with the most.
std::optional<Eigen::Vector2d> LineStereo::Agree(const std::vector<DepthSample>& samples,
                                                 size_t min_agreeing) const {
  const double tolerance = kAgreement_px * pair_.InverseDepthPerPixel();
  std::vector<DepthSample> best;
  for (size_t i = 0; i < samples.size(); ++i) {
    for (size_t j = i + 1; j < samples.size(); ++j) {
      const double slope = (samples[j].inverse_depth - samples[i].inverse_depth) /
                           (samples[j].share - samples[i].share);
      std::vector<DepthSample> agreeing;
      for (const DepthSample& sample : samples) {
        const double line = samples[i].inverse_depth + slope * (sample.share - samples[i].share);
        if (std::abs(sample.inverse_depth - line) < tolerance) agreeing.push_back(sample);
      }
      if (agreeing.size() > best.size()) best = agreeing;
    }
  }
  if (best.size() < min_agreeing) return std::nullopt;
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const DepthSample& sample : best) {
    const Eigen::Vector2d weights(1 - sample.share, sample.share);
    H += weights * weights.transpose();
    b += weights * sample.inverse_depth;
  }
  return H.inverse() * b;
}

std::optional<RightSegment> LineStereo::Locate(const cv::Mat& right, const LineSegment& segment,
                                               const Eigen::Vector2d& inverse_depths) const {
  const auto start = pair_.Transfer(segment.start, inverse_depths[0]);
  const auto end = pair_.Transfer(segment.end, inverse_depths[1]);
  const double middle = inverse_depths.mean();
  const auto near = pair_.Transfer(segment.Midpoint(), middle + pair_.InverseDepthPerPixel());
  const auto far = pair_.Transfer(segment.Midpoint(), middle);
  if (!start || !end || !near || !far) return std::nullopt;
  const LineSegment predicted{*start, *end};
  const double crossing = std::abs(predicted.Normal().dot((*near - *far).normalized()));
  if (!(crossing > kMinCrossing)) return std::nullopt;
  const auto found = refinement_.Refine(right, predicted, kSearch_px);
  if (!found) return std::nullopt;
  const double deviation =
      std::hypot(kEdge_px, kEpipolar_px * std::sqrt(std::max(1 - crossing * crossing, 0.0))) /
      pair_.second().FocalLength();
  return RightSegment{found->start, found->end, Eigen::Vector2d::Constant(deviation)};
}

}  // namespace plm_vins
