// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/local_map.h"

#include <gtest/gtest.h>

#include <set>

#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNoise = 1 / 460.0;
constexpr int64_t kPoint = 1, kLine = 2;
const Vector3d kPoint_W(0.1, 0.2, 5);
const Vector3d kStart_W(-1, 0.5, 5), kEnd_W(1, 0.6, 5);

int64_t Stamp(int frame) { return 100 + frame; }

// Cameras that move sideways and up, and observe a point and a line.
class LocalMapTest : public ::testing::Test {
 protected:
  void AddFrame(int index, bool with_landmarks = true, int64_t line_id = kLine) {
    const Vector3d p_W(0.2 * index, 0.1 * index, 0);
    WindowFrame frame;
    frame.state.t_ns = Stamp(index);
    frame.state.position() = p_W;
    frame.motion_since_previous = std::make_shared<Preintegration>(ImuNoise(), ImuBias());
    PointFrame points;
    LineFrame lines;
    points.t_ns = lines.t_ns = Stamp(index);
    if (with_landmarks) {
      points.points.push_back({kPoint, (kPoint_W - p_W).hnormalized(), {}, Vector2d::Zero()});
      lines.lines.push_back(
          {line_id, (kStart_W - p_W).hnormalized(), (kEnd_W - p_W).hnormalized()});
    }
    map_.AddFrame(frame, points, lines);
  }

  void Triangulate() {
    map_.points.Triangulate(map_.window, /*min_angle=*/0.01);
    map_.lines.Triangulate(map_.window, LineLimits(kNoise, /*max_length=*/10));
  }

  // Throws if an observation is by a removed frame.
  void ExpectInStep() const {
    std::set<int64_t> frames, anchors;
    for (const WindowFrame& frame : map_.window.frames) frames.insert(frame.state.t_ns);
    for (const AnchorFrame& anchor : map_.window.anchors) anchors.insert(anchor.state.t_ns);
    for (const auto& [id, point] : map_.points.landmarks()) {
      for (const PointLandmark::Observation& observation : point.observations)
        EXPECT_EQ(frames.count(observation.t_ns), 1u);
    }
    for (const auto& [id, line] : map_.lines.landmarks()) {
      for (const LineLandmark::Observation& observation : line.observations)
        EXPECT_EQ(frames.count(observation.t_ns), 1u);
      for (const LineLandmark::Observation& observation : line.anchor_observations)
        EXPECT_EQ(anchors.count(observation.t_ns), 1u);
    }
    for (const auto& [id, line] : map_.memory.lines()) {
      for (const LineLandmark::Observation& observation : line.anchor_observations)
        EXPECT_EQ(anchors.count(observation.t_ns), 1u);
    }
  }

  const LineLandmark& Line(int64_t id) const { return map_.lines.landmarks().at(id); }

  LocalMap map_{LocalMapOptions(kNoise, /*remember_lines=*/true)};
};

TEST_F(LocalMapTest, DropsTheSecondNewestFrameWithItsObservations) {
  for (int i = 0; i < 4; ++i) AddFrame(i);
  map_.DropSecondNewest();
  EXPECT_EQ(map_.window.frames.size(), 3u);
  EXPECT_EQ(map_.window.newest().state.t_ns, Stamp(3));
  EXPECT_EQ(Line(kLine).observations.size(), 3u);
  ExpectInStep();
}

TEST_F(LocalMapTest, ObservedLandmarksSurviveTheirHost) {
  for (int i = 0; i < 4; ++i) AddFrame(i);
  Triangulate();
  const DepartedLandmarks departed = map_.SlideOldest(/*stays_as_anchor=*/false);
  EXPECT_TRUE(departed.points.empty());
  EXPECT_TRUE(departed.lines.empty());
  EXPECT_EQ(map_.window.frames.front().state.t_ns, Stamp(1));
  EXPECT_EQ(Line(kLine).host().t_ns, Stamp(3));
  ExpectInStep();
}

