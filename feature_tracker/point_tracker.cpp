// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracker.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "common/camera/image_format.h"
#include "common/features/feature_checks.h"
#include "feature_tracker/contrast_equalizer.h"
#include "feature_tracker/depth_reader.h"
#include "feature_tracker/detection/corner_detector.h"
#include "feature_tracker/detection/ray_mask.h"
#include "feature_tracker/detection/spacing_grid.h"
#include "feature_tracker/detection/still_parts.h"
#include "feature_tracker/following/optical_flow.h"
#include "feature_tracker/following/outlier_rejection.h"
#include "feature_tracker/following/point_track.h"
#include "feature_tracker/stereo/stereo_matcher.h"
#include "tracking/age_color.h"
#include "tracking/images/image_check.h"
#include "tracking/images/image_mask.h"
#include "tracking/last_usable_image.h"

namespace plm_vins {
namespace {

// New corners are detected once this share of max_cnt is missing: a detection takes as long as
// tracking many corners.
constexpr double kRefillShare = 0.2;

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
        equalizer_(image_size_),
        still_parts_(camera_) {
    if (pair) stereo_.emplace(*pair);
  }

  PointFrame Track(const ImageSample& sample, const std::optional<Eigen::Quaterniond>& R_now_then,
                   const OtherViews& others) {
    CheckImage(sample, camera_->parameters(), t_ns_);
    if (stereo_ && !others.second.empty()) stereo_->CheckImage(others.second);
    if (!others.depth.empty()) CheckDepthFormat(others.depth, camera_->parameters());
    const cv::Mat& image = Equalize(sample.gray);
    OpticalFlow::Pyramid pyramid = flow_.BuildPyramid(image, std::move(unused_pyramid_));
    statistics_ = {};
    statistics_.previous = static_cast<int>(tracks_.size());
    if (t_ns_ && (!tracks_.empty() || last_usable_)) {
      const double dt = ToSeconds(sample.t_ns - *t_ns_);
      if (AreSame(sample.gray, sample_.gray)) {
        Stay(dt);
        if (last_usable_) last_usable_->Rotate(R_now_then);
      } else {
        FollowOrFindAgain(pyramid, sample, dt, R_now_then);
      }
    }
    still_parts_.Add(sample, R_now_then, Positions());
    Spread();
    if (IsRefillDue()) Refill(pyramid);
    CutMissingPatches(sample.gray);
    LookAtOthers(sample.gray, others);
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
    last_usable_.reset();
    still_parts_.Reset();
    statistics_ = {};
  }

  const PointTrackerStatistics& statistics() const { return statistics_; }
  std::string PairFinding() const {
    const std::string depth = depth_reader_.Finding();
    return depth.empty() && stereo_ ? stereo_->Finding() : depth;
  }
  std::string StillPartsFinding() const { return still_parts_.Finding(); }
  void LearnFrom(const Implementation& earlier) { still_parts_.LearnFrom(earlier.still_parts_); }
  bool HasLearned() const { return still_parts_.has_learned(); }

  // Draws a disc for each corner, and a line along its motion.
  cv::Mat DrawTracks() const {
    constexpr int kDiscRadius_px = 3;
    constexpr float kMotionScale = 4;  // enlarges the short motions between images
    cv::Mat image;
    if (!sample_.gray.empty()) cv::cvtColor(sample_.gray, image, cv::COLOR_GRAY2BGR);
    for (const PointTrack& track : tracks_) {
      const cv::Scalar color = AgeColor(track.length);
      cv::circle(image, track.uv_px, kDiscRadius_px, color, cv::FILLED, cv::LINE_AA);
      cv::line(image, track.uv_px, track.uv_px + kMotionScale * track.motion_px, color, 1,
               cv::LINE_AA);
    }
    return image;
  }

 private:
  void LookAtOthers(const cv::Mat& gray, const OtherViews& others) {
    if (stereo_) stereo_->Match(gray, others.second, &tracks_);
    depth_reader_.Read(others.depth, others.depth_unit, &tracks_);
  }

  const cv::Mat& Equalize(const cv::Mat& gray) {
    if (!config_.equalize) return gray;
    equalizer_.Apply(gray, &equalized_);
    return equalized_;
  }

