// SPDX-License-Identifier: BSD-3-Clause
#include "offline/pipeline/odometry_pipeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/append.h"

namespace plm_vins {
namespace {

constexpr size_t kQueueCapacity = 200;  // items, mostly IMU samples of about a second

// Upper bound of the images that the back end may still report. It exceeds the number that may
// wait, since dropped images are never reported.
constexpr size_t kMaxUnfinished = 300;

// By how many standard deviations findings without any exceed what is usual: what the data state
// themselves, then what tells its cause, then symptoms that several causes share. The causes that
// explain a symptom are more certain (RankedFinding).
constexpr double kStamps = 1000, kStillParts = 10, kPair = 7, kSensors = 5, kLens = 4.5,
                 kContradiction = 4;

// Time in which nearly all still parts of the image are found, once many are.
constexpr int64_t kLearning_ns = 2'500'000'000;

bool IsPowerOfTwo(int64_t count) { return (count & (count - 1)) == 0; }

void ReleasePixels(TrackedFeatures* frame) {
  frame->points.images.clear();
  if (frame->lines) frame->lines->images.clear();
}

RecordingEvent EventOf(const TrackedItem& item) {
  using Kind = RecordingEvent::Kind;
  return {item.frame ? Kind::kImage : Kind::kImu, item.t_ns(), item.imu, 0};
}

}  // namespace

OdometryPipeline::OdometryPipeline(const Config& config)
    : use_lines_(config.use_lines),
      keeps_pixels_(config.pose_graph.loop_closure),
      image_topic_(config.sensor.cameras[0].image_topic),
      schedule_(config.publish_rate),
      trackers_(config),
      back_end_(config) {}

DropCounts OdometryPipeline::drops() const {
  DropCounts counts = ToDropCounts(trackers_.image_counts());
  Append(back_end_.Drops(), &counts);
  counts.push_back({"frames_without_lines", back_end_.statistics().frames_without_lines, ""});
  return counts;
}

std::string OdometryPipeline::InputFinding() const {
  const std::string& images = stamp_faults_.finding().text;
  return images.empty() ? back_end_.InputFinding().text : images;
}

std::vector<std::string> OdometryPipeline::Findings() const {
  const bool is_contradicted = contradicted_images_ >= kMinContradicted;
  const Finding &stamps = stamp_faults_.finding(), &input = back_end_.InputFinding();
  std::vector<RankedFinding> ranked = {
      {stamps.text, stamps.sigmas},
      {input.text, input.sigmas},
      {StillPartsFinding(), kStillParts},
      {trackers_.PairFinding(), kPair},
      {sensor_faults_.finding().text, sensor_faults_.finding().sigmas},
      {back_end_.LensWarning(), kLens},
      {is_contradicted ? imu_contradiction_ : "", kContradiction}};
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.sigmas > b.sigmas; });
  std::vector<std::string> findings;
  for (RankedFinding& finding : ranked) {
    if (!finding.text.empty()) findings.push_back(std::move(finding.text));
  }
  return findings;
}

void OdometryPipeline::LearnFrom(const OdometryPipeline& earlier) {
  trackers_.LearnFrom(earlier.trackers_);
  // Corners that stand still contradict right lengths as well.
  if (!earlier.trackers_.HasLearned()) back_end_.LearnFrom(earlier.back_end_);
}

void OdometryPipeline::ShowTracks(double interval, TrackImageCallback on_images) {
  track_image_interval_ns_ = ToNanoseconds(interval);
  on_track_images_ = std::move(on_images);
}

void OdometryPipeline::Run(Recording* recording, RecordingInterval interval, int threads,
                           const FrameCallback& on_frame) {
  trackers_.TrackSideBySide(threads > 2);
  const auto track = [&](const TrackedReceiver& emit) {
    RunTrackers(recording, interval, threads > 3, emit);
  };
  const auto estimate = [&](TrackedItem item) {
    Consume(std::move(item), on_frame);
    return !back_end_.has_found_wrong_length();
  };
  if (threads > 1) {
    RunAhead<TrackedItem>(kQueueCapacity, track, estimate);
  } else {
    track(estimate);
  }
  images_ = trackers_.image_counts().images + unreadable_images_;
  while (auto estimated = back_end_.Flush()) Report(std::move(*estimated), on_frame);
}

