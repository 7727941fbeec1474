// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/retrieval/corner_index.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::RandomDescriptor;
using testing::WithFlippedBits;

std::vector<Descriptor> RandomDescriptors(int count, uint64_t seed) {
  simulator::Random random(seed);
  std::vector<Descriptor> descriptors;
  descriptors.reserve(count);
  for (int i = 0; i < count; ++i) descriptors.push_back(RandomDescriptor(&random));
  return descriptors;
}

class CornerIndexTest : public ::testing::Test {
 protected:
  CornerIndexTest() {
    for (int image = 0; image < 5; ++image) {
      images_.push_back(RandomDescriptors(100, image + 1));
      index_.Add({image, 0}, images_.back());
    }
  }

  CornerIndex index_;
  std::vector<std::vector<Descriptor>> images_;
};

TEST_F(CornerIndexTest, FindsTheImageItself) {
  const auto scores = index_.Scores(images_[3]);
  ASSERT_EQ(scores.count({3, 0}), 1u);
  EXPECT_NEAR(scores.at({3, 0}), 100 * std::log(6.0), 1e-9);  // each occurs in one of five images
  EXPECT_EQ(scores.size(), 1u);
}

TEST_F(CornerIndexTest, FindsMostCornersDespiteBitErrors) {
  simulator::Random random(9);
  std::vector<Descriptor> noisy;
  for (const Descriptor& d : images_[2]) noisy.push_back(WithFlippedBits(d, 20, &random));
  EXPECT_GT(index_.Scores(noisy).at({2, 0}), 70 * std::log(6.0));
}

TEST_F(CornerIndexTest, SharedWordAloneIsNoMatch) {
  Descriptor other = images_[0].front();
  other[2] = ~other[2];  // the words consist of the first bits
  EXPECT_TRUE(index_.Scores({other}).empty());
}

TEST_F(CornerIndexTest, WeightsByInverseDocumentFrequency) {
  const Descriptor common = images_[0].front();
  for (int image = 1; image < 5; ++image) index_.Add({image, 0}, {common});
  const auto scores = index_.Scores({common, images_[0].back()});
  EXPECT_NEAR(scores.at({1, 0}), std::log(6.0 / 5), 1e-9);
  EXPECT_NEAR(scores.at({0, 0}), std::log(6.0 / 5) + std::log(6.0), 1e-9);
}

TEST_F(CornerIndexTest, ForgetsAnImage) {
  index_.Remove({3, 0}, images_[3]);
  EXPECT_TRUE(index_.Scores(images_[3]).empty());
  EXPECT_NEAR(index_.Scores(images_[1]).at({1, 0}), 100 * std::log(5.0), 1e-9);
}

}  // namespace
}  // namespace plm_vins
