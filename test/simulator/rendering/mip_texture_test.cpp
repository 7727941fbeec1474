// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/mip_texture.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plm_vins::simulator {
namespace {

// 64 x 32 texels of 1 cm: upper half white, lower left black, lower right gray.
cv::Mat1b Quarters() {
  cv::Mat1b image(32, 64, uchar(255));
  image(cv::Rect(0, 16, 32, 16)) = 0;
  image(cv::Rect(32, 16, 32, 16)) = 102;
  return image;
}

TEST(MipTexture, HasItsOriginInTheLowerLeftCorner) {
  const MipTexture texture(Quarters(), 0.64, 0.32);
  EXPECT_FLOAT_EQ(texture.Sample(0.1f, 0.08f, 0), 0.0f);
  EXPECT_FLOAT_EQ(texture.Sample(0.5f, 0.08f, 0), 0.4f);
  EXPECT_FLOAT_EQ(texture.Sample(0.1f, 0.24f, 0), 1.0f);
}

TEST(MipTexture, InterpolatesHalfWayAtAnEdge) {
  const MipTexture texture(Quarters(), 0.64, 0.32);
  EXPECT_NEAR(texture.Sample(0.1f, 0.16f, 0), 0.5f, 1e-4);
  EXPECT_NEAR(texture.Sample(0.32f, 0.08f, 0), 0.2f, 1e-4);
}

TEST(MipTexture, RepeatsInBothDirections) {
  const MipTexture texture(Quarters(), 0.64, 0.32);
  EXPECT_NEAR(texture.Sample(0.5f + 3 * 0.64f, 0.08f + 2 * 0.32f, 0), 0.4f, 1e-4);
  EXPECT_NEAR(texture.Sample(0.64f, 0.08f, 0), 0.2f, 1e-3) << "between the last and the first";
}

TEST(MipTexture, AveragesOverTheFootprint) {
  const MipTexture texture(Quarters(), 0.64, 0.32);
  const float mean = (1 + 1 + 0 + 0.4f) / 4;
  EXPECT_NEAR(texture.Sample(0.1f, 0.08f, 10.0f), mean, 0.01);
  EXPECT_GT(texture.Sample(0.1f, 0.12f, 0.16f), 0.02f);
}

TEST(MipTexture, RejectsColorImages) {
  EXPECT_THROW(MipTexture(cv::Mat(), 1, 1), std::invalid_argument);
  EXPECT_THROW(MipTexture(cv::Mat(4, 4, CV_8UC3), 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plm_vins::simulator
