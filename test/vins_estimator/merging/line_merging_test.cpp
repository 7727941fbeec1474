// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_merging.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "test/testing/numeric_jacobian.h"
#include "test/vins_estimator/line_window.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::kWindowSize;
using testing::LineWindow;

// A wall five metres ahead of a camera that moves sideways and up. Lines lie on the wall, in metres
// right and down from the point ahead.
struct WallLine {
  int64_t id;
  Vector2d start, end;
  int first_frame = 0, last_frame = 100;  // that show it
};

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

}  // namespace
}  // namespace plm_vins
