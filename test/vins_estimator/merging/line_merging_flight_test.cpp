// SPDX-License-Identifier: BSD-3-Clause
// Merging and recognition on simulated flights, compared with the true identity of each line.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "test/feature_simulator/feature_simulator.h"
#include "test/vins_estimator/initialization/simulated_frames.h"
#include "test/vins_estimator/line_window.h"
#include "vins_estimator/geometry/line_pairs.h"
#include "vins_estimator/merging/line_merging.h"

namespace plm_vins {
namespace {

using testing::kWindowSize;
using testing::LineWindow;

// Results of merging on a simulated flight through a room.
struct FlightScore {
  int merged = 0, recognized = 0, wrong = 0;
  int redundant = 0, absorbed = 0;            // landmarks of lines that have an older one
  double landmarks = 0, lines_in_map = 0;     // triangulated, sum over frames
  int whole_map = 0, whole_map_unmerged = 0;  // landmarks of the whole flight

  double precision() const { return 1.0 - wrong / double(merged + recognized); }
  double recall() const { return absorbed / double(redundant); }
};

using Identities = std::map<int64_t, int>;  // line of the world by track

// Returns the landmarks of lines that have an older landmark.
std::set<int64_t> FindRedundant(const LineMap& lines, const Identities& identities,
                                FlightScore* score) {
  std::set<int> seen;
  std::set<int64_t> redundant;
  for (const auto& [id, landmark] : lines.landmarks()) {
    if (!landmark.triangulated) continue;
    ++score->landmarks;
    if (!seen.insert(identities.at(id)).second) redundant.insert(id);
  }
  score->lines_in_map += double(seen.size());
  return redundant;
}

// Lines closer than this are indistinguishable, since image noise is as large at some meters.
constexpr double kIndistinguishable = 0.05;  // [m]

bool IsOneLine(const simulator::LineSegment3d& a, const simulator::LineSegment3d& b) {
  const LinePairGeometry pair = Compare({a.start, a.end}, {b.start, b.end});
  return pair.angle < 0.01 && pair.distance < kIndistinguishable && pair.gap < kIndistinguishable;
}

simulator::FeatureDataset Fly(uint64_t seed, double duration) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.max_points = 1;
  options.line_break_probability = 0.03;  // half of the tracks end within 23 images
  options.trajectory.duration = duration;
  return simulator::SimulateFeatures(options);
}

// Calls `at_frame` with the window at each image of a flight, before merging.
void FlyThrough(const simulator::FeatureDataset& data,
                const std::function<void(LineWindow*)>& at_frame) {
  LineWindow window;
  window.map().window.cameras[0].SetExtrinsics(simulator::DefaultSensors().cameras[0].T_B_C);
  for (size_t i = 0; i < data.lines.size(); ++i) {
    window.Slide(/*keep_second_newest=*/i % 4 == 0, kWindowSize);
    window.AddFrame(data.truth[i], data.lines[i]);
    at_frame(&window);
  }
}

void CollectTriangulated(const LineMap& lines, std::set<int64_t>* ids) {
  for (const auto& [id, landmark] : lines.landmarks()) {
    if (landmark.triangulated) ids->insert(id);
  }
}

FlightScore MergeOnFlight(uint64_t seed) {
  const auto data = Fly(seed, /*duration=*/12);
  FlightScore score;
  std::set<int64_t> redundant, absorbed, whole_map, whole_map_unmerged;
  FlyThrough(data, [&](LineWindow* window) {
    const LineMap before = window->map().lines;
    redundant.merge(FindRedundant(before, data.line_landmark, &score));
    const UnitedLines united = window->Unite();
    score.merged += united.merging.merged;
    score.recognized += united.recognized;
    CollectTriangulated(window->map().lines, &whole_map);
    for (const auto& [id, landmark] : before.landmarks()) {
      if (window->map().lines.landmarks().count(id)) continue;
      absorbed.insert(id);
      whole_map.erase(id);
      const int line = data.line_landmark.at(id);
      const int older = data.line_landmark.at(window->map().aliases.Resolve(id));
      score.wrong += !IsOneLine(data.world.lines[line], data.world.lines[older]);
    }
  });
  FlyThrough(data, [&](LineWindow* window) {
    CollectTriangulated(window->map().lines, &whole_map_unmerged);
  });
  score.redundant = static_cast<int>(redundant.size());
  for (const int64_t id : redundant) score.absorbed += static_cast<int>(absorbed.count(id));
  score.whole_map = static_cast<int>(whole_map.size());
  score.whole_map_unmerged = static_cast<int>(whole_map_unmerged.size());
  return score;
}

TEST(LineMerging, FindsTheTracksOfOneLineAndOnlyThose) {
  FlightScore sum;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const FlightScore score = MergeOnFlight(seed);
    sum.merged += score.merged;
    sum.recognized += score.recognized;
    sum.wrong += score.wrong;
    sum.redundant += score.redundant;
    sum.absorbed += score.absorbed;
    sum.landmarks += score.landmarks;
    sum.lines_in_map += score.lines_in_map;
    sum.whole_map += score.whole_map;
    sum.whole_map_unmerged += score.whole_map_unmerged;
  }
  EXPECT_GT(sum.recognized, 0);
  EXPECT_GE(sum.precision(), 0.98);
  EXPECT_GE(sum.recall(), 0.8);
  EXPECT_LT(sum.landmarks, 1.1 * sum.lines_in_map);
  EXPECT_LE(sum.whole_map, 0.5 * sum.whole_map_unmerged);
}

}  // namespace
}  // namespace plm_vins
