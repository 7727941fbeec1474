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
  double point_noise = 1e-3;   // standard deviation of a corner to begin with (normalised)
  size_t min_places = 3;       // that were recognised
  size_t min_keyframes = 60;   // with fewer of both, odometry knows as much
};

// How it went.
struct MapBundleSummary {
  size_t keyframes = 0;
  size_t landmarks = 0;
  size_t sightings_again = 0;  // of these landmarks by keyframes of another visit
  int rounds = 0;              // that are done; zero: nothing was found
  bool failed = false;         // the equations of the next round could not be solved
  bool ended = false;          // was asked to end before the last round
  SightingNoise noise;         // as found
};

// Bundle adjustment of a whole map with the IMU: what a run remembers of its keyframes beside the
// map, and the solution in the end. Where the graph has a place by its loops alone, with the scale
// of each piece of odometry, the bundle takes all pieces as one.
class MapBundle {
 public:
  explicit MapBundle(const MapBundleOptions& options) : options_(options) {}

  void AddImu(const ImuSample& sample) { imu_.Add(sample); }

  // What odometry says of the map's newest keyframe, at `imu_ns` by the clock of the IMU. The
  // samples up to there come before.
  void AddKeyframe(const KeyframeMap& map, const EstimatorOutput& odometry, int64_t imu_ns);

  // What loop closure says of the map's newest keyframe. A place counts as long as the graph
  // accepts its loop. Not so one that had to wait for agreement, whose sightings nobody keeps; and
  // a loop that goes by another keyframe, as its own was thinned out, is not known when it is
  // dropped.
  void AddLoops(const KeyframeMap& map, const LoopClosure& closure);

  // How many keyframes Adjust() takes: those that are kept and joined to the first one. Zero where
  // they are too few, or the places that were recognised.
  size_t KeyframesToAdjust(const KeyframeMap& map) const;

  // Adjusts them in rounds, before each of which `is_end` is asked. Of the last round that is done;
  // nothing where there is none, of which summary() knows the reason.
  std::optional<AdjustedMap> Adjust(
      const KeyframeMap& map, const std::function<bool()>& is_end = [] { return false; });

  const MapBundleSummary& summary() const { return summary_; }

 private:
  struct Place {
    std::vector<SightingAgain> sightings;
    bool counts = false;
  };

  void AddPlace(const KeyframeMap& map, const RecognisedPlace& place, bool counts);
  void SetCounts(int a, int b, bool counts);
  size_t CountPlaces() const;
  std::vector<SightingAgain> Sightings() const;
  BundleState StateOf(const KeyframeMap& map) const;
  void AdjustInRounds(const std::function<bool()>& is_end, BundleState* bundle);

  MapBundleOptions options_;
  ImuHistory imu_;
  std::map<int, BundleKeyframe> keyframes_;      // of this run, by number; their states in O
  std::map<std::pair<int, int>, Place> places_;  // by the later keyframe and the earlier one
  MapBundleSummary summary_;
};

}  // namespace plm_vins
