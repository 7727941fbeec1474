// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lines/line_merging.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/so3.h"
#include "simulator/feature_simulator.h"
#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/initialization/simulated_frames.h"
#include "vins_estimator/lines/line_directions.h"
#include "vins_estimator/lines/line_fit.h"
#include "vins_estimator/lines/line_pairs.h"
#include "vins_estimator/window/anchor_policy.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFocalLength = 460.0;
constexpr double kNoise = 1.0 / kFocalLength;

// Frames of known pose, and the lines that they see, as the estimator would have them.
class LineWindow {
 public:
  LineWindow() : merging_(MergingOptions()) {}

  static LineMergingOptions MergingOptions() {
    LineMergingOptions options;
    options.noise = kNoise;
    return options;
  }

  void AddFrame(const FrameState& state, const LineFrame& frame) {
    WindowFrame window_frame;
    window_frame.state = state;
    window_.frames.push_back(window_frame);
    lines_.AddFrame(merging_.Redirect(frame));
    LineTriangulationOptions options;
    options.noise = kNoise;
    lines_.Triangulate(window_, options, /*max_length=*/20);
    Refit();
  }

  LineMergingCounts Merge() {
    const auto directions = LineDirections(window_, lines_, kNoise);
    manhattan_.Update(window_.newest().state.t_ns, directions);
    NameAxes(manhattan_, directions, &lines_);
    const LineMergingCounts counts = merging_.Merge(window_, &lines_, &manhattan_);
    NoteUse(lines_, &window_);
    return counts;
  }

  // As the estimator does: drops the frame before the newest, or else the oldest.
  void Slide(bool keep_second_newest, size_t size) {
    if (!keep_second_newest && window_.frames.size() > 1) {
      lines_.RemoveFrame(window_, window_.frames[window_.frames.size() - 2].state.t_ns);
      window_.frames.erase(window_.frames.end() - 2);
    } else if (window_.frames.size() > size) {
      RemoveOldest();
    }
  }

  SlidingWindow& window() { return window_; }
  LineMap& lines() { return lines_; }
  const LineAliases& aliases() const { return merging_.aliases(); }
  const LineMemory& memory() const { return merging_.memory(); }
  const ManhattanFrame& manhattan() const { return manhattan_; }

 private:
  void RemoveOldest() {
    const AnchorPolicyOptions options;
    const int64_t oldest_ns = window_.frames.front().state.t_ns;
    const bool stays = StaysAsAnchor(options, window_, lines_);
    if (const auto replaced_ns = AnchorToReplace(options, window_); stays && replaced_ns) {
      lines_.RemoveAnchor(*replaced_ns);
      merging_.RemoveAnchor(*replaced_ns);
      window_.RemoveAnchor(*replaced_ns);
    }
    merging_.Remember(window_, lines_, stays);
    lines_.StartAnew(window_, oldest_ns, [](const LineLandmark&) {});
    lines_.RemoveFrame(window_, oldest_ns);
    if (stays) {
      window_.TurnOldestIntoAnchor();
    } else {
      window_.RemoveOldest();
    }
  }

  // Stands for the optimisation.
  void Refit() {
    for (auto& [id, landmark] : lines_.landmarks()) {
      if (!landmark.triangulated || landmark.views.size() < 3) continue;
      std::vector<LineSighting> sightings;
      for (const LineView& view : landmark.views) {
        sightings.push_back({window_.T_W_C(*window_.Find(view.t_ns)), view.segment});
      }
      const auto fit = FitLine(sightings, kNoise, landmark.coordinates);
      if (fit) landmark.coordinates = fit->line;
    }
  }

  SlidingWindow window_;
  LineMap lines_;
  ManhattanFrame manhattan_;
  LineMerging merging_;
};

// A wall five metres ahead of a camera that moves sideways and up. Lines lie on the wall, in metres
// right and down from the point ahead.
struct WallLine {
  int64_t id;
  Vector2d start, end;
  int first_frame = 0, last_frame = 100;  // that show it
};

constexpr size_t kWindowSize = 10;

