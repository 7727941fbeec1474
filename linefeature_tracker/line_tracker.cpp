// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/line_tracker.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/features/feature_checks.h"
#include "common/stopwatch.h"
#include "linefeature_tracker/detection/line_finder.h"
#include "linefeature_tracker/following/line_flow.h"
#include "linefeature_tracker/following/line_gate.h"
#include "linefeature_tracker/following/line_occupancy.h"
#include "linefeature_tracker/following/line_queue.h"
#include "linefeature_tracker/following/line_refinement.h"
#include "linefeature_tracker/segments/line_track.h"
#include "linefeature_tracker/segments/segment_sampler.h"
#include "linefeature_tracker/stereo/line_stereo.h"
#include "tracking/age_color.h"
#include "tracking/images/image_check.h"
#include "tracking/last_usable_image.h"

namespace plm_vins {
namespace {

constexpr int kSearchAfterFlow_px = 2;
constexpr int kSearchAfterDetection_px = 4;
constexpr double kMinCorrelation = 0.6;  // correlation of the profiles across a line
constexpr double kLineSpacing_px = 5;    // least distance of parallel lines side by side
constexpr double kRefillBelow = 0.9;     // share of max_lines below which lines are detected
constexpr int kRefillInterval = 5;       // least number of images between detections

// Predicts the segment for a pure rotation; unchanged if an endpoint would be behind the camera.
LineSegment Turn(const LineSegment& segment, const std::optional<Eigen::Quaterniond>& R_now_then) {
  if (!R_now_then) return segment;
  const Eigen::Vector3d start = *R_now_then * segment.start.homogeneous();
  const Eigen::Vector3d end = *R_now_then * segment.end.homogeneous();
  if (start.z() <= 0 || end.z() <= 0) return segment;
  return {start.hnormalized(), end.hnormalized()};
}

LineSegment Moved(const LineSegment& segment, const Eigen::Vector2d& motion) {
  return {segment.start + motion, segment.end + motion};
}

// Returns the observable part of the motion: across the line.
Eigen::Vector2d MotionAcross(const LineSegment& from, const LineSegment& to) {
  return from.Distance(to.Midpoint()) * from.Normal();
}

}  // namespace

class LineTracker::Implementation {
 public:
  Implementation(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
                 const cv::Mat& mask, const std::optional<CameraPair>& pair)
      : config_(config),
        camera_(std::move(camera)),
        image_size_(camera_->parameters().width, camera_->parameters().height),
        finder_(config, camera_),
        refinement_(config, camera_, mask),
        flow_(camera_),
        gate_(camera_->FocalLength()) {
    if (pair) stereo_.emplace(config, *pair);
  }

  LineFrame Track(const ImageSample& sample, const std::optional<Eigen::Quaterniond>& R_now_then,
                  const cv::Mat& second) {
    CheckImage(sample, camera_->parameters(), t_ns_);
    if (stereo_ && !second.empty()) stereo_->CheckImage(second);
    LineFlow::Pyramid pyramid = LineFlow::BuildPyramid(sample.gray);
    statistics_ = {};
    statistics_.previous = static_cast<int>(tracks_.size());
    const double dt = t_ns_ ? ToSeconds(sample.t_ns - *t_ns_) : 0;
    const double dt_ratio = previous_dt_ > 0 ? dt / previous_dt_ : 0;
    if (images_since_detection_) ++*images_since_detection_;
    const LineTracks before = tracks_;
    const double previous_dt = std::exchange(previous_dt_, dt);
    Follow(pyramid_, pyramid, dt_ratio, R_now_then, &tracks_);
    if (last_usable_) {
      last_usable_->Rotate(R_now_then);
      FindAgain(pyramid, sample.t_ns);
    }
    DropDuplicates();
    if (IsRefillDue()) Refill(sample.gray, FindLines(pyramid));
    if (!last_usable_ && LosesTracks(before.size(), tracks_.size())) {
      last_usable_ = {sample_, pyramid_, before, previous_dt, R_now_then};
    }
    if (stereo_) stereo_->Match(sample.gray, second, &tracks_);
    sample_ = sample;
    pyramid_ = std::move(pyramid);
    t_ns_ = sample.t_ns;
    return MakeFrame();
  }

  void Reset() {
    tracks_.clear();
    pyramid_.clear();
    t_ns_.reset();
    previous_dt_ = 0;
    images_since_detection_.reset();
    last_usable_.reset();
    statistics_ = {};
  }

  const LineTrackerStatistics& statistics() const { return statistics_; }

