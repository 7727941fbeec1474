// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracker.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/camera/image_format.h"
#include "common/features/feature_checks.h"
#include "feature_tracker/contrast_equalizer.h"
#include "feature_tracker/depth_sampling.h"
#include "feature_tracker/detection/corner_detector.h"
#include "feature_tracker/detection/spacing_grid.h"
#include "feature_tracker/following/optical_flow.h"
#include "feature_tracker/following/outlier_rejection.h"
#include "feature_tracker/point_track.h"
#include "feature_tracker/ray_mask.h"
#include "feature_tracker/stereo/stereo_matcher.h"
#include "feature_tracker/track_drawing.h"
#include "tracking/image_check.h"
#include "tracking/image_mask.h"

namespace plm_vins {
namespace {

// New corners are detected once this share of max_cnt is missing: a detection takes as long as
// tracking many corners.
constexpr double kRefillShare = 0.1;

Eigen::Vector2d ToEigen(const cv::Point2f& point) { return {point.x, point.y}; }
cv::Point2f ToOpenCv(const Eigen::Vector2d& point) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y())};
}

// Removes the tracks whose `keep` is false; returns their number.
int RemoveTracks(const std::vector<bool>& keep, std::vector<PointTrack>* tracks) {
  size_t kept = 0;
  for (size_t i = 0; i < tracks->size(); ++i) {
    if (keep[i]) (*tracks)[kept++] = (*tracks)[i];
  }
  const size_t removed = tracks->size() - kept;
  tracks->resize(kept);
  return static_cast<int>(removed);
}

}  // namespace

class PointTracker::Implementation {
 public:
  Implementation(const PointTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
                 const cv::Mat& mask, const std::optional<CameraPair>& pair)
      : config_(config),
        camera_(std::move(camera)),
        image_size_(camera_->parameters().width, camera_->parameters().height),
        mask_(WithinRays(*camera_, mask)),
        detector_(config, mask_),
        flow_(config),
        equalizer_(image_size_) {
    if (pair) stereo_.emplace(*pair);
  }

  PointFrame Track(const ImageSample& sample, const std::optional<Eigen::Quaterniond>& R_C1_C0,
                   const ImageCompanions& companions) {
    CheckImage(sample, camera_->parameters(), t_ns_);
    if (stereo_ && !companions.right.gray.empty()) stereo_->CheckRight(companions.right.gray);
    if (!companions.depth.depth.empty()) {
      CheckDepthFormat(companions.depth.depth, camera_->parameters());
    }
    const cv::Mat& image = Equalize(sample.gray);
    OpticalFlow::Pyramid pyramid = flow_.BuildPyramid(image, std::move(unused_pyramid_));
    statistics_ = {};
    statistics_.previous = static_cast<int>(tracks_.size());
    if (!tracks_.empty()) {
      const double dt = ToSeconds(sample.t_ns - *t_ns_);
      if (AreSame(sample.gray, sample_.gray)) {
        Stay(dt);
      } else {
        Follow(pyramid, sample.gray, dt, R_C1_C0);
      }
      Spread();
    }
    if (IsRefillDue()) Refill(image);
    CutMissingPatches(sample.gray);
    LookAtCompanions(sample.gray, companions);
    sample_ = sample;
    unused_pyramid_ = std::exchange(pyramid_, std::move(pyramid));
    t_ns_ = sample.t_ns;
    return MakeFrame();
  }

  void Reset() {
    tracks_.clear();
    pyramid_.clear();
    t_ns_.reset();
    previous_dt_ = 0;
    statistics_ = {};
  }

  // Tracks are ordered by age, so the youngest are dropped.
  void SetMaxCorners(int count) {
    config_.max_cnt = count;
    detector_ = CornerDetector(config_, mask_);
    tracks_.resize(std::min(tracks_.size(), static_cast<size_t>(count)));
  }

  const PointTrackerStatistics& statistics() const { return statistics_; }
  std::string SecondCameraFinding() const { return stereo_ ? stereo_->Finding() : ""; }
  cv::Mat DrawTracks() const { return DrawPointTracks(sample_.gray, tracks_); }