LineMergingCounts MergeOnWall(const std::vector<WallLine>& lines, LineWindow* window,
                              int frames = 10) {
  LineMergingCounts counts;
  for (int i = 0; i < frames; ++i) {
    FrameState state;
    state.t_ns = (i + 1) * 100'000'000ll;
    state.SetPose({Eigen::Quaterniond::Identity(), Vector3d(0.15 * i, 0.15 * i, 0)});
    LineFrame frame;
    frame.t_ns = state.t_ns;
    const auto see = [&state](const Vector2d& on_wall) -> Vector2d {
      return (on_wall - state.position().head<2>()) / 5.0;
    };
    for (const WallLine& line : lines) {
      if (i < line.first_frame || i > line.last_frame) continue;
      frame.lines.push_back({line.id, see(line.start), see(line.end)});
    }
    window->Slide(/*keep_second_newest=*/true, kWindowSize);
    window->AddFrame(state, frame);
    const LineMergingCounts now = window->Merge();
    counts.merged += now.merged;
    counts.recognised += now.recognised;
    counts.apart += now.apart;
    counts.seen_side_by_side += now.seen_side_by_side;
    counts.distant += now.distant;
    counts.other_direction += now.other_direction;
    counts.inconsistent += now.inconsistent;
  }
  return counts;
}

TEST(LineMerging, TakesAnEmptyMap) {
  LineWindow window;
  EXPECT_EQ(MergeOnWall({}, &window).merged, 0);
}

