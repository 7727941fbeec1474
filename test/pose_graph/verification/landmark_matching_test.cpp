// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/landmark_matching.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::kFocalLength;

using testing::RandomDescriptor;
using testing::WithFlippedBits;

class LandmarkMatchingTest : public ::testing::Test {
 protected:
  static DescribedCorner CornerOf(const Descriptor& descriptor) {
    DescribedCorner corner;
    corner.descriptor = descriptor;
    return corner;
  }
  static DescribedLandmark LandmarkOf(const Descriptor& descriptor) {
    return {Eigen::Vector3d(4, 0, 0), {descriptor}};
  }

  simulator::Random random_{1};
  Descriptor a_ = RandomDescriptor(&random_);
  Descriptor b_ = RandomDescriptor(&random_);
};

TEST_F(LandmarkMatchingTest, MatchesSimilarDescriptors) {
  const auto matches =
      MatchLandmarks(MatchingOptions(kFocalLength), {CornerOf(WithFlippedBits(b_, 20, &random_))},
                     {LandmarkOf(a_), LandmarkOf(b_)});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches.front().corner, 0u);
  EXPECT_EQ(matches.front().landmark, 1u);
}

TEST_F(LandmarkMatchingTest, DoesNotMatchDifferentDescriptors) {
  EXPECT_TRUE(
      MatchLandmarks(MatchingOptions(kFocalLength), {CornerOf(a_)}, {LandmarkOf(b_)}).empty());
}

TEST_F(LandmarkMatchingTest, DropsAmbiguousCorners) {
  const auto twin = LandmarkOf(WithFlippedBits(a_, 1, &random_));
  EXPECT_TRUE(MatchLandmarks(MatchingOptions(kFocalLength),
                             {CornerOf(WithFlippedBits(a_, 20, &random_))}, {LandmarkOf(a_), twin})
                  .empty());
}

TEST_F(LandmarkMatchingTest, MatchesALandmarkToItsNearestCornerOnly) {
  const auto matches =
      MatchLandmarks(MatchingOptions(kFocalLength),
                     {CornerOf(WithFlippedBits(a_, 30, &random_)), CornerOf(a_)}, {LandmarkOf(a_)});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches.front().corner, 1u);
}

TEST_F(LandmarkMatchingTest, ComparesAllDescriptorsOfALandmark) {
  DescribedLandmark landmark = LandmarkOf(a_);
  landmark.descriptors.push_back(b_);
  EXPECT_EQ(MatchLandmarks(MatchingOptions(kFocalLength), {CornerOf(b_)}, {landmark}).size(), 1u);
}

TEST_F(LandmarkMatchingTest, SearchesAroundTheProjectionIfThePoseIsKnown) {
  const Eigen::Quaterniond R_G_C = testing::LookingAhead().rotation;
  DescribedCorner corner = CornerOf(a_);
  const auto count = [&] {
    return MatchAroundImages(MatchingOptions(kFocalLength), {corner}, {LandmarkOf(a_)},
                             LevelTransform(), R_G_C)
        .size();
  };
  corner.xy = {0.05F, 0};
  EXPECT_EQ(count(), 1u);
  corner.xy = {0.2F, 0};
  EXPECT_EQ(count(), 0u);
}

TEST_F(LandmarkMatchingTest, IgnoresLandmarksBehindTheCamera) {
  const Eigen::Quaterniond R_G_C = testing::LookingAhead().rotation;
  const LevelTransform beyond = {0, {8, 0, 0}};
  EXPECT_TRUE(MatchAroundImages(MatchingOptions(kFocalLength), {CornerOf(a_)}, {LandmarkOf(a_)},
                                beyond, R_G_C)
                  .empty());
}

TEST_F(LandmarkMatchingTest, MergesTheLandmarksOfAnIsland) {
  Keyframe first, second;
  for (Keyframe* keyframe : {&first, &second}) {
    DescribedCorner corner = CornerOf(a_);
    corner.track = 5;
    corner.p_O = Eigen::Vector3f(1, 2, keyframe == &first ? 3 : 4);
    keyframe->corners = {corner, CornerOf(b_)};  // the second corner has no position
  }
  const auto landmarks = MergeLandmarks({&first, &second}, 0);
  ASSERT_EQ(landmarks.size(), 1u);
  EXPECT_EQ(landmarks.front().p_O, Eigen::Vector3d(1, 2, 4));
  EXPECT_EQ(landmarks.front().descriptors.size(), 2u);
}

TEST_F(LandmarkMatchingTest, MergesInTheOrderOfTracksWithGaps) {
  Keyframe keyframe;
  for (const int track : {9, 4, 7, 2}) {
    keyframe.corners.push_back(CornerOf(a_));
    keyframe.corners.back().track = track;
    keyframe.corners.back().p_O = Eigen::Vector3f::Constant(static_cast<float>(track));
  }
  std::vector<double> places;
  for (const DescribedLandmark& landmark : MergeLandmarks({&keyframe}, 0, {1, 4, 8})) {
    places.push_back(landmark.p_O.x());
  }
  EXPECT_EQ(places, (std::vector<double>{2, 7, 9}));
}

}  // namespace
}  // namespace plm_vins