 private:
  void LookAtCompanions(const cv::Mat& gray, const ImageCompanions& companions) {
    if (stereo_) stereo_->Match(gray, companions.right.gray, &tracks_);
    for (PointTrack& track : tracks_) track.depth = DepthAt(companions.depth.depth, track.uv_px);
  }

  const cv::Mat& Equalize(const cv::Mat& gray) {
    if (!config_.equalize) return gray;
    equalizer_.Apply(gray, &equalized_);
    return equalized_;
  }

  // Advances the tracks to the image of `pyramid`, `dt` seconds later, and drops lost ones. `gray`
  // is the same image before equalization.
  void Follow(const OpticalFlow::Pyramid& pyramid, const cv::Mat& gray, double dt,
              const std::optional<Eigen::Quaterniond>& R_C1_C0) {
    std::vector<cv::Point2f> points, turned, predicted;
    const auto dt_ratio = static_cast<float>(previous_dt_ > 0 ? dt / previous_dt_ : 0);
    for (const PointTrack& track : tracks_) {
      points.push_back(track.uv_px);
      turned.push_back(R_C1_C0 ? Turn(track, *R_C1_C0) : track.uv_px);
      predicted.push_back(turned.back() + dt_ratio * track.parallax_px);
    }
    previous_dt_ = dt;
    const std::vector<FlowResult> flow = flow_.Track(pyramid_, pyramid, points, predicted);

    std::vector<RayPair> pairs;
    std::vector<bool> keep(tracks_.size(), false);
    for (size_t i = 0; i < tracks_.size(); ++i) {
      if (flow[i].status == FlowResult::Status::kInconsistent) ++statistics_.forward_backward;
      if (flow[i].status == FlowResult::Status::kLost) ++statistics_.flow_lost;
      if (flow[i].status != FlowResult::Status::kTracked) continue;
      const Eigen::Vector2d xy_C0 = tracks_[i].xy;
      const cv::Point2f aligned = Align(gray, flow[i].position, &tracks_[i]);
      keep[i] = Advance(aligned, turned[i], dt, &tracks_[i]);
      if (!keep[i]) {
        ++statistics_.flow_lost;
        continue;
      }
      pairs.push_back({xy_C0.homogeneous().normalized(), tracks_[i].xy.homogeneous().normalized()});
    }
    RemoveTracks(keep, &tracks_);
    const double threshold = config_.f_threshold / camera_->FocalLength();
    statistics_.epipolar_outliers =
        RemoveTracks(FindEpipolarInliers(pairs, R_C1_C0, threshold), &tracks_);
  }

  // Keeps the tracks in place in a repeated image. Tracking would move them by the errors of
  // alignment.
  void Stay(double dt) {
    previous_dt_ = dt;
    for (PointTrack& track : tracks_) {
      track.motion_px = track.parallax_px = cv::Point2f();
      track.velocity.setZero();
      ++track.length;
    }
  }

  // Predicts the track's pixel for a pure rotation; unchanged if it cannot be projected.
  cv::Point2f Turn(const PointTrack& track, const Eigen::Quaterniond& R_C1_C0) const {
    const auto pixel = camera_->Project(R_C1_C0 * track.xy.homogeneous());
    return pixel ? ToOpenCv(*pixel) : track.uv_px;
  }

  // Aligns the track's patch near `uv_px` and returns its position. If the alignment fails, returns
  // `uv_px` and drops the patch.
  static cv::Point2f Align(const cv::Mat& gray, const cv::Point2f& uv_px, PointTrack* track) {
    if (!track->patch) return uv_px;
    const auto pose = track->patch->Align(gray, {track->patch_linear, ToEigen(uv_px)});
    if (!pose) {
      track->patch.reset();
      return uv_px;
    }
    track->patch_linear = pose->linear;
    return ToOpenCv(pose->center);
  }

  // Extracts patches for new corners and those whose appearance has changed.
  void CutMissingPatches(const cv::Mat& gray) {
    for (PointTrack& track : tracks_) {
      if (track.patch) continue;
      if (const auto patch = CornerPatch::Cut(gray, ToEigen(track.uv_px))) {
        track.patch = std::make_shared<const CornerPatch>(*patch);
        track.patch_linear.setIdentity();
      }
    }
  }

