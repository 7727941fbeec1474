// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/lbd_matcher.h"

#include <gtest/gtest.h>

#include "linefeature_tracker/segments/segment_sampler.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

class LbdMatcherTest : public testing::Test {
 protected:
  // The long edges of the bars after the homography H, with descriptors.
  std::vector<LbdMatcher::Line> Lines(const Eigen::Matrix3d& H) const {
    std::vector<LineSegment> segments, segments_px;
    for (const LineSegment& edge : scene_.Edges(H)) {
      if (scene_.camera()->FocalLength() * edge.Length() < 50) continue;
      segments.push_back(edge);
      segments_px.push_back(*ProjectSegment(*scene_.camera(), edge));
    }
    const cv::Mat descriptors = matcher_.Describe(scene_.View(H), segments_px);
    std::vector<LbdMatcher::Line> lines;
    for (size_t i = 0; i < segments.size(); ++i)
      lines.push_back({segments[i], descriptors.row(static_cast<int>(i))});
    return lines;
  }

  LineScene scene_ = BarScene(PlainParameters());
  LbdMatcher matcher_{LineTrackerConfig(), scene_.camera()->FocalLength()};
};

TEST_F(LbdMatcherTest, MatchesLinesThatMoved) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = 0.01;  // 4.6 px
  const auto older = Lines(Eigen::Matrix3d::Identity());
  const auto matches = matcher_.Match(older, Lines(H));
  int correct = 0, wrong = 0;
  for (size_t i = 0; i < matches.size(); ++i)
    ++(matches[i] == static_cast<int>(i) ? correct : wrong);
  EXPECT_GE(correct, 0.9 * static_cast<double>(older.size()));
  for (size_t i = 0; i < matches.size(); ++i)
    EXPECT_TRUE(matches[i] == -1 || matches[i] == static_cast<int>(i));
}

TEST_F(LbdMatcherTest, TheGateRefusesFarAndReversedLines) {
  const auto older = Lines(Eigen::Matrix3d::Identity());
  auto reversed = older;
  for (auto& line : reversed) line.segment = line.segment.Reversed();
  const auto matches = matcher_.Match(older, reversed);
  for (size_t i = 0; i < matches.size(); ++i) EXPECT_NE(matches[i], static_cast<int>(i));
  auto far = older;
  for (auto& line : far) {
    line.segment.start += Eigen::Vector2d(5, 5);
    line.segment.end += Eigen::Vector2d(5, 5);
  }
  for (const int match : matcher_.Match(older, far)) EXPECT_EQ(match, -1);
}

TEST_F(LbdMatcherTest, NothingFromNothing) {
  EXPECT_TRUE(matcher_.Describe(scene_.View(), {}).empty());
  EXPECT_TRUE(matcher_.Match({}, {}).empty());
}

}  // namespace
}  // namespace plm_vins
