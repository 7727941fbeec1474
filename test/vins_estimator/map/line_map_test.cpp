// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMaxLength = 10;
constexpr double kNoise = 1.0 / 460;  // normalized
constexpr int kLines = 20;

struct Segment {
  Vector3d start, end;

  double length() const { return (end - start).norm(); }
};

Vector3d RandomPoint(simulator::Random* random) {
  const double x = random->Uniform(-1, 1), y = random->Uniform(-1, 1);
  return {x, y, random->Uniform(4, 7)};
}

// Four frames, each to the side of and above the previous one, that observe twenty lines without
// noise.
class LineMapTest : public ::testing::Test {
 protected:
  LineMapTest() {
    simulator::Random random(1);
    window_.cameras[0].SetExtrinsics({SO3Exp({0.1, 0.2, -0.1}), {0.05, -0.02, 0.01}});
    while (segments_W_.size() < kLines) {
      const Segment segment{RandomPoint(&random), RandomPoint(&random)};
      if (segment.length() > 1) segments_W_.push_back(segment);
    }
    for (int i = 0; i < 4; ++i) AddFrame(i);
  }

  static int64_t Stamp(int frame) { return 100 + frame; }

  void AddFrame(int index) {
    WindowFrame frame;
    frame.state.t_ns = Stamp(index);
    const Rigid3d T_W_C(SO3Exp({0.03 * index, -0.05 * index, 0}),
                        {0.3 * index, 0.1 * index * index, 0});
    frame.state.SetPose(T_W_C * window_.cameras[0].T_B_C().Inverse());
    window_.frames.push_back(frame);
    map_.AddFrame(Observe(segments_W_, index));
  }

  Rigid3d T_C_W(int frame) const {
    return window_.T_W_C({window_.frames[frame].state.t_ns, 0}).Inverse();
  }

  // Observes segment i with id i.
  LineFrame Observe(const std::vector<Segment>& segments_W, int frame) const {
    LineFrame lines;
    lines.t_ns = Stamp(frame);
    for (size_t id = 0; id < segments_W.size(); ++id) {
      const SegmentEndPoints view = See(segments_W[id], frame);
      lines.lines.push_back({static_cast<int64_t>(id), view.start, view.end});
    }
    return lines;
  }

  SegmentEndPoints See(const Segment& segment_W, int frame) const {
    return {(T_C_W(frame) * segment_W.start).hnormalized(),
            (T_C_W(frame) * segment_W.end).hnormalized()};
  }

  LineTriangulationCounts Triangulate(double max_length = kMaxLength) {
    return map_.Triangulate(window_, LineLimits(kNoise, max_length));
  }

  void ExpectInPlace(const LineLandmark& landmark) const {
    ASSERT_TRUE(landmark.triangulated) << landmark.id;
    const PluckerLine line = LineInWorld(landmark, window_);
    const Segment& truth = segments_W_[landmark.id];
    for (const Vector3d& end : {truth.start, truth.end}) {
      const double distance = (end.cross(line.direction) - line.moment).norm();
      EXPECT_LT(distance / line.direction.norm(), 1e-5) << landmark.id;
    }
  }

  void ExpectAllInPlace() const {
    for (const auto& [id, landmark] : map_.landmarks()) ExpectInPlace(landmark);
  }

  LineLandmark& Landmark(int64_t id) { return map_.landmarks().at(id); }

  // The first frame leaves the window and becomes an anchor with its observations.
  void TurnOldestIntoAnchor() {
    for (auto& [id, landmark] : map_.landmarks()) {
      MoveHost(window_, 1, &landmark);
      landmark.anchor_observations = {landmark.observations.front()};
      landmark.observations.erase(landmark.observations.begin());
    }
    window_.TurnOldestIntoAnchor();
  }

  // Moves an observation perpendicular to itself.
  static void Shift(double distance, LineLandmark::Observation* observation) {
    const Vector2d along = (observation->segment.end - observation->segment.start).normalized();
    const Vector2d shift = distance * Vector2d(-along.y(), along.x());
    observation->segment.start += shift;
    observation->segment.end += shift;
  }

  std::vector<Segment> segments_W_;
  SlidingWindow window_;
  LineMap map_;
};

