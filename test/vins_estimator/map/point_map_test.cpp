// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/point_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinAngle = 0.01;

// Four frames side by side that observe the same twenty points without noise.
class PointMapTest : public ::testing::Test {
 protected:
  PointMapTest() {
    simulator::Random random(1);
    window_.cameras[0].SetExtrinsics({SO3Exp({0.1, 0.2, -0.1}), {0.05, -0.02, 0.01}});
    for (int i = 0; i < 20; ++i) {
      points_W_.emplace_back(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(4, 7));
    }
    for (int i = 0; i < 4; ++i) AddFrame(i);
  }

  static int64_t Stamp(int frame) { return 100 + frame; }

  void AddFrame(int index) {
    WindowFrame frame;
    frame.state.t_ns = Stamp(index);
    const Rigid3d T_W_C(SO3Exp({0, -0.05 * index, 0}), {0.3 * index, 0, 0});
    frame.state.SetPose(T_W_C * window_.cameras[0].T_B_C().Inverse());
    window_.frames.push_back(frame);
    PointFrame points;
    points.t_ns = Stamp(index);
    for (size_t id = 0; id < points_W_.size(); ++id) {
      PointObservation point;
      point.id = static_cast<int64_t>(id);
      point.xy = (T_W_C.Inverse() * points_W_[id]).hnormalized();
      points.points.push_back(point);
    }
    map_.AddFrame(points, {});
  }

  void ExpectAllInPlace() const {
    for (const auto& [id, landmark] : map_.landmarks()) {
      ASSERT_TRUE(landmark.triangulated) << id;
      EXPECT_MATRIX_NEAR(PositionInWorld(landmark, window_), points_W_[id], 1e-6);
    }
  }

  PointLandmark& Landmark(int64_t id) { return map_.landmarks().at(id); }

  std::vector<Vector3d> points_W_;
  SlidingWindow window_;
  PointMap map_;
};

// Adds a second camera, which observes points as well.
class PointMapOfTwoCameras : public PointMapTest {
 protected:
  PointMapOfTwoCameras() {
    window_.cameras.resize(2);
    window_.cameras[1].SetExtrinsics(window_.cameras[0].T_B_C() *
                                     Rigid3d(SO3Exp({0.01, 0, 0.02}), {0.2, 0, 0}));
  }

  Vector2d Seen(const ImageKey& image, int64_t id) const {
    return (window_.T_W_C(image).Inverse() * points_W_[id]).hnormalized();
  }

  // Adds the observation of a point by the second camera in a frame that the first one observed.
  void AddSecond(int frame, int64_t id, const Vector2d& xy) {
    auto& observations = Landmark(id).observations;
    PointLandmark::Observation second{{Stamp(frame), 1}, {xy}};
    observations.insert(std::upper_bound(observations.begin(), observations.end(), second), second);
  }
};

TEST_F(PointMapOfTwoCameras, TriangulatesFromOneFrameWithBothOrAMeasuredDepth) {
  PointMap map;
  PointFrame points;
  points.t_ns = Stamp(0);
  const ImageKey first{Stamp(0), 0}, second{Stamp(0), 1};
  for (int id = 0; id < 3; ++id) {
    PointObservation& point = points.points.emplace_back();
    point.id = id;
    point.xy = Seen(first, id);
    if (id == 1) point.depth = (window_.T_W_C(first).Inverse() * points_W_[id]).z();
  }
  points.points.emplace_back().id = 0;
  points.points.back().camera = 1;
  points.points.back().xy = Seen(second, 0);
  map.AddFrame(points, {});
  map.Triangulate(window_, kMinAngle);
  for (int id = 0; id < 2; ++id) {
    ASSERT_TRUE(map.landmarks().at(id).triangulated) << id;
    EXPECT_MATRIX_NEAR(PositionInWorld(map.landmarks().at(id), window_), points_W_[id], 1e-6);
  }
  EXPECT_FALSE(map.landmarks().at(2).triangulated);
}