TEST(LineMerging, JoinsTheTracksOfOneLine) {
  LineWindow window;
  const auto counts =
      MergeOnWall({{4, {-1, 0.5}, {1, 0.6}, 0, 4}, {9, {-1, 0.5}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(counts.merged, 1);
  ASSERT_EQ(window.lines().landmarks().size(), 1u);
  const LineLandmark& line = window.lines().landmarks().at(4);
  EXPECT_EQ(line.views.size(), 10u);  // later ones of the new track, too
  const PluckerLine line_W = LineInWorld(line, window.window());
  EXPECT_MATRIX_NEAR(Vector3d(line_W.direction.normalized().cwiseAbs()),
                     Vector3d(2, 0.1, 0).normalized(), 1e-6);
}

TEST(LineMerging, JoinsPiecesThatTouch) {
  LineWindow window;
  const auto counts = MergeOnWall({{1, {-1, 0.5}, {0, 0.5}}, {2, {0.05, 0.5}, {1, 0.5}}}, &window);
  EXPECT_EQ(counts.merged, 1);
  const auto segment = ObservedSegment(window.lines().landmarks().at(1), window.window());
  ASSERT_TRUE(segment);
}

TEST(LineMerging, NeverJoinsParallelLines) {
  for (const double distance : {0.05, 0.1, 0.2}) {
    for (const bool at_once : {true, false}) {
      LineWindow window;
      const int last = at_once ? 100 : 4;
      const auto counts =
          MergeOnWall({{1, {-1, 0.5}, {1, 0.5}, 0, last},
                       {2, {-1, 0.5 + distance}, {1, 0.5 + distance}, at_once ? 0 : 5}},
                      &window);
      EXPECT_EQ(counts.merged, 0) << distance << (at_once ? " at once" : " one after the other");
      EXPECT_EQ(window.lines().landmarks().size(), 2u);
    }
  }
}

TEST(LineMerging, NeverJoinsCrossingLines) {
  LineWindow window;
  const auto counts =
      MergeOnWall({{1, {-1, 0.5}, {1, 0.5}, 0, 4}, {2, {-1, 0.4}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(counts.merged, 0);
  EXPECT_EQ(window.lines().landmarks().size(), 2u);
}

TEST(LineMerging, NeverJoinsCollinearLinesWithAGap) {
  for (const bool at_once : {true, false}) {
    LineWindow window;
    const auto counts = MergeOnWall({{1, {-1, 0.5}, {0, 0.5}, 0, at_once ? 100 : 4},
                                     {2, {0.3, 0.5}, {1.3, 0.5}, at_once ? 0 : 5}},
                                    &window);
    EXPECT_EQ(counts.merged, 0);
    EXPECT_EQ(window.lines().landmarks().size(), 2u);
  }
}

TEST(LineMerging, LetsOnlyOlderTracksAbsorb) {
  LineWindow window;
  MergeOnWall({{7, {-1, 0.5}, {1, 0.5}, 0, 3},
               {5, {-1, 0.5}, {1, 0.5}, 3, 6},  // triangulated later, but older by its id
               {9, {-1, 0.5}, {1, 0.5}, 6}},
              &window);
  ASSERT_EQ(window.lines().landmarks().size(), 1u);
  EXPECT_EQ(window.lines().landmarks().begin()->first, 5);
  EXPECT_EQ(window.aliases().Resolve(9), 5);
  EXPECT_EQ(window.aliases().Resolve(7), 5);
}

TEST(LineMerging, LetsGoOfTheTracksOfALineThatWasRemoved) {
  LineWindow window;
  MergeOnWall({{4, {-1, 0.5}, {1, 0.6}, 0, 4}, {9, {-1, 0.5}, {1, 0.6}, 5}}, &window);
  EXPECT_EQ(window.aliases().Resolve(9), 4);
  window.lines().Clear();
  window.Merge();
  EXPECT_EQ(window.aliases().Resolve(9), 9);
}

// A line that leaves the window, and another of a new track once it has left.
constexpr int64_t kGone = 4, kComeBack = 9;
constexpr int kFramesAndBack = 30;

LineMergingCounts ComeBack(const Vector2d& start, const Vector2d& end, LineWindow* window) {
  return MergeOnWall({{kGone, {-1, 0.5}, {1, 0.5}, 0, 7}, {kComeBack, start, end, 20}}, window,
                     kFramesAndBack);
}

TEST(LineMerging, RecognisesALineThatComesBack) {
  LineWindow window;
  const auto counts = ComeBack({-1, 0.5}, {1, 0.5}, &window);
  EXPECT_EQ(counts.recognised, 1);
  EXPECT_EQ(counts.merged, 0);
  EXPECT_EQ(window.aliases().Resolve(kComeBack), kGone);
  ASSERT_EQ(window.lines().landmarks().size(), 1u);
  const LineLandmark& line = window.lines().landmarks().at(kGone);
  EXPECT_EQ(line.id, kGone);
  EXPECT_EQ(line.views.size(), 10u);  // later ones of the new track, too
  ASSERT_EQ(line.anchor_views.size(), 1u);
  EXPECT_EQ(line.anchor_views[0].t_ns, 100'000'000);
  const AnchorFrame* anchor = window.window().FindAnchor(line.anchor_views[0].t_ns);
  ASSERT_NE(anchor, nullptr);
  EXPECT_EQ(anchor->last_use_ns, window.window().newest().state.t_ns);
}

TEST(LineMerging, RecognisesAnotherPartOfALine) {
  LineWindow window;
  EXPECT_EQ(ComeBack({1.05, 0.5}, {2, 0.5}, &window).recognised, 1);
  EXPECT_EQ(window.lines().landmarks().count(kGone), 1u);
}

TEST(LineMerging, DoesNotTakeAnotherLineForOneThatLeft) {
  const std::map<std::string, std::pair<Vector2d, Vector2d>> others = {
      {"parallel", {{-1, 0.7}, {1, 0.7}}},
      {"crossing", {{-1, 0.4}, {1, 0.6}}},
      {"collinear with a gap", {{1.3, 0.5}, {3, 0.5}}}};
  for (const auto& [name, ends] : others) {
    LineWindow window;
    EXPECT_EQ(ComeBack(ends.first, ends.second, &window).recognised, 0) << name;
    EXPECT_NE(window.memory().Find(kGone), nullptr);
    ASSERT_EQ(window.lines().landmarks().size(), 1u);
    const LineLandmark& line = window.lines().landmarks().at(kComeBack);
    EXPECT_TRUE(line.triangulated);
    EXPECT_TRUE(line.anchor_views.empty());
  }
}

// The two are nearer than the limits, but images show them side by side.
TEST(LineMerging, DoesNotRecogniseALineThatIsStillThere) {
  LineWindow window;
  const auto counts = MergeOnWall(
      {{kGone, {-1, 0.5}, {1, 0.5}}, {kComeBack, {-1, 0.54}, {1, 0.54}, 14}}, &window, 22);
  EXPECT_NE(window.memory().Find(kGone), nullptr);
  EXPECT_EQ(counts.recognised, 0);
  EXPECT_EQ(window.lines().landmarks().size(), 2u);
}

TEST(LineMerging, MergesTheNextTrackIntoALineThatCameBack) {
  LineWindow window;
  const auto counts = MergeOnWall({{kGone, {-1, 0.5}, {1, 0.5}, 0, 7},
                                   {kComeBack, {-1, 0.5}, {1, 0.5}, 20, 24},
                                   {kComeBack + 1, {-1, 0.5}, {1, 0.5}, 25}},
                                  &window, kFramesAndBack);
  EXPECT_EQ(counts.recognised, 1);
  EXPECT_EQ(counts.merged, 1);
  EXPECT_EQ(window.aliases().Resolve(kComeBack + 1), kGone);
}

// Merging on a simulated flight through a room, judged by the true identity of each line.
struct FlightScore {
  int merged = 0, recognised = 0, wrong = 0;
  int redundant = 0, absorbed = 0;            // landmarks beside an older one of their line
  double landmarks = 0, lines_in_map = 0;     // triangulated, summed over the frames
  int whole_map = 0, whole_map_unmerged = 0;  // landmarks of the whole flight

  double precision() const { return 1.0 - wrong / double(merged + recognised); }
  double recall() const { return absorbed / double(redundant); }
};

using Identities = std::map<int64_t, int>;  // track to line of the world

// The landmarks beside an older one of the same line.
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

// Lines nearer than this cannot be told apart: it is their noise in the image, some metres away.
constexpr double kIndistinguishable = 0.05;  // [m]

bool IsOneLine(const simulator::LineSegment3d& a, const simulator::LineSegment3d& b) {
  const LinePairGeometry pair = Compare({a.start, a.end}, {b.start, b.end});
  return pair.angle < 0.01 && pair.distance < kIndistinguishable && pair.gap < kIndistinguishable;
}

simulator::FeatureDataset Fly(uint64_t seed, double duration) {
  auto options = testing::FlightOptions(simulator::Motion::kFast, seed);
  options.max_points = 1;
  options.line_break_probability = 0.03;  // half of the tracks break within 23 images
  options.trajectory.duration = duration;
  return simulator::SimulateFeatures(options);
}

// Calls `at_frame` with the window at each image of a flight, before anything is merged.
void FlyThrough(const simulator::FeatureDataset& data,
                const std::function<void(LineWindow*)>& at_frame) {
  LineWindow window;
  window.window().SetExtrinsic(simulator::DefaultSensors().T_B_C);
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
    const LineMap before = window->lines();
    redundant.merge(FindRedundant(before, data.line_landmark, &score));
    const LineMergingCounts counts = window->Merge();
    score.merged += counts.merged;
    score.recognised += counts.recognised;
    CollectTriangulated(window->lines(), &whole_map);
    for (const auto& [id, landmark] : before.landmarks()) {
      if (window->lines().landmarks().count(id)) continue;
      absorbed.insert(id);
      whole_map.erase(id);
      const int line = data.line_landmark.at(id);
      const int older = data.line_landmark.at(window->aliases().Resolve(id));
      score.wrong += !IsOneLine(data.world.lines[line], data.world.lines[older]);
    }
  });
  FlyThrough(
      data, [&](LineWindow* window) { CollectTriangulated(window->lines(), &whole_map_unmerged); });
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
    sum.recognised += score.recognised;
    sum.wrong += score.wrong;
    sum.redundant += score.redundant;
    sum.absorbed += score.absorbed;
    sum.landmarks += score.landmarks;
    sum.lines_in_map += score.lines_in_map;
    sum.whole_map += score.whole_map;
    sum.whole_map_unmerged += score.whole_map_unmerged;
  }
  EXPECT_GT(sum.recognised, 0);
  EXPECT_GE(sum.precision(), 0.98);
  EXPECT_GE(sum.recall(), 0.8);
  EXPECT_LT(sum.landmarks, 1.1 * sum.lines_in_map);
  EXPECT_LE(sum.whole_map, 0.5 * sum.whole_map_unmerged);
}

}  // namespace
}  // namespace plm_vins