  // Returns false if the new position has no ray.
  bool Advance(const cv::Point2f& uv_px, const cv::Point2f& turned_px, double dt,
               PointTrack* track) const {
    const auto xy = RayOf(*camera_, ToEigen(uv_px));
    if (!xy) return false;
    track->motion_px = uv_px - track->uv_px;
    track->parallax_px = uv_px - turned_px;
    track->velocity = (*xy - track->xy) / dt;
    track->xy = *xy;
    track->uv_px = uv_px;
    ++track->length;
    return true;
  }

  // Drops tracks that came too close to an older one, or that the mask excludes.
  void Spread() {
    SpacingGrid occupied(image_size_, config_.min_dist);
    std::vector<bool> keep;
    keep.reserve(tracks_.size());
    for (const PointTrack& track : tracks_) {
      keep.push_back(MaskAllows(mask_, track.uv_px) && occupied.IsFree(track.uv_px));
      if (keep.back()) occupied.Add(track.uv_px);
    }
    statistics_.crowded = RemoveTracks(keep, &tracks_);
  }

  int MissingTracks() const { return config_.max_cnt - static_cast<int>(tracks_.size()); }
  bool IsRefillDue() const { return MissingTracks() > kRefillShare * config_.max_cnt; }

  void Refill(const cv::Mat& image) {
    std::vector<cv::Point2f> existing;
    for (const PointTrack& track : tracks_) existing.push_back(track.uv_px);
    for (const cv::Point2f& corner : detector_.Detect(image, existing, MissingTracks())) {
      const auto xy = RayOf(*camera_, ToEigen(corner));
      if (!xy) continue;
      PointTrack track;
      track.id = next_id_++;
      track.uv_px = corner;
      track.xy = *xy;
      tracks_.push_back(track);
      ++statistics_.detected;
    }
  }

  // Omits points with impossibly fast motion, which occur near the image plane of a fisheye.
  PointFrame MakeFrame() const {
    PointFrame frame;
    frame.t_ns = *t_ns_;
    for (const PointTrack& track : tracks_) {
      const PointObservation point = {track.id,       track.xy,    ToEigen(track.uv_px),
                                      track.velocity, track.right, track.right_search,
                                      track.depth};
      if (IsPossible(point)) frame.points.push_back(point);
    }
    return frame;
  }

  // Constant after construction, except for SetMaxCorners().
  PointTrackerConfig config_;
  std::shared_ptr<const CameraModel> camera_;
  cv::Size image_size_;
  cv::Mat mask_;  // with pixels without rays excluded
  CornerDetector detector_;
  OpticalFlow flow_;
  ContrastEqualizer equalizer_;
  std::optional<StereoMatcher> stereo_;

  // State at the newest image.
  std::optional<int64_t> t_ns_;
  double previous_dt_ = 0;  // between the two newest images [s]
  ImageSample sample_;      // keeps the pixels that the pyramid may refer to
  OpticalFlow::Pyramid pyramid_;
  OpticalFlow::Pyramid unused_pyramid_;  // its memory is reused for the next pyramid
  cv::Mat equalized_;                    // equalized image; its memory is reused
  std::vector<PointTrack> tracks_;       // in descending order of age
  PointTrackerStatistics statistics_;
  int64_t next_id_ = 0;
};

PointTracker::PointTracker(const PointTrackerConfig& config,
                           std::shared_ptr<const CameraModel> camera, const cv::Mat& mask,
                           const std::optional<CameraPair>& pair)
    : implementation_(std::make_unique<Implementation>(config, std::move(camera), mask, pair)) {}

PointTracker::~PointTracker() = default;

PointFrame PointTracker::Track(const ImageSample& image,
                               const std::optional<Eigen::Quaterniond>& R_C1_C0,
                               const ImageCompanions& companions) {
  return implementation_->Track(image, R_C1_C0, companions);
}

void PointTracker::Reset() { implementation_->Reset(); }

void PointTracker::SetMaxCorners(int count) { implementation_->SetMaxCorners(count); }

const PointTrackerStatistics& PointTracker::statistics() const {
  return implementation_->statistics();
}

std::string PointTracker::SecondCameraFinding() const {
  return implementation_->SecondCameraFinding();
}

cv::Mat PointTracker::DrawTracks() const { return implementation_->DrawTracks(); }

}  // namespace plm_vins