  // Draws the lines with their ids.
  cv::Mat DrawTracks() const {
    constexpr int kThickness_px = 2;
    constexpr double kFontScale = 0.35;
    const auto to_opencv = [](const Eigen::Vector2d& p) { return cv::Point2d(p.x(), p.y()); };
    cv::Mat image;
    if (!sample_.gray.empty()) cv::cvtColor(sample_.gray, image, cv::COLOR_GRAY2BGR);
    for (const LineTrack& track : tracks_) {
      const LineSegment& segment_px = track.segment_px;
      const cv::Scalar color = AgeColor(track.length);
      cv::line(image, to_opencv(segment_px.start), to_opencv(segment_px.end), color, kThickness_px,
               cv::LINE_AA);
      cv::putText(image, std::to_string(track.id), to_opencv(segment_px.Midpoint()),
                  cv::FONT_HERSHEY_SIMPLEX, kFontScale, color, 1, cv::LINE_AA);
    }
    return image;
  }

 private:
  using LineTracks = std::vector<LineTrack>;  // in descending order of age

  // Advances the tracks to the image of `pyramid` and drops lost ones.
  void Follow(const LineFlow::Pyramid& from, const LineFlow::Pyramid& pyramid, double dt_ratio,
              const std::optional<Eigen::Quaterniond>& R_now_then, LineTracks* tracks) {
    LineTracks followed;
    for (LineTrack& track : *tracks) {
      const LineSegment turned = Turn(track.segment, R_now_then);
      const LineSegment predicted = Moved(turned, dt_ratio * track.parallax);
      const auto found = FollowOne(from, pyramid, track.segment, predicted);
      if (found && Advance(*found, turned, &track)) followed.push_back(std::move(track));
    }
    *tracks = std::move(followed);
  }

  // Follows the tracks from before a loss. They replace the current tracks if enough of them are
  // found again.
  void FindAgain(const LineFlow::Pyramid& pyramid, int64_t t_ns) {
    const double age = last_usable_->Age(t_ns);
    const double dt_ratio = last_usable_->previous_dt > 0 ? age / last_usable_->previous_dt : 0;
    LineTracks found = last_usable_->tracks;
    Follow(last_usable_->pyramid, pyramid, dt_ratio, last_usable_->R_now_then, &found);
    const bool regained = RegainsTracks(last_usable_->tracks.size(), found.size(), tracks_.size());
    if (regained) {
      tracks_ = std::move(found);
      previous_dt_ = age;
    }
    if (regained || age > kMaxUsableImageAge) last_usable_.reset();
  }

  std::optional<LineSegment> FollowOne(const LineFlow::Pyramid& from,
                                       const LineFlow::Pyramid& pyramid, const LineSegment& segment,
                                       const LineSegment& predicted) {
    const auto flow = flow_.Track(from, pyramid, segment, predicted);
    if (!flow || flow->correlation < kMinCorrelation) {
      ++statistics_.match_lost;
      return std::nullopt;
    }
    if (!gate_.Accepts(predicted, flow->segment)) {
      ++statistics_.inconsistent;
      return std::nullopt;
    }
    auto refined = refinement_.Refine(pyramid.front(), flow->segment, kSearchAfterFlow_px);
    if (!refined) ++statistics_.edge_lost;
    return refined;
  }

  // `turned` is the track predicted by rotation only. Returns false if the line cannot be
  // projected.
  bool Advance(const LineSegment& segment, const LineSegment& turned, LineTrack* track) {
    const auto segment_px = ProjectSegment(*camera_, segment);
    if (!segment_px) {
      ++statistics_.edge_lost;
      return false;
    }
    track->parallax = MotionAcross(turned, segment);
    track->segment = segment;
    track->segment_px = *segment_px;
    ++track->length;
    return true;
  }

  // Drops the younger of two tracks that lie on the same line.
  void DropDuplicates() {
    LineOccupancy occupied(kLineSpacing_px);
    std::vector<LineTrack> kept;
    for (LineTrack& track : tracks_) {
      if (occupied.IsTaken(track.segment_px)) continue;
      occupied.Add(track.segment_px);
      kept.push_back(std::move(track));
    }
    statistics_.duplicates = static_cast<int>(tracks_.size() - kept.size());
    tracks_ = std::move(kept);
  }

  bool IsRefillDue() const {
    const bool is_short = static_cast<double>(tracks_.size()) < kRefillBelow * config_.max_lines;
    const bool has_waited = !images_since_detection_ || *images_since_detection_ >= kRefillInterval;
    return is_short && has_waited;
  }