TEST_F(LineMapTest, CollectsObservationsByTime) {
  LineFrame frame;
  frame.t_ns = 200;
  frame.lines = {{3, {0.1, 0.2}, {0.3, 0.4}}, {77, {0, 0}, {1, 0}}};
  map_.AddFrame(frame);
  EXPECT_EQ(map_.landmarks().size(), kLines + 1u);
  const LineLandmark::Observation& last = Landmark(3).observations.back();
  EXPECT_EQ(Landmark(3).observations.size(), 5u);
  EXPECT_EQ(last.t_ns, 200);
  EXPECT_EQ(last.segment.start, Vector2d(0.1, 0.2));
  EXPECT_EQ(last.segment.end, Vector2d(0.3, 0.4));
  EXPECT_EQ(Landmark(77).host().t_ns, 200);
  EXPECT_EQ(Landmark(77).id, 77);
  EXPECT_FALSE(Landmark(77).triangulated);
}

TEST_F(LineMapTest, IgnoresZeroLengthSegments) {
  const double nan = std::nan("");
  LineFrame frame;
  frame.t_ns = 200;
  frame.lines = {{3, {0.1, 0.2}, {0.1, 0.2}}, {77, {0, 0}, {0, 0}}, {78, {nan, 0}, {1, 0}}};
  map_.AddFrame(frame);
  EXPECT_EQ(Landmark(3).observations.size(), 4u);
  EXPECT_EQ(map_.landmarks().count(77), 0u);
  EXPECT_EQ(map_.landmarks().count(78), 0u);
}

TEST_F(LineMapTest, AFrameMayHaveNoLines) {
  map_.AddFrame(LineFrame());
  EXPECT_EQ(map_.landmarks().size(), static_cast<size_t>(kLines));
  LineMap empty;
  empty.AddFrame(LineFrame());
  EXPECT_TRUE(empty.landmarks().empty());
  EXPECT_EQ(empty.Triangulate(window_, LineLimits(kNoise, kMaxLength)).triangulated, 0);
  EXPECT_EQ(empty.RemoveOutliers(window_, LineLimits(kNoise, kMaxLength)), 0);
  empty.RemoveFrame(window_, Stamp(0));
  empty.Reinitialize(window_, Stamp(0), [](const LineLandmark&) { FAIL(); });
}

TEST_F(LineMapTest, TriangulatesInTheHost) {
  const LineTriangulationCounts counts = Triangulate();
  EXPECT_EQ(counts.triangulated, kLines);
  EXPECT_EQ(counts.degenerate + counts.behind + counts.inconsistent + counts.too_long, 0);
  ExpectAllInPlace();
  const PluckerLine line_C = ToPlucker(Landmark(5).coordinates.data());
  const LineEnds ends = EndsOf(line_C, Landmark(5).host().segment);
  EXPECT_MATRIX_NEAR(ends.start, T_C_W(0) * segments_W_[5].start, 1e-5);
  EXPECT_EQ(Triangulate().triangulated, 0);  // nothing left to do
}

TEST_F(LineMapTest, WaitsForObservations) {
  map_ = LineMap();
  for (const int frame : {0, 3}) map_.AddFrame(Observe(segments_W_, frame));
  const LineTriangulationCounts counts = Triangulate();
  EXPECT_EQ(counts.triangulated + counts.degenerate, 0);
  EXPECT_EQ(map_.landmarks().size(), static_cast<size_t>(kLines));
}

TEST_F(LineMapTest, CountsByCauseAndRemovesImpossibleLines) {
  const Segment behind_W{{-1, 0, -4}, {1, 1, -5}}, long_W{{-6, 1, 5}, {6, 2, 6}};
  for (int i = 0; i < 4; ++i) {
    Landmark(1).observations[i] = Landmark(1).observations[0];
    Landmark(2).observations[i].segment = See(behind_W, i);
    Landmark(4).observations[i].segment = See(long_W, i);
  }
  Shift(0.05, &Landmark(3).observations[1]);
  const LineTriangulationCounts counts = Triangulate();
  EXPECT_EQ(counts.degenerate, 1);
  EXPECT_EQ(counts.behind, 1);
  EXPECT_EQ(counts.inconsistent, 1);
  EXPECT_EQ(counts.too_long, 1);
  EXPECT_EQ(counts.triangulated, kLines - 4);
  EXPECT_EQ(map_.landmarks().size(), kLines - 3u);
  EXPECT_FALSE(Landmark(1).triangulated);  // waits for more observations
  for (const int64_t id : {2, 3, 4}) EXPECT_EQ(map_.landmarks().count(id), 0u);
}

