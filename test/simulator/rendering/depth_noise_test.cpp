// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/depth_noise.h"

#include <gtest/gtest.h>

namespace plm_vins::simulator {
namespace {

constexpr uint64_t kSeed = 3, kIndex = 5;
const DepthSensor kSensor = {"/depth", 0.002, 0.001, 6};

TEST(DepthNoise, GrowsWithTheSquareOfTheDepth) {
  for (const float depth : {1.0f, 2.0f, 5.0f}) {
    const cv::Mat1w measured = MeasureDepth(cv::Mat1f(100, 200, depth), kSensor, kSeed, kIndex);
    cv::Scalar mean, deviation;
    cv::meanStdDev(measured, mean, deviation);
    const double expected = 2.0 * depth * depth;  // [mm]
    EXPECT_NEAR(mean[0], 1000 * depth, 0.03 * expected);
    // Rounding to a millimeter adds 1/12 to the variance; 20000 pixels determine it to 1 %.
    EXPECT_NEAR(std::hypot(expected, std::sqrt(1.0 / 12)) / deviation[0], 1, 0.02);
  }
}

TEST(DepthNoise, NoDepthBeyondTheMaximumRange) {
  cv::Mat1f depth(2, 2, 5.99f);
  depth(0, 1) = 6.01f;
  depth(1, 0) = 0;
  const cv::Mat1w measured = MeasureDepth(depth, kSensor, kSeed, kIndex);
  EXPECT_EQ(measured(0, 1), 0);
  EXPECT_EQ(measured(1, 0), 0);
  EXPECT_NEAR(measured(0, 0), 5990, 400);
  EXPECT_NEAR(measured(1, 1), 5990, 400);
}

TEST(DepthNoise, DependsOnSeedAndImageOnly) {
  const cv::Mat1f depth(10, 10, 4.0f);
  const cv::Mat1w a = MeasureDepth(depth, kSensor, kSeed, kIndex);
  EXPECT_EQ(cv::countNonZero(a != MeasureDepth(depth, kSensor, kSeed, kIndex)), 0);
  EXPECT_GT(cv::countNonZero(a != MeasureDepth(depth, kSensor, kSeed, kIndex + 1)), 80);
  EXPECT_GT(cv::countNonZero(a != MeasureDepth(depth, kSensor, kSeed + 1, kIndex)), 80);
}

}  // namespace
}  // namespace plm_vins::simulator