  std::vector<FoundLine> FindLines(const LineFlow::Pyramid& pyramid) {
    const Stopwatch stopwatch;
    std::vector<FoundLine> lines = finder_.Find(pyramid, &statistics_.fragments);
    images_since_detection_ = 0;
    statistics_.detected = true;
    statistics_.candidates = static_cast<int>(lines.size());
    statistics_.detection_ms = stopwatch.Milliseconds();
    return lines;
  }

  // Adds tracks where the image has none.
  void Refill(const cv::Mat& image, const std::vector<FoundLine>& lines) {
    LineOccupancy occupied(kLineSpacing_px);
    LineQueue queue(image_size_);
    for (const LineTrack& track : tracks_) {
      occupied.Add(track.segment_px);
      queue.CountLine(track.segment_px);
    }
    for (size_t i = 0; i < lines.size(); ++i) queue.AddCandidate(lines[i].segment_px, i);
    while (static_cast<int>(tracks_.size()) < config_.max_lines) {
      const auto i = queue.Pop();
      if (!i) break;
      if (occupied.IsTaken(lines[*i].segment_px)) continue;
      const auto track = MakeTrack(image, lines[*i]);
      if (!track || occupied.IsTaken(track->segment_px)) continue;
      occupied.Add(track->segment_px);
      queue.CountLine(track->segment_px);
      tracks_.push_back(*track);
      tracks_.back().id = next_id_++;
      ++statistics_.added;
    }
  }

  // Returns a track without an id, or nullopt if no edge confirms the line.
  std::optional<LineTrack> MakeTrack(const cv::Mat& image, const FoundLine& line) const {
    const auto refined = refinement_.Refine(image, line.segment, kSearchAfterDetection_px);
    if (!refined) return std::nullopt;
    const auto segment_px = ProjectSegment(*camera_, *refined);
    if (!segment_px) return std::nullopt;
    LineTrack track;
    track.segment = *refined;
    track.segment_px = *segment_px;
    return track;
  }

  // Omits lines perpendicular to the optical axis of a fisheye, which have no image in the plane z
  // = 1.
  LineFrame MakeFrame() const {
    LineFrame frame;
    frame.t_ns = *t_ns_;
    for (const LineTrack& track : tracks_) {
      const LineObservation line = {track.id, track.segment.start, track.segment.end};
      if (!IsPossible(line)) continue;
      frame.lines.push_back(line);
      if (!track.second) continue;
      const auto& [segment, deviation] = *track.second;
      const LineObservation second = {track.id, segment.start, segment.end, 1,
                                      Eigen::Vector2d::Constant(deviation)};
      if (IsPossible(second)) frame.lines.push_back(second);
    }
    SortByCamera(&frame.lines);
    return frame;
  }

  // Constant after construction, except for the detector's buffers.
  LineTrackerConfig config_;
  std::shared_ptr<const CameraModel> camera_;
  cv::Size image_size_;
  LineFinder finder_;
  LineRefinement refinement_;
  LineFlow flow_;
  LineGate gate_;
  std::optional<LineStereo> stereo_;

  // State at the newest image.
  std::optional<int64_t> t_ns_;
  double previous_dt_ = 0;  // between the two newest images [s]
  ImageSample sample_;      // keeps the pixels that the pyramid may refer to
  LineFlow::Pyramid pyramid_;
  LineTracks tracks_;
  std::optional<LastUsableImage<LineTrack, LineFlow::Pyramid>> last_usable_;  // after a loss
  std::optional<int> images_since_detection_;
  LineTrackerStatistics statistics_;
  int64_t next_id_ = 0;
};

LineTracker::LineTracker(const LineTrackerConfig& config, std::shared_ptr<const CameraModel> camera,
                         const cv::Mat& mask, const std::optional<CameraPair>& pair)
    : implementation_(std::make_unique<Implementation>(config, std::move(camera), mask, pair)) {}

LineTracker::~LineTracker() = default;

LineFrame LineTracker::Track(const ImageSample& image,
                             const std::optional<Eigen::Quaterniond>& R_now_then,
                             const OtherViews& others) {
  return implementation_->Track(image, R_now_then, others.second);
}

void LineTracker::Reset() { implementation_->Reset(); }

const LineTrackerStatistics& LineTracker::statistics() const {
  return implementation_->statistics();
}

cv::Mat LineTracker::DrawTracks() const { return implementation_->DrawTracks(); }

}  // namespace plm_vins