TEST_F(LineMapTest, DegenerateLinesWaitAndAreFoundLater) {
  const std::vector<LineLandmark::Observation> all = Landmark(6).observations;
  Landmark(6).observations = {all[0], all[0], all[0]};  // as if the camera had not moved
  EXPECT_EQ(Triangulate().degenerate, 1);
  EXPECT_FALSE(Landmark(6).triangulated);
  Landmark(6).observations = all;
  EXPECT_EQ(Triangulate().triangulated, 1);
  ExpectAllInPlace();
}

TEST_F(LineMapTest, RemovedHostTransfersItsLines) {
  Triangulate();
  for (const int frame : {0, 2, 1}) {
    map_.RemoveFrame(window_, Stamp(frame));
    ExpectAllInPlace();
  }
  EXPECT_EQ(Landmark(0).observations.size(), 1u);
  EXPECT_EQ(Landmark(0).host().t_ns, Stamp(3));
  map_.RemoveFrame(window_, Stamp(3));
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(LineMapTest, HostOnTheLineIsRejected) {
  Triangulate();
  const Segment& segment = segments_W_[7];
  const Vector3d on_the_line = 0.5 * (segment.start + segment.end);
  WindowFrame& next = window_.frames[1];
  const Rigid3d T_W_C(window_.T_W_C({next.state.t_ns, 0}).rotation, on_the_line);
  next.state.SetPose(T_W_C * window_.cameras[0].T_B_C().Inverse());
  MoveHost(window_, 1, &Landmark(7));
  EXPECT_FALSE(Landmark(7).triangulated);
}

TEST_F(LineMapTest, ObservedSegmentIsTheUnionOfObservations) {
  Triangulate();
  const Segment& whole = segments_W_[3];
  const auto at = [&whole](double share) -> Vector3d {
    return whole.start + share * (whole.end - whole.start);
  };
  Landmark(3).observations[0].segment = See({at(0.3), at(0.6)}, 0);
  Landmark(3).observations[1].segment = See({at(0.7), at(0.4)}, 1);  // reversed
  Landmark(3).observations[2].segment = See({at(0.5), at(0.55)}, 2);
  Landmark(3).observations[3].segment = See({at(0.2), at(0.3)}, 3);
  const auto seen = ObservedSegment(Landmark(3), window_);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->id, 3);
  const bool forward = (seen->end_W - seen->start_W).dot(whole.end - whole.start) > 0;
  EXPECT_MATRIX_NEAR(forward ? seen->start_W : seen->end_W, at(0.2), 1e-5);
  EXPECT_MATRIX_NEAR(forward ? seen->end_W : seen->start_W, at(0.7), 1e-5);
}

TEST_F(LineMapTest, ObservedSegmentIsInFrontOfItsCameras) {
  Triangulate();
  WindowFrame& frame = window_.frames[2];
  const Rigid3d turned(SO3Exp({0, M_PI, 0}), Vector3d::Zero());
  const Rigid3d T_W_C = window_.T_W_C({frame.state.t_ns, 0}) * turned;
  frame.state.SetPose(T_W_C * window_.cameras[0].T_B_C().Inverse());
  EXPECT_FALSE(ObservedSegment(Landmark(3), window_));
}

TEST_F(LineMapTest, RemovesOutlierObservationsAndLines) {
  const LineLimits limits(kNoise, kMaxLength);
  Triangulate();
  Shift(6 * kNoise, &Landmark(1).observations[2]);  // one outlier
  for (int i = 0; i < 4; ++i)
    Shift(4 * kNoise, &Landmark(2).observations[i]);  // outlier on average
  for (int i = 1; i < 4; ++i) Shift(6 * kNoise, &Landmark(3).observations[i]);  // all outliers
  Shift(4 * kNoise, &Landmark(5).observations[2]);  // the mean is an inlier
  EXPECT_EQ(map_.RemoveOutliers(window_, limits), 1 + 1 + (3 + 1));
  EXPECT_EQ(Landmark(1).observations.size(), 3u);
  EXPECT_EQ(Landmark(5).observations.size(), 4u);
  EXPECT_EQ(map_.landmarks().count(2), 0u);
  EXPECT_EQ(map_.landmarks().count(3), 0u);
  EXPECT_EQ(map_.landmarks().size(), kLines - 2u);
  ExpectAllInPlace();
  EXPECT_EQ(map_.RemoveOutliers(window_, limits), 0);
}