void OdometryPipeline::Run(FeatureFileReader* features, RecordingInterval interval,
                           const FrameCallback& on_frame) {
  while (auto item =
             is_end_() || back_end_.has_found_wrong_length() ? std::nullopt : features->Next()) {
    if (!item->frame) first_imu_.Add(item->t_ns());
    const RecordingInterval::Part part = interval.Locate(EventOf(*item));
    if (part == RecordingInterval::Part::kEnd) break;
    if (part == RecordingInterval::Part::kSkip) continue;
    if (item->frame) {
      if (!use_lines_) item->frame->lines.reset();
      AddImageStamp(item->t_ns());
      ++images_;
    }
    Consume(std::move(*item), on_frame);
  }
  while (auto estimated = back_end_.Flush()) Report(std::move(*estimated), on_frame);
}

void OdometryPipeline::Read(Recording* recording, RecordingInterval interval,
                            const EventReceiver& emit) {
  while (const auto event = is_end_() ? std::nullopt : recording->Next()) {
    if (event->kind == RecordingEvent::Kind::kImu) first_imu_.Add(event->t_ns);
    const RecordingInterval::Part part = interval.Locate(*event);
    if (part == RecordingInterval::Part::kEnd) return;
    if (part == RecordingInterval::Part::kSkip) continue;
    if (!emit({*event, Load(*event, recording)})) return;
  }
}

std::optional<cv::Mat> OdometryPipeline::Load(const RecordingEvent& event, Recording* recording) {
  using Kind = RecordingEvent::Kind;
  if (event.kind == Kind::kImu) return std::nullopt;
  const bool is_needed = event.kind == Kind::kDepth || schedule_.IsNeeded(event.camera, event.t_ns);
  if (!is_needed) return cv::Mat();
  return recording->LoadImage();
}

void OdometryPipeline::RunTrackers(Recording* recording, const RecordingInterval& interval,
                                   bool reads_ahead, const TrackedReceiver& emit) {
  const auto read = [&](const EventReceiver& feed) { Read(recording, interval, feed); };
  const auto feed = [&](LoadedEvent loaded) { return Feed(std::move(loaded), emit); };
  if (reads_ahead) {
    RunAhead<LoadedEvent>(kQueueCapacity, read, feed);
  } else {
    read(feed);
  }
  while (auto frame = trackers_.Flush()) {
    if (!EmitTracked(std::move(*frame), emit)) return;
  }
}

bool OdometryPipeline::Feed(LoadedEvent loaded, const TrackedReceiver& emit) {
  using Kind = RecordingEvent::Kind;
  const RecordingEvent& event = loaded.event;
  if (event.kind == Kind::kImu) {
    trackers_.AddImu(event.imu);
    if (!emit({event.imu, nullptr})) return false;
  } else if (loaded.image) {
    AddImage(event, std::move(*loaded.image));
  } else if (event.kind == Kind::kImage && event.camera == 0) {
    ++unreadable_images_;
  }
  while (auto frame = trackers_.Pop()) {
    if (!EmitTracked(std::move(*frame), emit)) return false;
  }
  return true;
}

void OdometryPipeline::AddImage(const RecordingEvent& event, cv::Mat image) {
  using Kind = RecordingEvent::Kind;
  if (event.kind == Kind::kDepth) return trackers_.AddDepth({event.t_ns, std::move(image)});
  if (event.camera == 0) {
    AddImageStamp(event.t_ns);
    image_stamps_.Add(event.t_ns);
    stamp_faults_.Set(event.t_ns, image_stamps_.Finding("image_topic " + image_topic_), kStamps);
  }
  trackers_.AddImage(event.camera, {event.t_ns, std::move(image)});
}

