// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/observation_terms.h"

#include <gtest/gtest.h>

#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/map/line_map.h"
#include "vins_estimator/map/point_map.h"

namespace plm_vins {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Two cameras half a meter apart; the second one is frame 2.
SlidingWindow TwoFrames() {
  SlidingWindow window;
  window.frames.resize(2);
  window.frames[0].state.t_ns = 1;
  window.frames[1].state.t_ns = 2;
  window.frames[1].state.position() = Vector3d(0.5, 0, 0);
  return window;
}

// A point 4 m from the first frame.
PointLandmark PointOfBoth() {
  PointLandmark landmark;
  landmark.observations.resize(2);
  landmark.observations[0].t_ns = 1;
  landmark.observations[1].t_ns = 2;
  landmark.observations[1].bearing.xy = {0.3, 0.4};
  landmark.coordinates = {0.1, 0.2, 0.25};
  return landmark;
}

TEST(ExpectedRay, IsTheProjectionOfTheLandmark) {
  const PointLandmark landmark = PointOfBoth();
  const SlidingWindow window = TwoFrames();
  EXPECT_MATRIX_NEAR(ExpectedRay(landmark, landmark.observations[0], window), Vector2d(0.1, 0.2),
                     1e-12);
  EXPECT_MATRIX_NEAR(ExpectedRay(landmark, landmark.observations[1], window), Vector2d(-0.025, 0.2),
                     1e-12);
}

TEST(ExpectedRay, IsTheObservedOneBehindTheCamera) {
  const PointLandmark landmark = PointOfBoth();
  SlidingWindow window = TwoFrames();
  window.frames[1].state.position() = Vector3d(0, 0, 5);
  EXPECT_EQ(ExpectedRay(landmark, landmark.observations[1], window), Vector2d(0.3, 0.4));
}

// The second camera is at the place of frame 2.
TEST(ExpectedRay, IsInTheCameraThatObserved) {
  PointLandmark landmark = PointOfBoth();
  landmark.observations[1].t_ns = 1;
  landmark.observations[1].camera = 1;
  SlidingWindow window = TwoFrames();
  window.cameras.resize(2);
  window.cameras[1].SetExtrinsics({Eigen::Quaterniond::Identity(), Vector3d(0.5, 0, 0)});
  EXPECT_MATRIX_NEAR(ExpectedRay(landmark, landmark.observations[1], window), Vector2d(-0.025, 0.2),
                     1e-12);
}

TEST(ExpectedEnds, AreNearestToTheObservedOnes) {
  LineLandmark landmark;
  landmark.observations = {{{1, 0}, {}}, {{2, 0}, {{-0.1, 0.3}, {0.2, 0.22}}}};
  landmark.coordinates = ToOrthonormal(LineThrough({-1, 1, 4}, {1, 1, 4}));  // at y = 0.25
  const SegmentEndPoints ends = ExpectedEnds(landmark, landmark.observations[1], TwoFrames());
  EXPECT_MATRIX_NEAR(ends.start, Vector2d(-0.1, 0.25), 1e-12);
  EXPECT_MATRIX_NEAR(ends.end, Vector2d(0.2, 0.25), 1e-12);
}

TEST(ExpectedEnds, AreTheObservedOnesWithoutAnImage) {
  LineLandmark landmark;
  landmark.observations = {{{1, 0}, {}}, {{2, 0}, {{-0.1, 0.3}, {0.2, 0.22}}}};
  landmark.coordinates =
      ToOrthonormal(LineThrough({0.5, 1, 0}, {0.5, 2, 0}));  // through the camera of frame 2
  const SegmentEndPoints ends = ExpectedEnds(landmark, landmark.observations[1], TwoFrames());
  EXPECT_EQ(ends.start, Vector2d(-0.1, 0.3));
  EXPECT_EQ(ends.end, Vector2d(0.2, 0.22));
}

}  // namespace
}  // namespace plm_vins
