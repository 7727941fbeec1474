// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/merging/line_structure.h"

#include <gtest/gtest.h>

#include "test/vins_estimator/wall_scene.h"

namespace plm_vins {
namespace {

using testing::LineWindow;
using testing::UniteOnWall;
using testing::WallLine;

constexpr int kFrames = 30;
const WallLine kOther = {2, {-1, 1}, {2, 1}};

// Support of the heading with the most votes, for lines of these tracks and another one.
HeadingSupport SupportBy(std::vector<WallLine> tracks, UnitedLines* united) {
  LineWindow window;
  tracks.push_back(kOther);
  *united = UniteOnWall(tracks, &window, kFrames);
  return window.structure().manhattan().support();
}

TEST(LineStructure, LineWithABrokenTrackVotesOnce) {
  UnitedLines whole, broken;
  const HeadingSupport once = SupportBy({{4, {-1, 0.5}, {1, 0.5}}}, &whole);
  const HeadingSupport twice =
      SupportBy({{4, {-1, 0.5}, {1, 0.5}, 0, 14}, {9, {-1, 0.5}, {1, 0.5}, 15}}, &broken);
  EXPECT_EQ(whole.merging.merged, 0);
  EXPECT_EQ(broken.merging.merged, 1);
  EXPECT_EQ(broken.absorbed, std::vector<int64_t>{9});
  EXPECT_EQ(once.lines, 2);
  EXPECT_EQ(twice.lines, 2);
}

TEST(LineStructure, RecognizedLineVotesOnce) {
  UnitedLines united;
  const HeadingSupport support =
      SupportBy({{4, {-1, 0.5}, {1, 0.5}, 0, 7}, {9, {-1, 0.5}, {1, 0.5}, 20}}, &united);
  EXPECT_EQ(united.recognized, 1);
  EXPECT_EQ(support.lines, 2);
}

TEST(LineStructure, NeighboringLinesVoteEach) {
  UnitedLines united;
  EXPECT_EQ(SupportBy({{4, {-1, 0.5}, {1, 0.5}}, {9, {-1, 0}, {1, 0}}}, &united).lines, 3);
}

}  // namespace
}  // namespace plm_vins