void OdometryPipeline::AddImageStamp(int64_t t_ns) {
  first_image_.Add(t_ns);
  last_image_ns_ = t_ns;
}

bool OdometryPipeline::EmitTracked(TrackedFeatures frame, const TrackedReceiver& emit) {
  still_parts_.Set(frame.points.features.t_ns, trackers_.StillPartsFinding());
  if (trackers_.HasLearned() && !learned_ns_) learned_ns_ = frame.points.features.t_ns;
  if (learned_ns_ && frame.points.features.t_ns - *learned_ns_ > kLearning_ns) return false;
  // The last power of two is in the second half of any run, whatever its length.
  if (IsPowerOfTwo(++tracked_images_)) {
    points_image_ = trackers_.DrawPoints();
    lines_image_ = trackers_.DrawLines();
  }
  if (on_track_images_) ShowTracksIfDue(frame.points.features.t_ns);
  // Frees the pixels, since features may wait long for the IMU.
  if (!keeps_pixels_) ReleasePixels(&frame);
  return emit({{}, std::make_unique<TrackedFeatures>(std::move(frame))});
}

void OdometryPipeline::ShowTracksIfDue(int64_t t_ns) {
  const bool is_due = !last_track_image_ns_ || t_ns < *last_track_image_ns_ ||
                      t_ns - *last_track_image_ns_ >= track_image_interval_ns_;
  if (!is_due) return;
  last_track_image_ns_ = t_ns;
  on_track_images_(t_ns, trackers_.DrawPoints(), trackers_.DrawLines());
}

void OdometryPipeline::Consume(TrackedItem item, const FrameCallback& on_frame) {
  if (saved_features_ != nullptr) saved_features_->Add(item);
  if (item.frame) {
    AddFeatures(std::move(*item.frame));
  } else {
    back_end_.AddImu(item.imu);
  }
  while (auto estimated = back_end_.Pop()) Report(std::move(*estimated), on_frame);
}

void OdometryPipeline::AddFeatures(TrackedFeatures tracked) {
  if (tracked.points.restart) {
    back_end_.Reset("timestamps jumped back");
    unfinished_.clear();
  }
  if (!tracked.points.publish) {
    ++thinned_images_;
    return;
  }
  if (unfinished_.size() == kMaxUnfinished) unfinished_.erase(unfinished_.begin());
  PipelineFrame& frame = unfinished_[tracked.points.features.t_ns];
  frame.point_tracking_ms = tracked.points.tracking_ms;
  frame.point_tracking = tracked.points.statistics;
  frame.images = std::move(tracked.points.images);
  back_end_.AddPoints(std::move(tracked.points.features));
  if (!tracked.lines) return;
  frame.line_tracking_ms = tracked.lines->tracking_ms;
  frame.line_tracking = tracked.lines->statistics;
  back_end_.AddLines(std::move(tracked.lines->features));
}

void OdometryPipeline::Report(EstimatedFrame estimated, const FrameCallback& on_frame) {
  ++estimated_images_;
  last_frame_ns_ = estimated.output.t_ns;
  const std::string contradiction = back_end_.ImuContradiction();
  if (!contradiction.empty()) {
    imu_contradiction_ = contradiction;
    ++contradicted_images_;
  }
  sensor_faults_.Set(estimated.output.t_ns, back_end_.SensorFaults(), kSensors);
  PipelineFrame frame;
  const auto reported = unfinished_.find(estimated.output.t_ns);
  if (reported != unfinished_.end()) {
    frame = std::move(reported->second);
    unfinished_.erase(unfinished_.begin(), std::next(reported));
  }
  frame.imu = std::move(estimated.imu);
  const bool continues = frame.imu.front().t_ns == last_imu_ns_;
  if (continues) frame.imu.erase(frame.imu.begin());
  frame.imu_ns = estimated.imu_ns;
  last_imu_ns_ = estimated.imu_ns;
  frame.output = std::move(estimated.output);
  frame.points = std::move(estimated.points);
  frame.lines = std::move(estimated.lines);
  on_frame(frame);
}

}  // namespace plm_vins