TEST_F(LocalMapTest, ReportsLandmarksThatLeaveWithTheOldestFrame) {
  for (int i = 0; i < 4; ++i) AddFrame(i);
  AddFrame(4, /*with_landmarks=*/false);
  Triangulate();
  const DepartedLandmarks departed = map_.SlideOldest(/*stays_as_anchor=*/false);
  ASSERT_EQ(departed.points.size(), 1u);
  EXPECT_EQ(departed.points[0].id, kPoint);
  EXPECT_MATRIX_NEAR(departed.points[0].p_W, kPoint_W, 1e-6);
  ASSERT_EQ(departed.lines.size(), 1u);
  EXPECT_EQ(departed.lines[0].id, kLine);
  EXPECT_MATRIX_NEAR(departed.lines[0].start_W, kStart_W, 1e-5);
  EXPECT_MATRIX_NEAR(departed.lines[0].end_W, kEnd_W, 1e-5);
  EXPECT_TRUE(map_.points.landmarks().empty());
  EXPECT_TRUE(map_.lines.landmarks().empty());
}

TEST_F(LocalMapTest, RemembersLinesThatLeaveUnlessToldNotTo) {
  for (const bool remember : {true, false}) {
    map_ = LocalMap(LocalMapOptions(kNoise, remember));
    for (int i = 0; i < 4; ++i) AddFrame(i);
    Triangulate();
    map_.SlideOldest(/*stays_as_anchor=*/true);
    EXPECT_EQ(map_.memory.Find(kLine) != nullptr, remember);
  }
}

TEST_F(LocalMapTest, RemovingAnAnchorRemovesItsObservations) {
  for (int i = 0; i < 4; ++i) AddFrame(i);
  Triangulate();
  map_.SlideOldest(/*stays_as_anchor=*/true);
  ASSERT_EQ(map_.memory.Find(kLine)->anchor_observations.size(), 1u);
  map_.lines.landmarks().at(kLine).anchor_observations =
      map_.memory.Find(kLine)->anchor_observations;
  ExpectInStep();
  map_.RemoveAnchor(Stamp(0));
  EXPECT_TRUE(map_.window.anchors.empty());
  EXPECT_TRUE(map_.memory.Find(kLine)->anchor_observations.empty());
  EXPECT_TRUE(Line(kLine).anchor_observations.empty());
}

TEST_F(LocalMapTest, AbsorbedLineContinuesUnderTheOlderId) {
  for (int i = 0; i < 2; ++i) AddFrame(i);
  for (int i = 2; i < 4; ++i) AddFrame(i, /*with_landmarks=*/true, /*line_id=*/9);
  LineLandmark joint = Line(kLine);
  joint.observations.insert(joint.observations.end(), Line(9).observations.begin(),
                            Line(9).observations.end());
  map_.AbsorbLine(9, joint);
  EXPECT_EQ(map_.lines.landmarks().count(9), 0u);
  AddFrame(4, /*with_landmarks=*/true, /*line_id=*/9);
  EXPECT_EQ(Line(kLine).observations.size(), 5u);
}

TEST_F(LocalMapTest, RecognizedLineContinuesUnderItsOldId) {
  for (int i = 0; i < 4; ++i) AddFrame(i);
  AddFrame(4, /*with_landmarks=*/false);
  Triangulate();
  map_.SlideOldest(/*stays_as_anchor=*/true);
  AddFrame(5, /*with_landmarks=*/true, /*line_id=*/9);
  map_.ReviveLine(9, kLine);
  EXPECT_EQ(map_.lines.landmarks().count(9), 0u);
  EXPECT_EQ(Line(kLine).id, kLine);
  ASSERT_EQ(Line(kLine).anchor_observations.size(), 1u);
  EXPECT_EQ(Line(kLine).anchor_observations[0].t_ns, Stamp(0));
  AddFrame(6, /*with_landmarks=*/true, /*line_id=*/9);
  EXPECT_EQ(Line(kLine).observations.size(), 2u);
  ExpectInStep();
}

TEST_F(LocalMapTest, DropsTheTracksOfARemovedLine) {
  for (int i = 0; i < 2; ++i) AddFrame(i);
  map_.aliases.Add(9, kLine);
  map_.ForgetIdleAliases();
  EXPECT_EQ(map_.aliases.Resolve(9), kLine);
  map_.lines = LineMap();
  map_.ForgetIdleAliases();
  EXPECT_EQ(map_.aliases.Resolve(9), 9);
}

}  // namespace
}  // namespace plm_vins
