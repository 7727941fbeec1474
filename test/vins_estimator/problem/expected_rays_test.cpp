// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/expected_rays.h"

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
  landmark.views.resize(2);
  landmark.views[0].t_ns = 1;
  landmark.views[1].t_ns = 2;
  landmark.views[1].bearing.xy = {0.3, 0.4};
  landmark.coordinates = {0.1, 0.2, 0.25};
  return landmark;
}

TEST(ExpectedRay, IsTheProjectionOfTheLandmark) {
  const PointLandmark landmark = PointOfBoth();
  const SlidingWindow window = TwoFrames();
  EXPECT_MATRIX_NEAR(ExpectedRay(landmark, landmark.views[0], window), Vector2d(0.1, 0.2), 1e-12);
  EXPECT_MATRIX_NEAR(ExpectedRay(landmark, landmark.views[1], window), Vector2d(-0.025, 0.2),
                     1e-12);
}

TEST(ExpectedRay, IsTheObservedOneBehindTheCamera) {
  const PointLandmark landmark = PointOfBoth();
  SlidingWindow window = TwoFrames();
  window.frames[1].state.position() = Vector3d(0, 0, 5);
  EXPECT_EQ(ExpectedRay(landmark, landmark.views[1], window), Vector2d(0.3, 0.4));
}

// The second camera is at the place of frame 2.
TEST(ExpectedRightRay, IsTheProjectionIntoTheSecondCamera) {
  PointLandmark landmark = PointOfBoth();
  landmark.views[0].right = Vector2d(0.3, 0.4);
  SlidingWindow window = TwoFrames();
  window.SetMounting({Eigen::Quaterniond::Identity(), Vector3d(0.5, 0, 0)});
  EXPECT_MATRIX_NEAR(ExpectedRightRay(landmark, landmark.views[0], window), Vector2d(-0.025, 0.2),
                     1e-12);
  window.SetMounting({Eigen::Quaterniond::Identity(), Vector3d(0, 0, 5)});
  EXPECT_EQ(ExpectedRightRay(landmark, landmark.views[0], window), Vector2d(0.3, 0.4));
}

TEST(ExpectedRightEnds, AreNearestToTheObservedOnes) {
  LineLandmark landmark;
  landmark.views = {{1, {}, RightSegment{{-0.1, 0.3}, {0.2, 0.52}}}};
  landmark.coordinates = ToOrthonormal(LineThrough({-1, 1, 4}, {1, 1, 4}));
  SlidingWindow window = TwoFrames();
  window.SetMounting({Eigen::Quaterniond::Identity(), Vector3d(0, -0.8, 0)});  // line at y = 0.45
  const LineSegmentView ends = ExpectedRightEnds(landmark, landmark.views[0], window);
  EXPECT_MATRIX_NEAR(ends.start, Vector2d(-0.1, 0.45), 1e-12);
  EXPECT_MATRIX_NEAR(ends.end, Vector2d(0.2, 0.45), 1e-12);
}

TEST(ExpectedEnds, AreNearestToTheObservedOnes) {
  LineLandmark landmark;
  landmark.views = {{1, {}}, {2, {{-0.1, 0.3}, {0.2, 0.22}}}};
  landmark.coordinates = ToOrthonormal(LineThrough({-1, 1, 4}, {1, 1, 4}));  // at y = 0.25
  const LineSegmentView ends = ExpectedEnds(landmark, landmark.views[1], TwoFrames());
  EXPECT_MATRIX_NEAR(ends.start, Vector2d(-0.1, 0.25), 1e-12);
  EXPECT_MATRIX_NEAR(ends.end, Vector2d(0.2, 0.25), 1e-12);
}

TEST(ExpectedEnds, AreTheObservedOnesWithoutAnImage) {
  LineLandmark landmark;
  landmark.views = {{1, {}}, {2, {{-0.1, 0.3}, {0.2, 0.22}}}};
  landmark.coordinates =
      ToOrthonormal(LineThrough({0.5, 1, 0}, {0.5, 2, 0}));  // through the camera of frame 2
  const LineSegmentView ends = ExpectedEnds(landmark, landmark.views[1], TwoFrames());
  EXPECT_EQ(ends.start, Vector2d(-0.1, 0.3));
  EXPECT_EQ(ends.end, Vector2d(0.2, 0.22));
}

}  // namespace
}  // namespace plm_vins
