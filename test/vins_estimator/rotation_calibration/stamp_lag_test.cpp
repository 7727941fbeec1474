// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/stamp_lag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

constexpr int64_t kInterval_ns = 5'000'000;    // of the IMU
constexpr int64_t kRotation_ns = 300'000'000;  // from the first to the second image
const Eigen::Quaterniond kCamera(Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, -1).normalized()));

// Turns about changing axes, without a period of less than some seconds.
Eigen::Vector3d RateAt(double t) {
  return {0.6 * std::sin(1.9 * t), 0.5 * std::sin(2.7 * t + 1), 0.7 * std::sin(1.3 * t * t)};
}

// Returns what is found if the images show what the gyroscope measures `lag` [s] later.
std::optional<double> Find(double lag, double seconds, double turn_share = 1,
                           const Eigen::Vector3d& bias = Eigen::Vector3d::Zero()) {
  StampLag search(kCamera);
  std::vector<ImuSample> imu(1);
  std::vector<Eigen::Quaterniond> attitudes = {Eigen::Quaterniond::Identity()};
  const auto attitude_at = [&](int64_t t_ns) { return attitudes[t_ns / kInterval_ns]; };
  const int64_t lag_ns = ToNanoseconds(lag);
  for (int64_t t_ns = kInterval_ns; t_ns < ToNanoseconds(seconds); t_ns += kInterval_ns) {
    ImuSample sample;
    sample.t_ns = t_ns;
    const Eigen::Vector3d rate = turn_share * RateAt(ToSeconds(t_ns));
    sample.gyro = rate + bias;
    attitudes.push_back(attitudes.back() * SO3Exp(ToSeconds(kInterval_ns) * rate));
    imu.push_back(sample);
    if (t_ns % 100'000'000 != 0) continue;
    search.AddImu(imu);
    imu = {imu.back()};
    // The stamped images, which are older than the newest sample if the lag is positive.
    const int64_t now_ns = t_ns - std::max<int64_t>(lag_ns, 0);
    const int64_t then_ns = now_ns - kRotation_ns;
    if (then_ns + lag_ns < 0) continue;
    const Eigen::Quaterniond R_B0_B1 =
        attitude_at(then_ns + lag_ns).conjugate() * attitude_at(now_ns + lag_ns);
    search.AddRotation(then_ns, now_ns, kCamera.conjugate() * R_B0_B1 * kCamera, 0.005);
  }
  return search.lag();
}

TEST(StampLag, FindsLargeLagsOnBothSides) {
  for (const double lag : {-0.48, -0.3, -0.1, 0.1, 0.3, 0.48}) {
    const auto found = Find(lag, 8);
    ASSERT_TRUE(found) << lag;
    EXPECT_NEAR(*found, lag, 0.021);
  }
}

TEST(StampLag, FindsNothingIfThereIsNone) {
  EXPECT_FALSE(Find(0, 8));
  EXPECT_FALSE(Find(0.03, 8));  // is RotationFit's
}

TEST(StampLag, FindsALagInSpiteOfABias) {
  const auto found = Find(0.3, 8, 1, {0.02, -0.02, 0.02});
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.3, 0.021);
}

TEST(StampLag, FindsNothingWithoutRotations) {
  EXPECT_FALSE(Find(0.3, 8, /*turn_share=*/0.1));
  EXPECT_FALSE(Find(0.3, 1.5));
}

TEST(StampLag, StartsAnewAfterClear) {
  StampLag search(kCamera);
  search.AddImu({ImuSample()});
  search.Clear();
  EXPECT_FALSE(search.lag());
}

}  // namespace
}  // namespace plm_vins
