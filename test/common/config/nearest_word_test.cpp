// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/nearest_word.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

TEST(NearestWord, FindsTypingMistakesOnly) {
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("same", "same"), 0);
  EXPECT_EQ(NearestWord("imagetopic", {"imu_topic", "image_topic"}), "image_topic");
  EXPECT_FALSE(NearestWord("xyz", {"imu_topic", "td"}));
}

}  // namespace
}  // namespace plm_vins
