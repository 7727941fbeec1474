// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/append.h"
#include "common/camera/camera_model.h"
#include "common/config/config.h"
#include "common/config/stereo_pairs.h"
#include "common/measurements.h"
#include "common/stopwatch.h"
#include "tracking/image_queue.h"
#include "tracking/images/image_mask.h"
#include "tracking/stereo/camera_pair.h"

namespace plm_vins {

// The features of one image of each camera, with statistics and processing time.
template <typename Tracker>
struct Tracked {
  std::vector<ImageSample> images;  // by camera; only those that were searched have pixels
  typename Tracker::Features features;
  typename Tracker::Statistics statistics;  // of camera 0
  bool restart = false;                     // see ReadyImage
  bool publish = true;                      // see ReadyImage
  double tracking_ms = 0;                   // [ms]
};

// A front end, as used by the nodes and the offline runner: an ImageQueue followed by one tracker
// for each camera that is not the second one of a pair. `kSection` is the trackers' part of the
// configuration. Synchronous; add in order of arrival and pop until nullopt.
template <typename TrackerType, auto kSection>
class TrackingStage {
 public:
  using Tracker = TrackerType;
  using Frame = Tracked<Tracker>;

  // For `max_wait` see ImageQueue. Throws ConfigError if the tracker rejects its part of the
  // configuration.
  explicit TrackingStage(const Config& config,
                         double max_wait = std::numeric_limits<double>::infinity())
      : queue_(config, max_wait), depth_unit_(config.sensor.depth.value_or(DepthSensor()).unit) {
    const std::vector<StereoPair> pairs = StereoPairs(config.sensor);
    for (int camera = 0; camera < static_cast<int>(config.sensor.cameras.size()); ++camera) {
      if (IsTracked(camera, pairs)) cameras_.push_back(MakeCamera(config, camera, pairs));
    }
  }

  // See ImageQueue.
  void AddImu(const ImuSample& sample) { queue_.AddImu(sample); }
  void AddImage(int camera, ImageSample image) { queue_.AddImage(camera, std::move(image)); }
  void AddDepth(DepthSample image) { queue_.AddDepth(std::move(image)); }
  bool waiting() const { return !queue_.empty(); }
  const ImageCounts& counts() const { return queue_.counts(); }

  // Returns the features of the next image in temporal order, or nullopt if it still waits.
  std::optional<Frame> Pop() { return Track(queue_.Pop()); }

  // Returns the features of the next image without waiting.
  std::optional<Frame> Flush() { return Track(queue_.Flush()); }

  // Numbers of the cameras that have a tracker.
  std::vector<int> tracked_cameras() const {
    std::vector<int> numbers;
    for (const TrackedCamera& camera : cameras_) numbers.push_back(camera.number);
    return numbers;
  }

  // Returns the last image of the i-th tracked camera with its tracks drawn.
  cv::Mat DrawTracks(size_t i = 0) const { return cameras_[i].tracker->DrawTracks(); }

  // Passes on what the trackers of another run over the same images found.
  void LearnFrom(const TrackingStage& earlier) {
    for (size_t i = 0; i < cameras_.size(); ++i) {
      cameras_[i].tracker->LearnFrom(*earlier.cameras_[i].tracker);
    }
  }

