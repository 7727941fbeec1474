// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/camera_pair.h"

#include <gtest/gtest.h>

#include "test/tracking/stereo/stereo_scene.h"

namespace plm_vins {
namespace {

const Eigen::Vector2d kXy(0.2, -0.15);

TEST(CameraPairTest, ProjectsLikeTheSecondCamera) {
  const CameraPair pair = StereoCameras();
  for (const double depth : {0.5, 2.0, 50.0}) {
    const Eigen::Vector3d p_S = StereoExtrinsics() * Eigen::Vector3d(depth * kXy.homogeneous());
    const auto pixel = pair.Project(kXy, 1 / depth);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - *pair.second().Project(p_S)).norm(), 1e-9) << depth;
    EXPECT_LT((*pair.Transfer(kXy, 1 / depth) - p_S.hnormalized()).norm(), 1e-12) << depth;
  }
}

TEST(CameraPairTest, InverseDepthInvertsTransfer) {
  const CameraPair pair = StereoCameras();
  for (const double inverse_depth : {-0.1, 0.0, 0.5, 2.0}) {
    const Eigen::Vector2d xy_S = *pair.Transfer(kXy, inverse_depth);
    EXPECT_NEAR(pair.InverseDepth(kXy, xy_S), inverse_depth, 1e-9);
    // An error across the epipolar line hardly matters.
    const Eigen::Vector2d along = *pair.Transfer(kXy, inverse_depth + 1e-4) - xy_S;
    const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
    EXPECT_NEAR(pair.InverseDepth(kXy, xy_S + 1e-3 * across), inverse_depth, 2e-3);
  }
}

TEST(CameraPairTest, DoesNotTransferPointsBehindTheCamera) {
  const CameraPair pair = StereoCameras({Eigen::Quaterniond::Identity(), {0, 0, -1}});
  EXPECT_TRUE(pair.Transfer(kXy, 0.9));
  EXPECT_FALSE(pair.Transfer(kXy, 1.1));  // nearer than the second camera
}

TEST(CameraPairTest, CurveFollowsTheProjectionInStepsOfAPixel) {
  const CameraPair pair = StereoCameras();
  const std::vector<CurvePoint> curve = pair.Curve(kXy, 0, 3);
  ASSERT_GT(curve.size(), 60u);
  for (size_t i = 0; i < curve.size(); ++i) {
    const auto exact = pair.Project(kXy, curve[i].inverse_depth);
    ASSERT_TRUE(exact);
    EXPECT_LT((curve[i].pixel - *exact).norm(), 0.1) << i;
    if (i > 0) {
      EXPECT_LT((curve[i].pixel - curve[i - 1].pixel).norm(), 1.2) << i;
    }
  }
  EXPECT_NEAR(curve.front().inverse_depth, 0, 1e-12);
  EXPECT_NEAR(curve.back().inverse_depth, 3, 1e-12);
}

TEST(CameraPairTest, CurveStaysInTheImage) {
  const CameraPair pair = StereoCameras();
  for (const CurvePoint& point : pair.Curve({-0.7, 0.4}, -1, 10)) {
    EXPECT_TRUE(pair.second().IsInImage(point.pixel)) << point.pixel.transpose();
  }
}

TEST(CameraPairTest, CurveOfNoBaselineEnds) {
  EXPECT_LT(StereoCameras({Eigen::Quaterniond::Identity(), {0, 0, 0}}).Curve(kXy, 0, 3).size(),
            5000u);
}

TEST(CameraPairTest, WarpIsTheDerivativeOfTheMotionOfPixels) {
  const CameraPair pair = StereoCameras();
  const auto warp = pair.Warp(kXy, 0.7);
  ASSERT_TRUE(warp);
  const Eigen::Vector2d center = *pair.first().Project(kXy.homogeneous());
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
    const auto after = pair.Project(*pair.first().Unproject(center + step), 0.7);
    const auto before = pair.Project(*pair.first().Unproject(center - step), 0.7);
    EXPECT_LT((warp->col(i) - (*after - *before) / (2 * kStep)).norm(), 1e-6);
  }
}

TEST(CameraPairTest, SwappedInvertsMatches) {
  const CameraPair pair = StereoCameras();
  const double depth = 1.7;
  const Eigen::Vector3d p_S = StereoExtrinsics() * Eigen::Vector3d(depth * kXy.homogeneous());
  const auto back = pair.Swapped().Transfer(p_S.hnormalized(), 1 / p_S.z());
  ASSERT_TRUE(back);
  EXPECT_LT((*back - kXy).norm(), 1e-12);
}

TEST(CameraPairTest, IsBuiltFromAConfigurationWithTwoCameras) {
  SensorConfig sensor;
  sensor.cameras[0].parameters = StereoCameraParameters(230, 0);
  sensor.cameras[0].T_B_C = {SO3Exp({0.1, 0.2, 0.3}), Eigen::Vector3d(1, 2, 3)};
  sensor.cameras.emplace_back();
  sensor.cameras[1].parameters = StereoCameraParameters(228, 0);
  sensor.cameras[1].T_B_C = sensor.cameras[0].T_B_C * StereoExtrinsics().Inverse();
  const CameraPair pair = CameraPairOf(sensor, {0, 1});
  EXPECT_LT((pair.T_S_C().translation - StereoExtrinsics().translation).norm(), 1e-12);
  EXPECT_LT(pair.T_S_C().rotation.angularDistance(StereoExtrinsics().rotation), 1e-12);
  EXPECT_EQ(pair.second().parameters().fx, 228);
}

}  // namespace
}  // namespace plm_vins
