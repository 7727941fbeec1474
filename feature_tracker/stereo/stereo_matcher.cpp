// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>

#include "common/camera/image_format.h"
#include "common/format.h"
#include "feature_tracker/detection/ray_mask.h"
#include "tracking/stereo/epipolar_search.h"

namespace plm_vins {
namespace {

constexpr double kNearest = 0.3;  // [m]
constexpr double kInfinity_px =
    5.0;  // tolerance beyond infinity, since the extrinsics may be turned
constexpr double kMaxBand_px = 4.5;
constexpr double kReturn_px = 1.5;       // largest distance of the backward match from the corner
constexpr double kBack_px = 16.0;        // range of the backward search around the corner
constexpr double kLargestDelay = 0.025;  // [s]; beyond, the second camera is not used
constexpr double kReportedDelay = 2e-3;  // [s]
constexpr double kReportedAngle = 0.2 * M_PI / 180;  // [rad]
constexpr double kMaxDelay = 1e-3;                   // [s]; smaller delays are not compensated
// If a smaller share of the searches succeeds, the matches are due to chance.
constexpr double kMinFoundShare = 0.15;
constexpr double kShareGain = 0.1;  // weight of one image in the mean shares
constexpr size_t kMinSearches = 8;
constexpr int64_t kSettlingImages = 3;  // until the estimated extrinsics and delay have settled
// Intervals [images] at which tracks without a match are searched for, and matches are confirmed.
constexpr int kRetryInterval = 4;
constexpr int kConfirmInterval = 16;

Eigen::Vector2d PixelOf(const PointTrack& track) { return {track.uv_px.x, track.uv_px.y}; }

}  // namespace

StereoMatcher::StereoMatcher(const CameraPair& pair)
    : stated_(pair), pair_(pair), extrinsics_(pair.T_S_C(), pair.second().FocalLength()) {}

void StereoMatcher::CheckImage(const cv::Mat& second) const {
  CheckImageFormat(second, pair_.second().parameters());
}

void StereoMatcher::Match(const cv::Mat& first, const cv::Mat& second,
                          std::vector<PointTrack>* tracks) {
  ++unsearched_;
  for (PointTrack& track : *tracks) track.second.reset();
  if (second.empty()) return;
  ++searched_;
  std::vector<Search> searches;
  std::vector<StereoMatch> matches;
  for (PointTrack& track : *tracks) {
    if (!IsDue(track)) continue;
    searches.push_back({&track, Find({first, second}, track)});
    const auto& place = searches.back().place;
    if (place && !IsBehind(*place)) matches.push_back(place->match);
  }
  extrinsics_.Update(matches);
  pair_ = stated_.With(extrinsics_.T_S_C());
  Judge(&searches);
  unsearched_ = 0;
}

// Matched and new tracks are searched for in every image, others in some.
bool StereoMatcher::IsDue(const PointTrack& track) const {
  const int least_length = IsLate() ? 2 : 1;  // a delay requires a known motion
  if (track.length < least_length) return false;
  const bool is_new = track.length < least_length + unsearched_;
  return track.inverse_depth || is_new || IsTurn(track, kRetryInterval);
}

// Swapped cameras, or cameras that expose at different times, produce matches by chance.
void StereoMatcher::Judge(std::vector<Search>* searches) {
  Shares sum;
  for (Search& search : *searches) {
    const bool is_behind = search.place && IsBehind(*search.place);
    search.is_good = search.place && !is_behind && extrinsics_.Accepts(search.place->match);
    sum.found += search.is_good;
    sum.behind += is_behind;
  }
  if (searches->size() >= kMinSearches) {
    const auto count = static_cast<double>(searches->size());
    const Shares now = {sum.found / count, sum.behind / count};
    if (!shares_) shares_ = now;
    shares_->found += kShareGain * (now.found - shares_->found);
    shares_->behind += kShareGain * (now.behind - shares_->behind);
  }
  for (Search& search : *searches) {
    search.track->inverse_depth.reset();
    if (!search.is_good || !IsTrusted()) continue;
    search.track->inverse_depth = search.place->inverse_depth;
    search.track->second = {InTime(search.place->match), search.place->pixel};
  }
}

std::optional<StereoMatcher::Place> StereoMatcher::Find(const Images& images,
                                                        const PointTrack& track) const {
  if (!track.patch) return std::nullopt;
  const bool is_known = track.inverse_depth && !IsTurn(track, kConfirmInterval);
  return is_known ? FindAgain(images, track) : FindAnywhere(images, track);
}

std::optional<StereoMatcher::Place> StereoMatcher::FindAnywhere(const Images& images,
                                                                const PointTrack& track) const {
  const double behind = MayBeSwapped() ? 1 / kNearest : kInfinity_px * pair_.InverseDepthPerPixel();
  const SearchRange range{-behind, 1 / kNearest, Band(track)};
  const SearchedPoint point{PixelOf(track), WhenSeen(track)};
  const auto seed = SearchAlongCurve(pair_, images.first, point, images.second, range);
  auto place = seed ? Align(images, *seed, track) : std::nullopt;
  if (!place) return std::nullopt;
  const SearchedPoint match{place->pixel, InTime(place->match)};
  const double nearby = kBack_px * pair_.InverseDepthPerPixel();
  const SearchRange back_range{place->inverse_depth - nearby, place->inverse_depth + nearby,
                               range.band_px};
  const auto back =
      SearchAlongCurve(pair_.Swapped(), images.second, match, images.first, back_range);
  if (!back || (back->pixel - point.pixel).cwiseAbs().maxCoeff() > kReturn_px) return std::nullopt;
  return place;
}

std::optional<StereoMatcher::Place> StereoMatcher::FindAgain(const Images& images,
                                                             const PointTrack& track) const {
  const auto expected = pair_.Project(WhenSeen(track), *track.inverse_depth);
  return expected ? Align(images, {*track.inverse_depth, *expected}, track) : std::nullopt;
}

// Returns the point in the first camera at the time when the second camera exposes.
Eigen::Vector2d StereoMatcher::WhenSeen(const PointTrack& track) const {
  return IsLate() ? Eigen::Vector2d(track.xy + extrinsics_.delay() * track.velocity) : track.xy;
}

Eigen::Vector2d StereoMatcher::InTime(const StereoMatch& match) const {
  return IsLate() ? extrinsics_.WithoutDelay(match) : match.xy_S;
}

bool StereoMatcher::IsLate() const { return std::abs(extrinsics_.delay()) > kMaxDelay; }

// The first images may show less of a fault than there is: their matches are not used then.
bool StereoMatcher::IsTrusted() const {
  if (searched_ < kSettlingImages && !Finding().empty()) return false;
  return (!shares_ || shares_->found > kMinFoundShare) && extrinsics_.zoom() == 0 &&
         std::abs(extrinsics_.delay()) < kLargestDelay;
}

bool StereoMatcher::IsSwapped() const { return shares_ && shares_->behind > kMinFoundShare; }

bool StereoMatcher::MayBeSwapped() const {
  return searched_ < kSettlingImages || !IsTrusted() || IsSwapped();
}

std::string StereoMatcher::Finding() const {
  const auto& [first, second] = stated_.numbers();
  if (IsSwapped()) {
    return Format("cameras %d and %d seem to be swapped; check %s, %s and %s", first, second,
                  TopicKey(first).c_str(), TopicKey(second).c_str(), TransformKey(second).c_str());
  }
  if (shares_ && shares_->found <= kMinFoundShare) {
    return Format(
        "hardly any point of camera %d is found again in camera %d; check that %s and %s are not "
        "swapped, %s, both focal lengths, and that both cameras are triggered together",
        first, second, TopicKey(first).c_str(), TopicKey(second).c_str(),
        TransformKey(second).c_str());
  }
  if (extrinsics_.zoom() != 0) {
    return Format(
        "the focal length of camera %d is wrong by %+.1f %% against that of camera %d, so that its "
        "points are not used; calibrate both cameras anew",
        second, 100 * extrinsics_.zoom(), first);
  }
  if (std::abs(extrinsics_.delay()) > kReportedDelay) {
    return Format("camera %d is %.1f ms %s against its timestamps; trigger all cameras together",
                  second, 1e3 * std::abs(extrinsics_.delay()),
                  extrinsics_.delay() > 0 ? "late" : "early");
  }
  const double angle = extrinsics_.rotation().norm();
  if (angle < kReportedAngle) return "";
  return Format("camera %d is turned by %.2f deg against %s; calibrate it anew", second,
                angle * 180 / M_PI, TransformKey(second).c_str());
}

bool StereoMatcher::IsTurn(const PointTrack& track, int interval) const {
  return (track.id + searched_) % interval == 0;
}

std::optional<StereoMatcher::Place> StereoMatcher::Align(const Images& images,
                                                         const CurvePoint& seed,
                                                         const PointTrack& track) const {
  const auto warp = pair_.Warp(WhenSeen(track), seed.inverse_depth);
  if (!warp) return std::nullopt;
  auto pose = track.patch->Align(images.second, {*warp * track.patch_linear, seed.pixel});
  if (!pose) {  // the corner may look different by now
    const auto patch = CornerPatch::Cut(images.first, PixelOf(track));
    if (patch) pose = patch->Align(images.second, {*warp, seed.pixel});
  }
  if (!pose) return std::nullopt;
  const auto xy_S = RayOf(pair_.second(), pose->center);
  if (!xy_S) return std::nullopt;
  const StereoMatch match{track.xy, track.velocity, *xy_S};
  return Place{match, pose->center, pair_.InverseDepth(track.xy, InTime(match))};
}

bool StereoMatcher::IsBehind(const Place& place) const {
  return place.inverse_depth < -kInfinity_px * pair_.InverseDepthPerPixel();
}

double StereoMatcher::Band(const PointTrack& track) const {
  double deviation_px = 0;
  for (const double inverse_depth : {0.0, 1 / kNearest}) {
    const auto xy_S = pair_.Transfer(WhenSeen(track), inverse_depth);
    if (!xy_S) return kMaxBand_px;
    deviation_px = std::max(deviation_px, extrinsics_.Deviation({track.xy, track.velocity, *xy_S}));
  }
  return std::min(2 * deviation_px, kMaxBand_px);
}

}  // namespace plm_vins