  // Follows the tracks from the previous image, or also from the last one before a loss.
  void FollowOrFindAgain(const OpticalFlow::Pyramid& pyramid, const ImageSample& sample, double dt,
                         const std::optional<Eigen::Quaterniond>& R_now_then) {
    const std::vector<PointTrack> before = tracks_;
    const double previous_dt = std::exchange(previous_dt_, dt);
    Follow({pyramid_, previous_dt, dt, R_now_then}, pyramid, sample.gray, &tracks_);
    if (last_usable_) {
      last_usable_->Rotate(R_now_then);
      FindAgain(pyramid, sample);
    } else if (LosesTracks(before.size(), tracks_.size())) {
      last_usable_ = {sample_, std::move(pyramid_), before, previous_dt, R_now_then};
      pyramid_.clear();  // its memory must not be reused
    }
  }

  // Follows the tracks from before the loss. They replace the current tracks if enough of them are
  // found again.
  void FindAgain(const OpticalFlow::Pyramid& pyramid, const ImageSample& sample) {
    const double age = last_usable_->Age(sample.t_ns);
    std::vector<PointTrack> found = last_usable_->tracks;
    Follow({last_usable_->pyramid, last_usable_->previous_dt, age, last_usable_->R_now_then},
           pyramid, sample.gray, &found);
    const bool regained = RegainsTracks(last_usable_->tracks.size(), found.size(), tracks_.size());
    if (regained) {
      tracks_ = std::move(found);
      previous_dt_ = age;
    }
    if (regained || age > kMaxUsableImageAge) last_usable_.reset();
  }

  // Image from which tracks are followed.
  struct Origin {
    const OpticalFlow::Pyramid& pyramid;
    double previous_dt;  // from the image before this one [s]
    double dt;           // until the image that tracks are followed to [s]
    const std::optional<Eigen::Quaterniond>& R_now_then;
  };

