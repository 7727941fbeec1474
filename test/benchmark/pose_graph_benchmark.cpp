// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of loop closure during long operation in one place: repeats the keyframes of a
// map in rounds with new tracks and some drift, and prints after each round the number of keyframes
// kept and the time for each. Finally it measures the graph optimization.
//
// Usage: pose_graph_benchmark CONFIG MAP HOURS    MAP: run_offline --map-out of a flight
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <vector>

#include "common/config/config.h"
#include "common/process_setup.h"
#include "common/stopwatch.h"
#include "pose_graph/loop_closer.h"
#include "pose_graph/output/map_file.h"

namespace plm_vins {
namespace {

const Vector4d kDrift(0.05, -0.03, 0.02, 0.3 * M_PI / 180);  // drift of each round [m, rad]
constexpr int64_t kTracks = 1'000'000'000;                   // exceeds the track numbers of a round
constexpr double kPause = 1;                                 // between rounds [s]

// Returns the keyframe as observed in a later round. `share` is its temporal position in the round,
// from 0 to 1.
Keyframe InRound(Keyframe keyframe, int round, double share, int64_t length_ns, double path) {
  const LevelTransform T_O_first = LevelTransform::FromVector((round + share) * kDrift);
  keyframe.t_ns += round * length_ns;
  keyframe.path += round * path;
  keyframe.T_O_B = T_O_first.ToRigid() * keyframe.T_O_B;
  for (DescribedCorner& corner : keyframe.corners) {
    if (corner.track >= 0) corner.track += round * kTracks;
    if (corner.p_O) corner.p_O = (T_O_first * corner.p_O->cast<double>()).cast<float>();
  }
  for (TrackedSegment& segment : keyframe.segments) {
    segment.observation.id += round * kTracks;
    if (!segment.landmark) continue;
    segment.landmark->start_O = T_O_first * segment.landmark->start_O;
    segment.landmark->end_O = T_O_first * segment.landmark->end_O;
  }
  return keyframe;
}

struct Round {
  std::vector<double> ms;  // for each keyframe
  int loops = 0;
};

Round Fly(const std::vector<Keyframe>& keyframes, int round, LoopCloser* loops) {
  const int64_t length_ns = keyframes.back().t_ns - keyframes.front().t_ns + ToNanoseconds(kPause);
  Round result;
  for (size_t i = 0; i < keyframes.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(keyframes.size());
    Keyframe again = InRound(keyframes[i], round, share, length_ns, keyframes.back().path);
    again.world = 0;
    const Stopwatch stopwatch;
    const LoopClosure closure = loops->Add(std::move(again));
    result.ms.push_back(stopwatch.Milliseconds());
    for (const LoopCandidate& candidate : closure.candidates) result.loops += !candidate.failed;
  }
  return result;
}

void Print(const Round& round, double minutes, const KeyframeMap& map) {
  std::vector<double> sorted = round.ms;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const double ms : sorted) sum += ms;
  std::printf(
      "%6.1f min: %5d keyframes, %4d kept, %5zu edges, %3d loops, ms per keyframe: mean "
      "%.1f, 95th percentile %.1f\n",
      minutes, map.graph.size(), map.CountKept(), map.graph.edges().size(), round.loops,
      sum / static_cast<double>(sorted.size()), sorted[sorted.size() * 95 / 100]);
  std::fflush(stdout);  // shows the row at once, since rounds are slow
}

void Run(const Config& config, const std::vector<Keyframe>& keyframes, double hours) {
  if (keyframes.empty()) throw std::runtime_error("there is no keyframe in the map");
  const CameraModels cameras = CreateAll(config.sensor.cameras);
  LoopCloser loops(cameras);
  const double seconds = ToSeconds(keyframes.back().t_ns - keyframes.front().t_ns) + kPause;
  for (int round = 0; round * seconds < 3600 * hours; ++round) {
    Print(Fly(keyframes, round, &loops), (round + 1) * seconds / 60, loops.map());
  }
  PoseGraph graph = loops.map().Compact().graph;
  const Stopwatch stopwatch;
  graph.Optimize();
  std::printf("optimizing %d keyframes and %zu edges: %.1f ms\n", graph.size(),
              graph.edges().size(), stopwatch.Milliseconds());
}

}  // namespace
}  // namespace plm_vins

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pose_graph_benchmark CONFIG MAP HOURS\n");
    return 1;
  }
  plm_vins::SetUpProcess();
  plm_vins::Run(plm_vins::LoadConfig(argv[1]), plm_vins::LoadMap(argv[2]).keyframes,
                std::atof(argv[3]));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "pose_graph_benchmark: %s\n", error.what());
  return 1;
}