TEST_F(PointMapOfTwoCameras, ResidualsOfACameraArePerObservation) {
  map_.Triangulate(window_, kMinAngle);
  const Vector2d error(0.01, -0.02);
  AddSecond(1, 3, Seen({Stamp(1), 1}, 3) - error);
  AddSecond(0, 5, Seen({Stamp(0), 1}, 5));
  const std::vector<PointResidual> residuals = map_.ResidualsIn(1, window_);
  ASSERT_EQ(residuals.size(), 2u);
  EXPECT_EQ(residuals[0].id, 3);
  EXPECT_EQ(residuals[0].image, (ImageKey{Stamp(1), 1}));
  EXPECT_FALSE(residuals[0].is_in_host_camera);
  EXPECT_MATRIX_NEAR(residuals[0].error, error, 1e-6);
  EXPECT_MATRIX_NEAR(residuals[1].error, Vector2d(0, 0), 1e-6);
  map_.Remove(residuals[0].id, residuals[0].image);
  EXPECT_EQ(Landmark(3).observations.size(), 4u);
  EXPECT_EQ(map_.ResidualsIn(1, window_).size(), 1u);
}

TEST_F(PointMapOfTwoCameras, ObservationsInOneFrameAloneAreNotOptimized) {
  map_.Triangulate(window_, kMinAngle);
  AddSecond(0, 3, Seen({Stamp(0), 1}, 3));
  Landmark(3).observations.resize(2);
  Landmark(3).observations[0].depth = 5;
  EXPECT_FALSE(IsOptimized(Landmark(3)));
  EXPECT_FALSE(LeavesWith(Stamp(0), Landmark(3)));
}

// The newest frame becomes the host, with the observations by both cameras.
TEST_F(PointMapOfTwoCameras, ReinitializedPointsKeepTheNewestFrame) {
  map_.Triangulate(window_, kMinAngle);
  AddSecond(1, 3, Seen({Stamp(1), 1}, 3));
  AddSecond(3, 3, Seen({Stamp(3), 1}, 3));
  map_.Reinitialize(window_, Stamp(0), [](const PointLandmark&) {});
  ASSERT_EQ(Landmark(3).observations.size(), 2u);
  EXPECT_EQ(Landmark(3).host(), (ImageKey{Stamp(3), 0}));
  EXPECT_EQ(Landmark(3).observations[1], (ImageKey{Stamp(3), 1}));
  ExpectAllInPlace();
}

// The second camera goes on as host where the first one lost the point.
TEST_F(PointMapOfTwoCameras, AnyCameraMayHost) {
  map_.Triangulate(window_, kMinAngle);
  AddSecond(1, 3, Seen({Stamp(1), 1}, 3));
  AddSecond(2, 3, Seen({Stamp(2), 1}, 3));
  auto& observations = Landmark(3).observations;
  observations.erase(observations.begin() + 1);
  map_.RemoveFrame(window_, Stamp(0));
  EXPECT_EQ(Landmark(3).host(), (ImageKey{Stamp(1), 1}));
  ExpectAllInPlace();
  EXPECT_EQ(map_.RemoveOutliers(window_, 0.01), 0);
}

TEST_F(PointMapOfTwoCameras, WrongMatchesAreDroppedBeforeThePoint) {
  AddSecond(0, 3, Seen({Stamp(0), 1}, 3) + Vector2d(0.1, 0));
  map_.Triangulate(window_, kMinAngle);
  Landmark(3).coordinates[2] = 1;
  map_.RemoveOutliers(window_, /*max_error=*/0.01);
  ASSERT_EQ(map_.landmarks().size(), points_W_.size());
  EXPECT_FALSE(Landmark(3).triangulated);
  EXPECT_EQ(Landmark(3).observations.size(), 4u);
}