  // Advances the tracks to the image of `pyramid`, and drops lost ones. `gray` is the same image
  // before equalization.
  void Follow(const Origin& from, const OpticalFlow::Pyramid& pyramid, const cv::Mat& gray,
              std::vector<PointTrack>* followed) {
    std::vector<PointTrack>& tracks = *followed;
    if (tracks.empty()) return;
    std::vector<cv::Point2f> points, turned, predicted;
    const auto dt_ratio = static_cast<float>(from.previous_dt > 0 ? from.dt / from.previous_dt : 0);
    for (const PointTrack& track : tracks) {
      points.push_back(track.uv_px);
      turned.push_back(from.R_now_then ? Turn(track, *from.R_now_then) : track.uv_px);
      predicted.push_back(turned.back() + dt_ratio * track.parallax_px);
    }
    const std::vector<FlowResult> flow = flow_.Track(from.pyramid, pyramid, points, predicted);

    std::vector<RayPair> pairs;
    std::vector<bool> keep(tracks.size(), false);
    for (size_t i = 0; i < tracks.size(); ++i) {
      if (flow[i].status == FlowResult::Status::kInconsistent) ++statistics_.forward_backward;
      if (flow[i].status == FlowResult::Status::kLost) ++statistics_.flow_lost;
      if (flow[i].status != FlowResult::Status::kTracked) continue;
      const Eigen::Vector2d xy_then = tracks[i].xy;
      const cv::Point2f aligned = Align(gray, flow[i].position, &tracks[i]);
      keep[i] = Advance(aligned, turned[i], from.dt, &tracks[i]);
      if (!keep[i]) {
        ++statistics_.flow_lost;
        continue;
      }
      pairs.push_back(
          {xy_then.homogeneous().normalized(), tracks[i].xy.homogeneous().normalized()});
    }
    RemoveTracks(keep, &tracks);
    const double threshold = config_.f_threshold / camera_->FocalLength();
    statistics_.epipolar_outliers =
        RemoveTracks(FindEpipolarInliers(pairs, from.R_now_then, threshold), &tracks);
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
  cv::Point2f Turn(const PointTrack& track, const Eigen::Quaterniond& R_now_then) const {
    const auto pixel = camera_->Project(R_now_then * track.xy.homogeneous());
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

  std::vector<cv::Point2f> Positions() const {
    std::vector<cv::Point2f> positions;
    positions.reserve(tracks_.size());
    for (const PointTrack& track : tracks_) positions.push_back(track.uv_px);
    return positions;
  }

  // Returns whether the track stands still in the image while the camera turns.
  bool StandsStill(const PointTrack& track) const {
    constexpr double kMaxMotion_px = 0.5;
    return !MaskAllows(still_parts_.moving(), track.uv_px) &&
           cv::norm(track.motion_px) < kMaxMotion_px;
  }

  // Drops tracks that came too close to an older one, that the mask excludes, or that stand still.
  void Spread() {
    SpacingGrid occupied(image_size_, config_.min_dist);
    std::vector<bool> keep;
    keep.reserve(tracks_.size());
    for (const PointTrack& track : tracks_) {
      keep.push_back(MaskAllows(mask_, track.uv_px) && !StandsStill(track) &&
                     occupied.IsFree(track.uv_px));
      if (keep.back()) occupied.Add(track.uv_px);
    }
    statistics_.crowded = RemoveTracks(keep, &tracks_);
  }

  int MissingTracks() const { return config_.max_cnt - static_cast<int>(tracks_.size()); }
  bool IsRefillDue() const { return MissingTracks() > kRefillShare * config_.max_cnt; }

  void Refill(const OpticalFlow::Pyramid& pyramid) {
    for (const cv::Point2f& corner :
         detector_.Detect(pyramid, Positions(), MissingTracks(), still_parts_.moving())) {
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

  // Omits points with impossibly fast motion, which occur near the image plane of a fisheye. The
  // motion in the second camera is nearly that in the first one.
  PointFrame MakeFrame() const {
    PointFrame frame;
    frame.t_ns = *t_ns_;
    for (const PointTrack& track : tracks_) {
      PointObservation point = {track.id, track.xy, ToEigen(track.uv_px), track.velocity};
      point.depth = track.depth;
      if (!IsPossible(point)) continue;
      frame.points.push_back(point);
      if (!track.second) continue;
      point = {track.id, track.second->xy, track.second->uv_px, track.velocity, 1};
      if (IsPossible(point)) frame.points.push_back(point);
    }
    SortByCamera(&frame.points);
    return frame;
  }

  // Constant after construction.
  PointTrackerConfig config_;
  std::shared_ptr<const CameraModel> camera_;
  cv::Size image_size_;
  cv::Mat mask_;  // with pixels without rays excluded
  CornerDetector detector_;
  OpticalFlow flow_;
  ContrastEqualizer equalizer_;
  std::optional<StereoMatcher> stereo_;
  DepthReader depth_reader_;
  StillParts still_parts_;

  // State at the newest image.
  std::optional<int64_t> t_ns_;
  double previous_dt_ = 0;  // between the two newest images [s]
  ImageSample sample_;      // keeps the pixels that the pyramid may refer to
  OpticalFlow::Pyramid pyramid_;
  OpticalFlow::Pyramid unused_pyramid_;  // its memory is reused for the next pyramid
  cv::Mat equalized_;                    // equalized image; its memory is reused
  std::vector<PointTrack> tracks_;       // in descending order of age
  std::optional<LastUsableImage<PointTrack, OpticalFlow::Pyramid>>
      last_usable_;  // set after a loss of tracks
  PointTrackerStatistics statistics_;
  int64_t next_id_ = 0;
};

PointTracker::PointTracker(const PointTrackerConfig& config,
                           std::shared_ptr<const CameraModel> camera, const cv::Mat& mask,
                           const std::optional<CameraPair>& pair)
    : implementation_(std::make_unique<Implementation>(config, std::move(camera), mask, pair)) {}

PointTracker::~PointTracker() = default;

PointFrame PointTracker::Track(const ImageSample& image,
                               const std::optional<Eigen::Quaterniond>& R_now_then,
                               const OtherViews& others) {
  return implementation_->Track(image, R_now_then, others);
}

void PointTracker::Reset() { implementation_->Reset(); }

const PointTrackerStatistics& PointTracker::statistics() const {
  return implementation_->statistics();
}

std::string PointTracker::PairFinding() const { return implementation_->PairFinding(); }

std::string PointTracker::StillPartsFinding() const { return implementation_->StillPartsFinding(); }

void PointTracker::LearnFrom(const PointTracker& earlier) {
  implementation_->LearnFrom(*earlier.implementation_);
}

bool PointTracker::HasLearned() const { return implementation_->HasLearned(); }

cv::Mat PointTracker::DrawTracks() const { return implementation_->DrawTracks(); }

}  // namespace plm_vins