TEST_F(LineMapTest, RemovesLinesBehindTheirCamerasAndLinesTooLong) {
  Triangulate();
  const Rigid3d T_C_W0 = T_C_W(0);
  const Segment& segment = segments_W_[4];  // mirrored in the camera: same image
  Landmark(4).coordinates =
      ToOrthonormal(LineThrough(-(T_C_W0 * segment.start), -(T_C_W0 * segment.end)));
  Landmark(4).observations.resize(1);
  Landmark(4).observations.push_back(Landmark(4).observations[0]);
  window_.frames.push_back(window_.frames[0]);  // at the same pose
  window_.frames.back().state.t_ns = Landmark(4).observations[1].t_ns = Stamp(4);
  EXPECT_EQ(map_.RemoveOutliers(window_, LineLimits(kNoise, kMaxLength)), 1);
  EXPECT_EQ(map_.landmarks().count(4), 0u);

  const LineLimits limits(kNoise, /*max_length=*/2);
  const auto is_short = [](const Segment& s) { return s.length() <= 2; };
  segments_W_[4] = {Vector3d::Zero(), 3 * Vector3d::UnitX()};  // gone already
  const auto expected = std::count_if(segments_W_.begin(), segments_W_.end(), is_short);
  map_.RemoveOutliers(window_, limits);
  EXPECT_EQ(map_.landmarks().size(), static_cast<size_t>(expected));
  EXPECT_GT(expected, 0);
  EXPECT_LT(expected, kLines - 1);
}

TEST_F(LineMapTest, DoesNotJudgeUntriangulatedOrSingleObservations) {
  for (LineLandmark::Observation& o : Landmark(2).observations) {
    Shift(o.t_ns == Stamp(1) ? 0.1 : 0, &o);
  }
  EXPECT_EQ(map_.RemoveOutliers(window_, LineLimits(kNoise, kMaxLength)), 0);
  EXPECT_EQ(Landmark(2).observations.size(), 4u);
  Triangulate();
  Landmark(3).observations.resize(1);
  Shift(0.1, &Landmark(3).observations[0]);
  EXPECT_EQ(map_.RemoveOutliers(window_, LineLimits(kNoise, kMaxLength)), 0);
  EXPECT_EQ(map_.landmarks().count(3), 1u);
}

TEST_F(LineMapTest, RemovesContradictingAnchorObservations) {
  const LineLimits limits(kNoise, kMaxLength);
  Triangulate();
  TurnOldestIntoAnchor();
  Shift(4 * kNoise, &Landmark(1).anchor_observations[0]);
  EXPECT_EQ(map_.RemoveOutliers(window_, limits), 0);
  Shift(2 * kNoise, &Landmark(1).anchor_observations[0]);
  EXPECT_EQ(map_.RemoveOutliers(window_, limits), 1);
  EXPECT_TRUE(Landmark(1).anchor_observations.empty());
  EXPECT_EQ(Landmark(1).observations.size(), 3u);
  EXPECT_EQ(Landmark(2).anchor_observations.size(), 1u);
  ExpectAllInPlace();
}

TEST_F(LineMapTest, RemovesObservationsOfARemovedAnchor) {
  Triangulate();
  TurnOldestIntoAnchor();
  LineLandmark::Observation of_another;
  of_another.t_ns = 50;
  Landmark(1).anchor_observations.push_back(of_another);
  map_.RemoveAnchor(Stamp(0));
  ASSERT_EQ(Landmark(1).anchor_observations.size(), 1u);
  EXPECT_EQ(Landmark(1).anchor_observations[0].t_ns, 50);
  EXPECT_TRUE(Landmark(2).anchor_observations.empty());
  EXPECT_EQ(Landmark(1).observations.size(), 3u);
}

TEST_F(LineMapTest, RestartDropsAnchorObservations) {
  Triangulate();
  TurnOldestIntoAnchor();
  Landmark(8).observations.erase(Landmark(8).observations.begin() + 1,
                                 Landmark(8).observations.end());
  map_.Reinitialize(window_, Stamp(1), [](const LineLandmark&) { FAIL(); });
  EXPECT_EQ(Landmark(7).observations.size(), 1u);
  EXPECT_TRUE(Landmark(7).anchor_observations.empty());
  EXPECT_EQ(Landmark(8).anchor_observations.size(), 1u);  // was not marginalized
  ExpectInPlace(Landmark(7));
}

}  // namespace
}  // namespace plm_vins
