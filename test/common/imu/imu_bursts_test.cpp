// SPDX-License-Identifier: BSD-3-Clause
#include "common/imu/imu_bursts.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace plm_vins {
namespace {

constexpr int64_t kInterval_ns = 5'000'000;

// When a sample was read by the sensor.
int64_t TrueStamp(int i) { return 1'000'000'000 + i * kInterval_ns; }

// Stamped on arrival: with the last sample of its burst, each later by `step_ns`.
int64_t BurstStamp(int i, int size, int64_t step_ns) {
  const int begin = i - i % size;
  return TrueStamp(begin + size - 1) + (i - begin) * step_ns;
}

std::vector<int64_t> Spread(const std::vector<int64_t>& stamps, ImuBursts* bursts) {
  std::vector<int64_t> spread;
  for (const int64_t t_ns : stamps) {
    const auto count = static_cast<double>(spread.size());
    spread.push_back(bursts->Spread({t_ns, Eigen::Vector3d::Constant(count)}).t_ns);
  }
  return spread;
}

// Returns the greatest error of a stamp from the third second on, for samples in bursts.
int64_t GreatestError(int size, int64_t step_ns, int lost = -1) {
  std::vector<int64_t> stamps, truth;
  for (int i = 0; i < 2000; ++i) {
    if (i == lost) continue;
    stamps.push_back(BurstStamp(i, size, step_ns));
    truth.push_back(TrueStamp(i));
  }
  ImuBursts bursts;
  const std::vector<int64_t> spread = Spread(stamps, &bursts);
  EXPECT_EQ(bursts.size(), static_cast<size_t>(size));
  EXPECT_NEAR(bursts.interval(), ToSeconds(kInterval_ns), 1e-4);
  int64_t greatest = 0;
  for (size_t i = 600; i < spread.size(); ++i) {
    EXPECT_GT(spread[i], spread[i - 1]);
    greatest = std::max(greatest, std::abs(spread[i] - truth[i]));
  }
  return greatest;
}

TEST(ImuBursts, AreSpreadEvenlyOverTime) {
  for (const int size : {2, 3, 4, 10, 16}) {
    EXPECT_LT(GreatestError(size, 100'000), 2'000'000)
        << size;                                         // ten of them are stamped by 0.9 ms
    EXPECT_LT(GreatestError(size, 0), 200'000) << size;  // one stamp for all
  }
}

TEST(ImuBursts, MayLoseASample) { EXPECT_LT(GreatestError(10, 0, 1000), 5'200'000); }

TEST(ImuBursts, OtherSamplesAreUnchanged) {
  std::mt19937 random(3);
  std::normal_distribution<double> jitter(0, 1e6);
  std::vector<int64_t> steady, jittering, gaps;
  for (int i = 0; i < 1000; ++i) {
    steady.push_back(TrueStamp(i));
    jittering.push_back(TrueStamp(i) + static_cast<int64_t>(jitter(random)));
    gaps.push_back(TrueStamp(i) + i / 100 * 2'000'000'000);
  }
  for (const auto& stamps : {steady, jittering, gaps}) {
    ImuBursts bursts;
    EXPECT_EQ(Spread(stamps, &bursts), stamps);
    EXPECT_EQ(bursts.size(), 0u);
  }
}

TEST(ImuBursts, DoNotComeOfCopies) {
  ImuBursts bursts;
  for (int i = 0; i < 1000; ++i) {
    const ImuSample sample{TrueStamp(i / 2), Eigen::Vector3d::Constant(i / 2)};
    EXPECT_EQ(bursts.Spread(sample).t_ns, sample.t_ns);
  }
  EXPECT_EQ(bursts.size(), 0u);
}

TEST(ImuBursts, ContinueAfterAGap) {
  std::vector<int64_t> stamps;
  for (int i = 0; i < 2000; ++i) {
    stamps.push_back(BurstStamp(i, 10, 0) + (i < 1000 ? 0 : 3'000'000'000));
  }
  ImuBursts bursts;
  const std::vector<int64_t> spread = Spread(stamps, &bursts);
  for (int i = 1000; i < 2000; ++i) {
    EXPECT_NEAR(ToSeconds(spread[i] - TrueStamp(i)), 3, 1e-3) << i;
  }
}

}  // namespace
}  // namespace plm_vins
