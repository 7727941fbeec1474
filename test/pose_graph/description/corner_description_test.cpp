// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/corner_description.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr double kDegree = M_PI / 180;

cv::Mat Clouds() {
  cv::Mat gray(201, 201, CV_8UC1);
  cv::RNG random(7);
  random.fill(gray, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(gray, gray, cv::Size(9, 9), 2.5);
  return gray;
}

// Describes the center of the image, which a rotation does not move.
Descriptor DescribeMiddle(const cv::Mat& gray, float angle) {
  return DescribeCorners(gray, {{100, 100}}, {angle}).front().value();
}

TEST(DescribeCorners, HonoursTheGivenAngle) {
  const cv::Mat gray = Clouds();
  cv::Mat turned;
  cv::rotate(gray, turned, cv::ROTATE_90_CLOCKWISE);
  const Descriptor upright = DescribeMiddle(gray, 0);
  EXPECT_LE(HammingDistance(DescribeMiddle(turned, 90), upright), 8);
  EXPECT_GE(HammingDistance(DescribeMiddle(turned, 0), upright), 80);
}

TEST(DescribeCorners, ReportsCornersTooCloseToTheBorder) {
  const auto descriptors = DescribeCorners(Clouds(), {{100, 100}, {3, 100}, {120, 90}}, {0, 0, 0});
  EXPECT_TRUE(descriptors[0]);
  EXPECT_FALSE(descriptors[1]);
  EXPECT_TRUE(descriptors[2]);
}

TEST(GravityAngle, IsDownInTheImageOfALevelCamera) {
  const Eigen::Quaterniond level = testing::LookingAhead().rotation;
  EXPECT_NEAR(GravityAngle(*testing::SimpleCamera(), level, {0, 0}), 90, 1e-3);
}

TEST(GravityAngle, TurnsWithACameraThatRolls) {
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(30 * kDegree, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond R_O_C = testing::LookingAhead().rotation * roll;
  EXPECT_NEAR(GravityAngle(*testing::SimpleCamera(), R_O_C, {0, 0}), 60, 1e-3);
}

TEST(GravityAngle, PointsToTheVanishingPointOfACameraThatLooksDown) {
  const Eigen::Quaterniond pitch(Eigen::AngleAxisd(-60 * kDegree, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond R_O_C = testing::LookingAhead().rotation * pitch;
  // Straight down is at (0, 1 / tan 60 deg) from the center; to the left of it, down points right.
  const double y = 1 / std::tan(60 * kDegree);
  EXPECT_NEAR(GravityAngle(*testing::SimpleCamera(), R_O_C, {-0.3, y}), 0, 0.2);
}

}  // namespace
}  // namespace plm_vins
