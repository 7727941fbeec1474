// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/estimator_options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/default_sensors.h"

namespace plm_vins {
namespace {

class EstimatorOptionsTest : public ::testing::Test {
 protected:
  EstimatorOptionsTest() {
    config_.sensor = simulator::DefaultSensors();
    focal_length_ = CameraModel::Create(config_.sensor.cameras[0].parameters)->FocalLength();
  }

  Config config_;
  double focal_length_ = 0;  // [px]
};

TEST_F(EstimatorOptionsTest, PixelsAreDividedByTheFocalLength) {
  config_.estimator.line_noise = 2;
  config_.estimator.keyframe_parallax = 12;
  config_.estimator.line_merge_image_distance = 7;
  const EstimatorOptions options(config_);
  const double noise = 2 / focal_length_;
  EXPECT_DOUBLE_EQ(options.map.line_noise, noise);
  EXPECT_DOUBLE_EQ(options.line_limits.triangulation.noise, noise);
  EXPECT_DOUBLE_EQ(options.same_line.noise, noise);
  EXPECT_DOUBLE_EQ(options.problem.line_weight, 1 / noise);
  EXPECT_DOUBLE_EQ(options.keyframes.min_parallax, 12 / focal_length_);
  EXPECT_DOUBLE_EQ(options.same_line.image_distance, 7 / focal_length_);
}

TEST_F(EstimatorOptionsTest, AnchorObservationsHaveLessWeight) {
  const EstimatorOptions options(config_);
  EXPECT_LT(options.problem.anchor_weight, 0.5 * options.problem.line_weight);
}

TEST_F(EstimatorOptionsTest, WithoutMergingThereAreNeitherAnchorsNorMemory) {
  config_.estimator.line_anchors = 5;
  config_.estimator.line_merging = true;
  EXPECT_EQ(EstimatorOptions(config_).anchors.max_anchors, 5u);
  EXPECT_TRUE(EstimatorOptions(config_).map.remember_lines);
  config_.estimator.line_merging = false;
  EXPECT_EQ(EstimatorOptions(config_).anchors.max_anchors, 0u);
  EXPECT_FALSE(EstimatorOptions(config_).map.remember_lines);
}

TEST_F(EstimatorOptionsTest, CalibrationIsEstimatedIfConfigured) {
  config_.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kFixed;
  config_.sensor.estimate_td = false;
  EXPECT_FALSE(EstimatorOptions(config_).problem.estimate_extrinsic);
  EXPECT_FALSE(EstimatorOptions(config_).problem.estimate_td);
  EXPECT_FALSE(EstimatorOptions(config_).problem.estimate_intrinsics);
  config_.sensor.estimate_extrinsic = SensorConfig::ExtrinsicMode::kRefine;
  config_.sensor.estimate_td = true;
  config_.sensor.estimate_intrinsics = true;
  EXPECT_TRUE(EstimatorOptions(config_).problem.estimate_extrinsic);
  EXPECT_TRUE(EstimatorOptions(config_).problem.estimate_td);
  EXPECT_TRUE(EstimatorOptions(config_).problem.estimate_intrinsics);
}

}  // namespace
}  // namespace plm_vins