  // Returns whether a tracker found something that it did not know in the first image.
  bool HasLearned() const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [](const TrackedCamera& camera) { return camera.tracker->HasLearned(); });
  }

  // Drops the tracks of all cameras.
  void Reset() {
    for (TrackedCamera& camera : cameras_) camera.tracker->Reset();
  }

  // Returns the first text that is not empty, with the number of the camera.
  std::string Finding(const std::function<std::string(const Tracker&)>& of_tracker) const {
    for (const TrackedCamera& camera : cameras_) {
      const std::string finding = of_tracker(*camera.tracker);
      if (finding.empty()) continue;
      return camera.number == 0 ? finding
                                : "camera " + std::to_string(camera.number) + ": " + finding;
    }
    return "";
  }

 private:
  using Features = typename Tracker::Features;

  struct TrackedCamera {
    int number;
    std::optional<int> second;  // the camera that is matched against it
    Eigen::Quaterniond R_C_C0;  // from camera 0
    std::unique_ptr<Tracker> tracker;
    // Rotation since the last tracked image; nullopt: unknown.
    std::optional<Eigen::Quaterniond> R_now_then = Eigen::Quaterniond::Identity();
  };

  // Adds the file name to errors of the tracker, which name the key only.
  static TrackedCamera MakeCamera(const Config& config, int number,
                                  const std::vector<StereoPair>& pairs) {
    try {
      const CameraSensor &camera = config.sensor.cameras[number], &first = config.sensor.cameras[0];
      std::optional<CameraPair> pair;
      for (const StereoPair& numbers : pairs) {
        if (numbers.first == number) pair = CameraPairOf(config.sensor, numbers);
      }
      const cv::Size size(camera.parameters.width, camera.parameters.height);
      return {number, pair ? std::optional(pair->numbers().second) : std::nullopt,
              number == 0 ? Eigen::Quaterniond::Identity()
                          : camera.T_B_C.rotation.conjugate() * first.T_B_C.rotation,
              std::make_unique<Tracker>(
                  config.*kSection, CameraModel::Create(camera.parameters),
                  number == 0 ? ReadMask(config.points.fisheye_mask, size) : cv::Mat(), pair)};
    } catch (const std::invalid_argument& error) {
      throw ConfigError({config.file + ": " + error.what()});
    }
  }

  std::optional<Frame> Track(std::optional<ReadyImage> next) {
    if (!next) return std::nullopt;
    if (next->restart) Reset();
    const Stopwatch stopwatch;
    Frame frame;
    frame.features.t_ns = next->images[0].t_ns;
    for (TrackedCamera& camera : cameras_) {
      Append(TrackIn(*next, &camera), &ObservationsOf(&frame.features));
    }
    SortByCamera(&ObservationsOf(&frame.features));
    frame.tracking_ms = stopwatch.Milliseconds();
    frame.statistics = cameras_[0].tracker->statistics();
    frame.images.resize(next->images.size());
    for (const TrackedCamera& camera : cameras_) {
      frame.images[camera.number] = std::move(next->images[camera.number]);
    }
    frame.restart = next->restart;
    frame.publish = next->publish;
    return frame;
  }

  // Returns the observations of a camera and of the one that is matched against it.
  auto TrackIn(const ReadyImage& next, TrackedCamera* camera) {
    std::optional<Eigen::Quaterniond>& R_now_then = camera->R_now_then;
    if (next.R_now_then && R_now_then) {
      *R_now_then = camera->R_C_C0 * *next.R_now_then * camera->R_C_C0.conjugate() * *R_now_then;
    } else {
      R_now_then.reset();
    }
    const ImageSample& image = next.images[camera->number];
    Features features;
    if (!image.gray.empty()) {
      OtherViews others;
      if (camera->second) others.second = next.images[*camera->second].gray;
      if (camera->number == 0) others.depth = next.depth.depth;
      others.depth_unit = depth_unit_;
      features = camera->tracker->Track(image, R_now_then, others);
      R_now_then = Eigen::Quaterniond::Identity();
    }
    for (auto& observation : ObservationsOf(&features)) Number(*camera, &observation);
    return ObservationsOf(&features);
  }

  // Replaces the numbers within the tracker by those of the rig.
  template <typename Observation>
  void Number(const TrackedCamera& camera, Observation* observation) const {
    observation->camera = observation->camera == 0 ? camera.number : *camera.second;
    if (cameras_.size() > 1) observation->id = observation->id * kMaxCameras + camera.number;
  }

  static std::vector<PointObservation>& ObservationsOf(PointFrame* frame) { return frame->points; }
  static std::vector<LineObservation>& ObservationsOf(LineFrame* frame) { return frame->lines; }

  ImageQueue queue_;
  double depth_unit_;  // see OtherViews
  std::vector<TrackedCamera> cameras_;
};

}  // namespace plm_vins
