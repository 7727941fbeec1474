// SPDX-License-Identifier: BSD-3-Clause
#include "common/format.h"

#include <gtest/gtest.h>

#include <string>

namespace plm_vins {
namespace {

TEST(Format, WritesAsPrintfDoes) {
  EXPECT_EQ(Format("%d of %d, %.2f m%%", 3, 4, 0.125), "3 of 4, 0.12 m%");
  EXPECT_EQ(Format("%s", ""), "");
}

TEST(Format, WritesTextsOfAnyLength) {
  const std::string text(5000, 'x');
  EXPECT_EQ(Format("<%s>", text.c_str()), "<" + text + ">");
}

TEST(JoinTexts, LeavesOutEmptyOnes) {
  EXPECT_EQ(JoinTexts({"", "a", "", "b", ""}, "; "), "a; b");
  EXPECT_EQ(JoinTexts({}, ", "), "");
}

}  // namespace
}  // namespace plm_vins