TEST_F(PointMapTest, DropsWrongDepthsOnly) {
  map_.Triangulate(window_, kMinAngle);
  const double z = (window_.T_W_C({Stamp(1), 0}).Inverse() * points_W_[3]).z();
  Landmark(3).observations[1].depth = z + 0.1;
  Landmark(4).observations[1].depth = 1;
  const DepthCounts counts = map_.RemoveDepthOutliers(window_, /*max_error=*/0.01);
  EXPECT_EQ(counts.used, 1);
  EXPECT_EQ(counts.rejected, 1);
  EXPECT_TRUE(Landmark(3).observations[1].depth);
  EXPECT_FALSE(Landmark(4).observations[1].depth);
}

TEST_F(PointMapTest, WrongDepthIsDroppedAndThePointTriangulatedAgain) {
  Landmark(3).observations[0].depth = 1;
  map_.Triangulate(window_, kMinAngle);
  Landmark(3).coordinates[2] = 1;
  map_.RemoveOutliers(window_, /*max_error=*/0.01);
  ASSERT_EQ(map_.landmarks().size(), points_W_.size());
  EXPECT_FALSE(Landmark(3).triangulated);
  EXPECT_FALSE(Landmark(3).observations[0].depth);
  map_.Triangulate(window_, kMinAngle);
  ExpectAllInPlace();
}

TEST_F(PointMapTest, CountsOptimizedPointsInTheNewestFrame) {
  EXPECT_EQ(map_.CountInNewest(window_), 0) << "not triangulated";
  map_.Triangulate(window_, kMinAngle);
  EXPECT_EQ(map_.CountInNewest(window_), 20);
  Landmark(3).observations.pop_back();
  EXPECT_EQ(map_.CountInNewest(window_), 19) << "out of sight";
  Landmark(4).observations.erase(Landmark(4).observations.begin(),
                                 Landmark(4).observations.begin() + 2);
  EXPECT_EQ(map_.CountInNewest(window_), 18) << "seen twice";
}

TEST_F(PointMapTest, DepthIsKnownFromTenPointsOfTheNewestFrame) {
  EXPECT_FALSE(map_.MedianDepthInNewest(window_).has_value()) << "not triangulated";
  map_.Triangulate(window_, kMinAngle);
  EXPECT_NEAR(map_.MedianDepthInNewest(window_).value(), 5.5, 1);
  for (int id = 0; id < 10; ++id) Landmark(id).observations.pop_back();
  EXPECT_TRUE(map_.MedianDepthInNewest(window_).has_value());
  Landmark(10).observations.pop_back();
  EXPECT_FALSE(map_.MedianDepthInNewest(window_).has_value());
}

TEST_F(PointMapTest, FitOfTheNewestUsesPointsOptimizedAtTheKeyframe) {
  constexpr double kMaxError = 0.01;
  map_.Triangulate(window_, kMinAngle);
  const int64_t keyframe_ns = Stamp(1);
  EXPECT_EQ(map_.FitOfNewest(window_, keyframe_ns, kMaxError).seen, 20);
  Landmark(3).observations.erase(Landmark(3).observations.begin());
  EXPECT_EQ(map_.FitOfNewest(window_, keyframe_ns, kMaxError).seen, 19) << "new at the keyframe";
  EXPECT_EQ(map_.FitOfNewest(window_, Stamp(3), kMaxError).seen, 20);
  EXPECT_EQ(map_.FitOfNewest(window_, keyframe_ns, kMaxError).contradicted, 0);
  Landmark(4).observations.back().bearing.xy.x() += 2 * kMaxError;
  EXPECT_EQ(map_.FitOfNewest(window_, keyframe_ns, kMaxError).contradicted, 1);
}

