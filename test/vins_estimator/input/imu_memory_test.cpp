// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/input/imu_memory.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/input/sync_input.h"

namespace plm_vins {
namespace {

using testing::kMs;
using testing::Sample;

TEST(ImuMemory, HoldsTheLastSecond) {
  ImuMemory memory;
  EXPECT_FALSE(memory.Contains(Sample(0)));
  for (int64_t t = 0; t <= 3000; t += 5) memory.Add(Sample(t * kMs));
  EXPECT_TRUE(memory.Contains(Sample(3000 * kMs)));
  EXPECT_TRUE(memory.Contains(Sample(2000 * kMs)));
  EXPECT_FALSE(memory.Contains(Sample(1995 * kMs)));
  EXPECT_FALSE(memory.Contains(Sample(3005 * kMs)));
  memory.Clear();
  EXPECT_FALSE(memory.Contains(Sample(3000 * kMs)));
}

TEST(ImuMemory, OtherValuesOrStampsAreOtherSamples) {
  ImuMemory memory;
  memory.Add(Sample(5 * kMs));
  memory.Add(Sample(10 * kMs));
  ImuSample other = Sample(5 * kMs);
  other.gyro.y() += 1e-9;
  EXPECT_FALSE(memory.Contains(other));
  other = Sample(5 * kMs);
  other.accel.z() += 1e-9;
  EXPECT_FALSE(memory.Contains(other));
  other = Sample(5 * kMs);
  other.t_ns = 7 * kMs;
  EXPECT_FALSE(memory.Contains(other));
}

}  // namespace
}  // namespace plm_vins
