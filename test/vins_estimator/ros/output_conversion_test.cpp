// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/output_conversion.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "common/geometry/so3.h"
#include "common/ros/geometry_conversion.h"
#include "test/testing/numeric_jacobian.h"

namespace plm_vins {
namespace {

const Eigen::Quaterniond kRotation = SO3Exp({0.3, -0.8, 1.2});

FrameState MakeState() {
  FrameState state;
  state.t_ns = 1403636579763555584;
  state.SetPose({kRotation, Eigen::Vector3d(1, 2, 3)});
  state.velocity() = Eigen::Vector3d(0.5, -1, 2);
  return state;
}

// An arbitrary positive definite matrix.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> MakeCovariance() {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> entry(-0.1, 0.1);
  Eigen::Matrix<double, kSize, kSize> L;
  for (int i = 0; i < L.size(); ++i) L(i) = entry(generator);
  return L * L.transpose();
}

TEST(OdometryMessage, HasPoseFramesAndTheExactStamp) {
  OutputConfig frames;
  frames.world_frame = "map";
  frames.body_frame = "imu";
  const nav_msgs::Odometry odometry = ToOdometry(MakeState(), {}, {}, frames);
  EXPECT_EQ(odometry.header.frame_id, "map");
  EXPECT_EQ(odometry.child_frame_id, "imu");
  EXPECT_EQ(odometry.header.stamp.sec, 1403636579u);
  EXPECT_EQ(odometry.header.stamp.nsec, 763555584u);
  EXPECT_EQ(odometry.pose.pose.position.z, 3);
  EXPECT_NEAR(odometry.pose.pose.orientation.w, kRotation.w(), 1e-12);
}

TEST(OdometryMessage, TwistIsInTheBody) {
  const nav_msgs::Odometry odometry = ToOdometry(MakeState(), {}, {0.1, 0.2, 0.3}, {});
  const auto& v = odometry.twist.twist.linear;
  EXPECT_MATRIX_NEAR(kRotation * Eigen::Vector3d(v.x, v.y, v.z), Eigen::Vector3d(0.5, -1, 2),
                     1e-12);
  EXPECT_EQ(odometry.twist.twist.angular.y, 0.2);
}

TEST(OdometryMessage, UnknownCovarianceIsVeryLarge) {
  EstimatedFrame good;
  good.output.uncertainty.emplace();
  good.output.uncertainty->pose = MakeCovariance<6>();
  good.output.uncertainty->body_velocity = MakeCovariance<3>();
  good.angular_velocity_variance = 0.1;
  EXPECT_EQ(CovarianceOf(good).pose, good.output.uncertainty->pose);
  EXPECT_EQ(CovarianceOf(good).velocity, good.output.uncertainty->body_velocity);
  EXPECT_EQ(CovarianceOf(good).angular_velocity, 0.1);
  EXPECT_GE(CovarianceOf(EstimatedFrame()).pose.diagonal().minCoeff(), 1e6);
  EXPECT_GE(CovarianceOf(EstimatedFrame()).velocity.diagonal().minCoeff(), 1e6);
  EstimatedFrame bad;
  bad.output.uncertainty.emplace();
  for (const double value : {0.0, std::numeric_limits<double>::quiet_NaN(), 1.0 / 0.0}) {
    bad.output.uncertainty->pose.setConstant(value);
    bad.output.uncertainty->body_velocity.setConstant(value);
    bad.angular_velocity_variance = value;
    const StateCovariance covariance = CovarianceOf(bad);
    EXPECT_TRUE(covariance.pose.allFinite() && covariance.velocity.allFinite());
    EXPECT_GE(covariance.pose.diagonal().minCoeff(), 1e6);
    EXPECT_GE(covariance.velocity.diagonal().minCoeff(), 1e6);
    EXPECT_GE(covariance.angular_velocity, 1e6);
  }
}

// Draws errors of the state and compares their covariance in the convention of the message.
TEST(OdometryMessage, CovariancesAreAboutTheAxesOfTheMessage) {
  StateCovariance covariance;
  covariance.pose = MakeCovariance<6>();
  covariance.velocity = MakeCovariance<3>();
  covariance.angular_velocity = 0.04;
  const nav_msgs::Odometry odometry = ToOdometry(MakeState(), covariance, {}, {});

  // Central differences of (p, Log(R' R^T)) at R' = R Exp(theta): rotation about world axes.
  const auto in_message = [](const Eigen::Matrix<double, 6, 1>& error) {
    Eigen::VectorXd result(6);
    const Eigen::Quaterniond moved = kRotation * SO3Exp(error.tail<3>());
    result << error.head<3>(), SO3Log(moved * kRotation.conjugate());
    return result;
  };
  const Eigen::Matrix<double, 6, 1> no_error = Eigen::Matrix<double, 6, 1>::Zero();
  const Eigen::MatrixXd J = testing::NumericJacobian(in_message, no_error);
  EXPECT_MATRIX_NEAR(Eigen::Map<const RowMajor6d>(odometry.pose.covariance.data()),
                     J * covariance.pose * J.transpose(), 1e-8);

  const Matrix6d twist = Eigen::Map<const RowMajor6d>(odometry.twist.covariance.data());
  EXPECT_MATRIX_NEAR((twist.topLeftCorner<3, 3>()), covariance.velocity, 1e-15);
  EXPECT_EQ(twist.diagonal().tail<3>(), Eigen::Vector3d::Constant(0.04));
}

TEST(CloudMessage, HasThePoints) {
  const sensor_msgs::PointCloud cloud = ToPointCloud({{1, {1, 2, 3}}, {2, {4, 5, 6}}}, 5, "world");
  EXPECT_EQ(cloud.header.frame_id, "world");
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.points[1].y, 5);
}

TEST(Markers, KeyPosesAreTheWindow) {
  const auto marker = ToKeyPoses({MakeState(), MakeState()}, 5, "world");
  ASSERT_EQ(marker.points.size(), 2u);
  EXPECT_EQ(marker.points[0].x, 1);
  EXPECT_GT(marker.color.a, 0);
}

TEST(Markers, CameraIsAPyramidOfEightLines) {
  const auto markers = ToCameraVisual(Rigid3d(), 5, "world");
  ASSERT_EQ(markers.markers.size(), 1u);
  EXPECT_EQ(markers.markers[0].points.size(), 16u);
}

}  // namespace
}  // namespace plm_vins
