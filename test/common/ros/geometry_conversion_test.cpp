// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/geometry_conversion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace plm_vins {
namespace {

constexpr int64_t kStamp = 1403636579763555584;  // from EuRoC; exceeds the precision of a double

TEST(PoseMessage, HasTheRotationsCovarianceAboutTheAxesOfTheWorld) {
  geometry_msgs::PoseWithCovariance pose;
  pose.pose = ToPose(
      {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())), {1, 2, 3}});
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  covariance(0, 3) = covariance(3, 0) = 0.5;  // of x, and rotation about x of B, y of W
  SetCovariance(covariance, &pose);
  EXPECT_NEAR(pose.covariance[0], 1, 1e-12);
  EXPECT_NEAR(pose.covariance[4], 0.5, 1e-12);
  EXPECT_NEAR(pose.covariance[21], 5, 1e-12);
  EXPECT_NEAR(pose.covariance[28], 4, 1e-12);
  const auto read = CovarianceOf(pose);
  ASSERT_TRUE(read);
  EXPECT_LT((*read - covariance).norm(), 1e-12);
}

TEST(PoseMessage, VeryLargeVariancesMeanUnknownCovariance) {
  geometry_msgs::PoseWithCovariance pose;
  pose.pose.orientation.w = 1;
  EXPECT_TRUE(CovarianceOf(pose));
  pose.covariance[35] = kUnknownVariance;
  EXPECT_FALSE(CovarianceOf(pose));
}

TEST(PoseMessage, HasTheTransform) {
  const Rigid3d T(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Eigen::Vector3d(1, 2, 3));
  const geometry_msgs::Pose pose = ToPose(T);
  EXPECT_EQ(pose.position.y, 2);
  EXPECT_EQ(pose.orientation.w, 0.5);
  EXPECT_EQ(pose.orientation.y, -0.5);
  EXPECT_EQ(ToTransform(T).translation.z, 3);
  const auto stamped = ToTransform(MakeHeader(kStamp, "world"), "body", T);
  EXPECT_EQ(ToNanoseconds(stamped.header.stamp), kStamp);
  EXPECT_EQ(stamped.header.frame_id, "world");
  EXPECT_EQ(stamped.child_frame_id, "body");
  EXPECT_EQ(stamped.transform.translation.z, 3);
  for (const Rigid3d& same : {ToRigid(pose), ToRigid(ToTransform(T))}) {
    EXPECT_EQ(same.translation, T.translation);
    EXPECT_TRUE(same.rotation.isApprox(T.rotation));
  }
}

}  // namespace
}  // namespace plm_vins