TEST_F(PointMapTest, CollectsObservationsByTime) {
  PointFrame frame;
  frame.t_ns = 200;
  frame.points.resize(2);
  frame.points[0].id = 3;
  frame.points[0].xy = Vector2d(0.1, 0.2);
  frame.points[0].velocity = Vector2d(1, 2);
  frame.points[1].id = 77;
  map_.AddFrame(frame, 0.01);
  EXPECT_EQ(map_.landmarks().size(), 21u);
  const PointLandmark::Observation& observation = Landmark(3).observations.back();
  EXPECT_EQ(Landmark(3).observations.size(), 5u);
  EXPECT_EQ(observation.t_ns, 200);
  EXPECT_EQ(observation.bearing.xy, Vector2d(0.1, 0.2));
  EXPECT_EQ(observation.bearing.velocity, Vector2d(1, 2));
  EXPECT_EQ(observation.bearing.cut_time_offset, 0.01);
  EXPECT_EQ(Landmark(77).host().t_ns, 200);
  EXPECT_EQ(Landmark(77).id, 77);
  EXPECT_FALSE(Landmark(77).triangulated);
}

TEST_F(PointMapTest, TriangulatesInTheHost) {
  map_.Triangulate(window_, kMinAngle);
  ExpectAllInPlace();
  const Vector3d p_C = window_.T_W_C({window_.frames[0].state.t_ns, 0}).Inverse() * points_W_[5];
  EXPECT_MATRIX_NEAR(PointInHost(Landmark(5).coordinates.data()), p_C, 1e-6);
}

TEST_F(PointMapTest, WaitsForAnAngleBetweenTheRays) {
  map_.Triangulate(window_, 0.5);
  for (const auto& [id, landmark] : map_.landmarks()) EXPECT_FALSE(landmark.triangulated);
}

// At standstill, a rotation that the window does not know moves all rays alike.
TEST_F(PointMapTest, UnknownRotationIsNotTakenForParallax) {
  window_.frames.resize(2);
  window_.frames[0].stationary = true;
  window_.frames[1].state.t_ns = Stamp(0) + 2'000'000'000;
  const Rigid3d T_W_C = window_.T_W_C({window_.frames[0].state.t_ns, 0});
  const Rigid3d turned(T_W_C.rotation * SO3Exp({0.03, 0, 0}),
                       T_W_C.translation + Vector3d(0, 0.01, 0));
  window_.frames[1].state.SetPose(turned * window_.cameras[0].T_B_C().Inverse());
  for (const double unnoticed_turn_rate : {0.0, 0.005, 0.02}) {
    PointMap map;
    for (const WindowFrame& frame : window_.frames) {
      PointFrame points;
      points.t_ns = frame.state.t_ns;
      for (size_t id = 0; id < points_W_.size(); ++id) {
        PointObservation& point = points.points.emplace_back();
        point.id = static_cast<int64_t>(id);
        point.xy = (T_W_C.Inverse() * points_W_[id]).hnormalized();
        // The first point has parallax in addition.
        if (id == 0 && frame.state.t_ns != Stamp(0)) point.xy.y() -= 0.02;
      }
      map.AddFrame(points, {});
    }
    map.Triangulate(window_, kMinAngle, unnoticed_turn_rate);
    for (const auto& [id, landmark] : map.landmarks()) {
      EXPECT_EQ(landmark.triangulated, id == 0 || unnoticed_turn_rate < 0.01)
          << id << ", " << unnoticed_turn_rate;
    }
  }
}

