// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/description/descriptor.h"

#include <gtest/gtest.h>

#include <bitset>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

TEST(Descriptor, DistanceCountsTheBitsThatDiffer) {
  simulator::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Descriptor a = testing::RandomDescriptor(&random);
    const Descriptor b = testing::RandomDescriptor(&random);
    size_t count = 0;
    for (size_t word = 0; word < a.size(); ++word) {
      count += std::bitset<64>(a[word] ^ b[word]).count();
    }
    EXPECT_EQ(HammingDistance(a, b), static_cast<int>(count));
  }
}

TEST(Descriptor, DistanceReachesFromNoneToAllBits) {
  Descriptor inverse = {};
  for (uint64_t& word : inverse) word = ~uint64_t{0};
  EXPECT_EQ(HammingDistance(Descriptor{}, Descriptor{}), 0);
  EXPECT_EQ(HammingDistance(Descriptor{}, inverse), kDescriptorBits);
}

}  // namespace
}  // namespace plm_vins
