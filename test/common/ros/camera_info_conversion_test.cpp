// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/camera_info_conversion.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace plm_vins {
namespace {

using Model = CameraParameters::Model;

CameraParameters Camera(Model model) {
  CameraParameters camera;
  camera.model = model;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 458.5;
  camera.fy = 457;
  camera.cx = 321;
  camera.cy = 239;
  camera.distortion = {-0.25, 0.125, 0.5, -0.0625};
  if (model == Model::kMei) camera.xi = 0.75;
  return camera;
}

class CameraInfoOfModel : public ::testing::TestWithParam<Model> {};

TEST_P(CameraInfoOfModel, SurvivesARoundTrip) {
  const CameraParameters camera = Camera(GetParam());
  const CameraParameters back = ToCameraParameters(ToCameraInfo(camera, 7, "camera"));
  EXPECT_EQ(back.model, camera.model);
  EXPECT_EQ(back.width, camera.width);
  EXPECT_EQ(back.height, camera.height);
  EXPECT_EQ(back.intrinsics(), camera.intrinsics());
  EXPECT_EQ(back.xi, camera.xi);
}

INSTANTIATE_TEST_SUITE_P(All, CameraInfoOfModel,
                         ::testing::Values(Model::kPinholeRadtan, Model::kPinholeEquidistant,
                                           Model::kMei));

TEST(CameraInfoMessage, HasTheLayoutOfRos) {
  const auto message = ToCameraInfo(Camera(Model::kPinholeRadtan), 1'500'000'000, "camera");
  EXPECT_EQ(message.header.frame_id, "camera");
  EXPECT_EQ(message.header.stamp.nsec, 500'000'000u);
  EXPECT_EQ(message.distortion_model, "plumb_bob");
  EXPECT_EQ(message.D, (std::vector<double>{-0.25, 0.125, 0.5, -0.0625, 0}));
  EXPECT_EQ(message.K[0], 458.5);
  EXPECT_EQ(message.K[5], 239);
  EXPECT_EQ(message.P[2], 321);
}

TEST(CameraInfoMessage, IsRejectedWithAnUnknownModelOrTooFewCoefficients) {
  auto message = ToCameraInfo(Camera(Model::kPinholeRadtan), 0, "");
  message.distortion_model = "rational_polynomial";
  EXPECT_THROW(ToCameraParameters(message), std::invalid_argument);
  message.distortion_model = "plumb_bob";
  message.D.resize(4);
  EXPECT_THROW(ToCameraParameters(message), std::invalid_argument);
}

}  // namespace
}  // namespace plm_vins