TEST_F(PointMapTest, RemovedHostTransfersItsPoints) {
  map_.Triangulate(window_, kMinAngle);
  for (const int frame : {0, 2, 1}) {
    map_.RemoveFrame(window_, Stamp(frame));
    ExpectAllInPlace();
  }
  EXPECT_EQ(Landmark(0).observations.size(), 1u);
  EXPECT_EQ(Landmark(0).host().t_ns, Stamp(3));
  map_.RemoveFrame(window_, Stamp(3));
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(PointMapTest, RestartKeepsPositionAndNewestObservation) {
  map_.Triangulate(window_, kMinAngle);
  Landmark(7).observations.pop_back();  // no longer observed
  MoveHost(window_, 1, &Landmark(8));   // has another host
  Landmark(8).observations.erase(Landmark(8).observations.begin());
  map_.RemoveFrame(window_, -1);  // of no frame: changes nothing
  const Vector3d departed_W = PositionInWorld(Landmark(7), window_);

  int departures = 0;
  map_.Reinitialize(window_, Stamp(0), [&](const PointLandmark& landmark) {
    ++departures;
    EXPECT_EQ(landmark.id, 7);
    EXPECT_MATRIX_NEAR(PositionInWorld(landmark, window_), departed_W, 1e-12);
  });
  EXPECT_EQ(departures, 1);
  EXPECT_EQ(map_.landmarks().count(7), 0u);
  EXPECT_EQ(Landmark(8).observations.size(), 3u);
  EXPECT_EQ(Landmark(9).observations.size(), 1u);
  EXPECT_EQ(Landmark(9).host().t_ns, Stamp(3));
  ExpectAllInPlace();
}

TEST_F(PointMapTest, RestartKeepsUntriangulatedPoints) {
  map_.Reinitialize(window_, Stamp(0), [](const PointLandmark&) { FAIL(); });
  EXPECT_EQ(Landmark(9).observations.size(), 4u);
}

TEST_F(PointMapTest, ReprojectionErrorIsTheDistanceInTheImage) {
  PointLandmark::Observation observation = Landmark(4).observations[2];
  observation.bearing.xy += Vector2d(0.003, 0.004);
  const auto error = ReprojectionError(points_W_[4], observation, window_);
  ASSERT_TRUE(error);
  EXPECT_NEAR(*error, 0.005, 1e-9);
  EXPECT_FALSE(ReprojectionError({0, 0, -5}, observation, window_));
}

TEST_F(PointMapTest, ReprojectionErrorHeedsTheTimeOffset) {
  PointLandmark::Observation observation = Landmark(4).observations[2];
  observation.bearing.velocity = Vector2d(0.3, 0.4);
  window_.td = 0.01;
  EXPECT_NEAR(ReprojectionError(points_W_[4], observation, window_).value(), 0.005, 1e-9);
  observation.bearing.cut_time_offset = 0.01;
  EXPECT_NEAR(ReprojectionError(points_W_[4], observation, window_).value(), 0, 1e-9);
}

TEST_F(PointMapTest, RemovesOutlierObservationsAndPoints) {
  constexpr double kMaxError = 0.01;
  map_.Triangulate(window_, kMinAngle);
  Landmark(1).observations[2].bearing.xy.x() += 0.03;  // one outlier
  for (int i = 1; i < 4; ++i)
    Landmark(2).observations[i].bearing.xy.y() += 0.015;  // outlier on average
  Landmark(3).coordinates[2] *= -1;                       // behind its host
  Landmark(4).observations.resize(2);
  Landmark(4).observations[1].bearing.xy.x() += 0.03;     // no good view beside the host's
  Landmark(5).observations[2].bearing.xy.x() += 0.015;    // the mean is an inlier
  EXPECT_EQ(map_.RemoveOutliers(window_, kMaxError), 5);  // observations of 1, 4; points 2, 3, 4
  EXPECT_EQ(Landmark(1).observations.size(), 3u);
  EXPECT_EQ(Landmark(5).observations.size(), 4u);
  EXPECT_EQ(map_.landmarks().size(), 17u);
  for (const int64_t id : {2, 3, 4}) EXPECT_EQ(map_.landmarks().count(id), 0u);
  EXPECT_EQ(map_.RemoveOutliers(window_, kMaxError), 0);
}

TEST_F(PointMapTest, RemovesByCondition) {
  map_.RemoveIf([](const PointLandmark& landmark) { return landmark.id % 2 == 0; });
  EXPECT_EQ(map_.landmarks().size(), 10u);
  EXPECT_EQ(map_.landmarks().count(2), 0u);
  map_ = PointMap();
  EXPECT_TRUE(map_.landmarks().empty());
}

}  // namespace
}  // namespace plm_vins
