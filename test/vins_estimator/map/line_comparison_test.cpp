// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"
#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/map/line_map.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

constexpr double kFocalLength = 460;  // [px]
constexpr double kNoise = 1 / kFocalLength;

LinePairGeometry Pair(double angle, double distance, double gap) {
  LinePairGeometry pair;
  pair.angle = angle;
  pair.distance = distance;
  pair.gap = gap;
  return pair;
}

TEST(FindDifference, NamesTheFirstExceededLimit) {
  const SameLineLimits limits(EstimatorConfig(), kFocalLength);
  const double angle = limits.angle, distance = limits.distance;
  EXPECT_EQ(FindDifference(limits, Pair(angle, distance, distance)), LineDifference::kNone);
  EXPECT_EQ(FindDifference(limits, Pair(1.1 * angle, 2 * distance, 2 * distance)),
            LineDifference::kDirection);
  EXPECT_EQ(FindDifference(limits, Pair(angle, 1.1 * distance, 2 * distance)),
            LineDifference::kDistance);
  EXPECT_EQ(FindDifference(limits, Pair(angle, distance, 1.1 * distance)), LineDifference::kGap);
}

TEST(FindDifference, AllowsForUncertainty) {
  const SameLineLimits limits(EstimatorConfig(), kFocalLength);
  LinePairGeometry pair = Pair(2 * limits.angle, 2 * limits.distance, 0);
  pair.angle_sigma = 0.67 * limits.angle;
  EXPECT_EQ(FindDifference(limits, pair), LineDifference::kDistance);
  pair.distance_sigma = 0.67 * limits.distance;
  EXPECT_EQ(FindDifference(limits, pair), LineDifference::kNone);
}

// Three cameras, each to the side of and above the previous one, that observe one line.
class SeeTest : public ::testing::Test {
 protected:
  SeeTest() {
    LineMap lines;
    for (int i = 0; i < 3; ++i) {
      WindowFrame frame;
      frame.state.t_ns = i;
      frame.state.position() = Vector3d(0.3 * i, 0.2 * i, 0);
      window_.frames.push_back(frame);
      LineFrame seen;
      seen.t_ns = i;
      seen.lines = {{1, (start_W_ - frame.state.position()).hnormalized(),
                     (end_W_ - frame.state.position()).hnormalized()}};
      lines.AddFrame(seen);
    }
    lines.Triangulate(window_, LineLimits(kNoise, /*max_length=*/10));
    line_ = lines.landmarks().at(1);
  }

  const Vector3d start_W_{-1, 0.5, 5}, end_W_{1, 0.7, 6};
  SlidingWindow window_;
  LineLandmark line_;
};

TEST_F(SeeTest, ObservedPartIsRotatedIntoTheFrame) {
  const Eigen::Quaterniond R_F_W = SO3Exp({0.1, -0.4, 0.8});
  const auto seen = See(window_, R_F_W, kNoise, line_);
  ASSERT_TRUE(seen);
  EXPECT_MATRIX_NEAR(seen->start_F, R_F_W * start_W_, 1e-5);
  EXPECT_MATRIX_NEAR(seen->end_F, R_F_W * end_W_, 1e-5);
}

TEST_F(SeeTest, DeviationIsProportionalToTheNoise) {
  const auto seen = See(window_, Eigen::Quaterniond::Identity(), 0.0005, line_);
  const auto worse = See(window_, Eigen::Quaterniond::Identity(), 0.001, line_);
  ASSERT_TRUE(seen && worse);
  EXPECT_GT(seen->place_sigma, 0);
  EXPECT_NEAR(worse->place_sigma, 2 * seen->place_sigma, 0.01 * seen->place_sigma);
  EXPECT_NEAR(worse->direction_sigma, 2 * seen->direction_sigma, 0.01 * seen->direction_sigma);
}

TEST_F(SeeTest, FewObservationsHaveNoDeviation) {
  line_.observations.pop_back();
  const auto seen = See(window_, Eigen::Quaterniond::Identity(), kNoise, line_);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->place_sigma, 0);
  EXPECT_EQ(seen->direction_sigma, 0);
}

TEST_F(SeeTest, DistanceInImageIsThatOfTheFartherEnd) {
  const Vector3d down(0, 0.1, 0);
  const PluckerLine shifted = LineThrough(start_W_ + down, end_W_ + down);
  const double distance = DistanceInImage(window_, shifted, line_.observations[0]);
  EXPECT_GT(distance, 0.1 / 6 * 0.98);
  EXPECT_LT(distance, 0.1 / 5);
  EXPECT_LT(DistanceInImage(window_, LineInWorld(line_, window_), line_.observations[0]), 1e-6);
}

TEST_F(SeeTest, ALineThroughTheCameraHasNoImage) {
  const PluckerLine through = LineThrough(Vector3d::Zero(), end_W_);
  EXPECT_TRUE(std::isinf(DistanceInImage(window_, through, line_.observations[0])));
}

}  // namespace
}  // namespace plm_vins
