// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_aliases.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace plm_vins {
namespace {

LineFrame FrameOf(const std::vector<LineObservation>& lines) { return {7, lines}; }

TEST(LineAliases, KeepUnknownTracks) {
  LineAliases aliases;
  EXPECT_EQ(aliases.Resolve(5), 5);
  const LineFrame frame = aliases.Redirect(FrameOf({{5, {0, 0}, {1, 0}}, {2, {0, 0}, {0, 1}}}));
  EXPECT_EQ(frame.t_ns, 7);
  ASSERT_EQ(frame.lines.size(), 2u);
  EXPECT_TRUE(aliases.Redirect(FrameOf({})).lines.empty());
}

TEST(LineAliases, ResolveToTheOldestInOneStep) {
  LineAliases aliases;
  aliases.Add(9, 4);
  aliases.Add(4, 2);  // includes 9
  aliases.Add(7, 4);  // follows 4 to its alias
  for (const int64_t id : {9, 4, 7, 2}) EXPECT_EQ(aliases.Resolve(id), 2);
}

TEST(LineAliases, RejectNewerTargets) {
  LineAliases aliases;
  EXPECT_THROW(aliases.Add(3, 3), std::invalid_argument);
  EXPECT_THROW(aliases.Add(3, 4), std::invalid_argument);
}

TEST(LineAliases, KeepTheLongestOfSeveralSegmentsOfOneLine) {
  LineAliases aliases;
  aliases.Add(8, 3);
  aliases.Add(9, 3);
  const LineFrame frame = aliases.Redirect(
      FrameOf({{3, {0, 0}, {0.1, 0}}, {8, {0.2, 0}, {0.6, 0}}, {9, {0.7, 0}, {0.8, 0}}}));
  ASSERT_EQ(frame.lines.size(), 1u);
  EXPECT_EQ(frame.lines[0].id, 3);
  EXPECT_EQ(frame.lines[0].start.x(), 0.2);
}

TEST(LineAliases, DropEndedTracks) {
  LineAliases aliases;
  aliases.Add(8, 3);
  aliases.Add(9, 3);
  for (int i = 0; i <= LineAliases::kMemory; ++i) aliases.Redirect(FrameOf({{9, {0, 0}, {1, 0}}}));
  EXPECT_EQ(aliases.Resolve(8), 8);
  EXPECT_EQ(aliases.Resolve(9), 3);
}

TEST(LineAliases, AreBoundedWithManyBrokenTracks) {
  LineAliases aliases;
  for (int64_t id = 1; id < 5000; ++id) {
    aliases.Add(id, 0);
    aliases.Redirect(FrameOf({{id, {0, 0}, {1, 0}}}));
    EXPECT_LE(aliases.size(), static_cast<size_t>(LineAliases::kMemory) + 1);
  }
}

TEST(LineAliases, EndWithTheirLandmark) {
  LineAliases aliases;
  aliases.Add(8, 3);
  aliases.Add(9, 4);
  aliases.RemoveUnless([](int64_t landmark) { return landmark == 4; });
  EXPECT_EQ(aliases.Resolve(8), 8);
  EXPECT_EQ(aliases.Resolve(9), 4);
}

}  // namespace
}  // namespace plm_vins
