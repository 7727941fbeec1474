// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/measurements.h"
#include "map_bundle/adjusted_map.h"
#include "map_bundle/bundle_state.h"
#include "map_bundle/imu_history.h"
#include "map_bundle/landmark_tracks.h"
#include "pose_graph/loop_closer.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

struct MapBundleOptions {
  double gravity_norm = 9.81;  // [m/s^2]
  double point_noise = 1e-3;   // initial standard deviation of a corner (normalized)
  double depth_noise = 0.002;  // of a measured inverse depth, if there are any [1/m]
  size_t min_places = 3;       // recognized places
  size_t min_keyframes = 60;   // below both minima, bundle adjustment does not improve on odometry
};

// Statistics of the last call of MapBundle::Adjust().
struct MapBundleSummary {
  size_t keyframes = 0;
  size_t landmarks = 0;
  size_t reobservations = 0;  // observations of these landmarks in keyframes of another visit
  int rounds = 0;             // completed rounds; zero means no result
  bool failed = false;        // the solver failed in the following round
  bool ended = false;         // stopped by `is_end` before the last round
  ObservationNoise noise;     // estimated from the residuals
};

// Visual-inertial bundle adjustment of a whole map at the end of a run. It records the IMU samples,
// keyframe states and loop observations during the run. The pose graph corrects each odometry
// segment rigidly through its loops, with the scale that odometry had; the bundle adjusts all
// segments jointly.
class MapBundle {
 public:
  explicit MapBundle(const MapBundleOptions& options) : options_(options) {}

  void AddImu(const ImuSample& sample) { imu_.Add(sample); }

  // Records the odometry state of the map's newest keyframe, and of its observations those that the
  // map does not keep. `imu_ns` is its timestamp in IMU time; the samples up to it must have been
  // added.
  void AddKeyframe(const KeyframeMap& map, const EstimatorOutput& odometry, int64_t imu_ns,
                   const PointFrame& points);

  // Records the loop observations of the map's newest keyframe. They are used while the pose graph
  // keeps the loop. Loops that were accepted only after waiting for agreement are not used, since
  // their observations are not kept. A loop re-attached to another keyframe after map thinning is
  // not removed when the graph drops it.
  void AddLoops(const KeyframeMap& map, const LoopClosure& closure);

  // Number of keyframes that Adjust() would optimize: those not removed and connected with the
  // first one. Zero if there are too few keyframes or recognized places.
  size_t KeyframesToAdjust(const KeyframeMap& map) const;

  // Optimizes in rounds and calls `is_end` before each. Returns the result of the last completed
  // round, or nullopt if there is none; summary() tells why.
  std::optional<AdjustedMap> Adjust(
      const KeyframeMap& map, const std::function<bool()>& is_end = [] { return false; });

  const MapBundleSummary& summary() const { return summary_; }

 private:
  struct Place {
    std::vector<Reobservation> observations;
    bool counts = false;
  };

  // Drops what only keyframes that the map has removed need.
  void ForgetRemoved(const KeyframeMap& map);
  void ForgetObservationsBy(int keyframe);
  void AddPlace(const KeyframeMap& map, const RecognizedPlace& place, bool counts);
  void SetCounts(int a, int b, bool counts);
  size_t CountPlaces() const;
  std::vector<Reobservation> Observations() const;
  BundleState StateOf(const KeyframeMap& map) const;
  void AdjustInRounds(const std::function<bool()>& is_end, BundleState* bundle);

  MapBundleOptions options_;
  ImuHistory imu_;
  std::map<int, BundleKeyframe> keyframes_;      // keyframes of this run, by number; states in O
  std::map<std::pair<int, int>, Place> places_;  // by (later, earlier) keyframe number
  MapBundleSummary summary_;
};

}  // namespace plm_vins
