// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/repeated_image_detector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plm_vins {
namespace {

constexpr int64_t kInterval_ns = 50'000'000;  // 20 Hz
constexpr int64_t kSample_ns = 5'000'000;     // 200 Hz

class RepeatedImageDetectorTest : public ::testing::Test {
 protected:
  // Adds the next image, with corners shifted to the right; `rate` is the angular velocity of the
  // IMU.
  bool Next(double shift_px, double rate) {
    FrameMeasurement frame;
    for (int64_t t = t_ns_; t <= t_ns_ + kInterval_ns; t += kSample_ns) {
      const Eigen::Vector3d gyro(0.3, rate * std::sin(2 * M_PI * ToSeconds(t)), 0);
      frame.imu.push_back({t, gyro, {0.1, -0.2, 9.81}});
    }
    t_ns_ += kInterval_ns;
    frame.t_ns = frame.points.t_ns = t_ns_;
    for (int id = 0; id < corners_; ++id) {
      PointObservation point;
      point.id = first_id_ + id;
      point.uv_px = {10.5 * id + shift_px, 7.25 * id};
      frame.points.points.push_back(point);
    }
    return detector_.Add(frame, least_speed_);
  }

  // Number of a second's images that count as repeated, with a shift of each corner between images.
  int CountRepeated(double shift_px, double rate) {
    int repeated = 0;
    for (int i = 1; i <= 20; ++i) repeated += Next(i * shift_px, rate);
    return repeated;
  }

  RepeatedImageDetector detector_{ImuNoise()};
  int64_t t_ns_ = 0;
  int corners_ = 30;
  int first_id_ = 0;
  double least_speed_ = 0;
};

TEST_F(RepeatedImageDetectorTest, StillImageDuringMotionIsRepeated) {
  EXPECT_EQ(CountRepeated(1, 0.2), 0);
  EXPECT_TRUE(Next(20, 0.2));
  EXPECT_EQ(CountRepeated(0, 0.2), 19);  // the first one is a new image
}

TEST_F(RepeatedImageDetectorTest, AnyCornerMotionIsNotRepeated) {
  CountRepeated(1, 0.2);
  EXPECT_EQ(CountRepeated(1e-6, 0.2), 0);
}

TEST_F(RepeatedImageDetectorTest, StillImageAtStandstillIsNotRepeated) {
  EXPECT_EQ(CountRepeated(0, 0), 0);
  EXPECT_EQ(CountRepeated(0, 0.01), 0);
}

TEST_F(RepeatedImageDetectorTest, StillImageInSteadyFlightIsRepeated) {
  least_speed_ = 0.2;
  EXPECT_EQ(CountRepeated(1, 0), 0);
  EXPECT_TRUE(Next(20, 0));
  least_speed_ = 0;
  EXPECT_FALSE(Next(20, 0));
}

TEST_F(RepeatedImageDetectorTest, AcceptsImagesOnceTheImuIsStill) {
  CountRepeated(1, 0.2);
  EXPECT_TRUE(Next(20, 0.2));
  CountRepeated(0, 0);
  EXPECT_FALSE(Next(0, 0));
}

TEST_F(RepeatedImageDetectorTest, NeedsEnoughTrackedCorners) {
  CountRepeated(1, 0.2);
  first_id_ = 100;
  EXPECT_FALSE(Next(20, 0.2));
  EXPECT_TRUE(Next(20, 0.2));
  corners_ = 9;
  EXPECT_FALSE(Next(20, 0.2));
}

}  // namespace
}  // namespace plm_vins
