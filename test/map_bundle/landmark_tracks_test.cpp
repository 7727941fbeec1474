// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/landmark_tracks.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

constexpr float kDepth = 4;

// Keyframes side by side that look along z, with the given worlds.
KeyframeMap MapOf(const std::vector<int>& worlds) {
  KeyframeMap map;
  for (size_t i = 0; i < worlds.size(); ++i) {
    Keyframe keyframe;
    keyframe.world = worlds[i];
    keyframe.T_O_B.translation = {0.5 * static_cast<double>(i), 0, 0};
    map.graph.AddNode(keyframe.T_O_L());
    map.keyframes.push_back(keyframe);
  }
  return map;
}

const Eigen::Vector3f kPlace(1, 2, kDepth);

// Adds an observation of a landmark at `p_O`, whether its position is known or not.
void See(int64_t track, Keyframe* keyframe, const Eigen::Vector3f& p_O = kPlace,
         bool is_known = true) {
  DescribedCorner& corner = keyframe->corners.emplace_back();
  corner.track = track;
  corner.xy = (p_O - keyframe->T_O_B.translation.cast<float>()).hnormalized();
  if (is_known) corner.p_O = p_O;
}

TEST(LandmarkTracksTest, JoinsTheCornersOfATrack) {
  KeyframeMap map = MapOf({0, 0, 0});
  See(7, &map.keyframes[0], kPlace, /*is_known=*/false);
  See(7, &map.keyframes[2]);
  const auto tracks = CollectLandmarks(map, {0, 1, 2}, {});
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].key.track, 7);
  EXPECT_EQ(tracks[0].p_M, kPlace.cast<double>());
  ASSERT_EQ(tracks[0].observations.size(), 2u);
  EXPECT_EQ(tracks[0].observations[0].keyframe, 0);
  EXPECT_EQ(tracks[0].observations[1].keyframe, 2);
}

TEST(LandmarkTracksTest, KeepsTracksOfTwoWorldsApart) {
  KeyframeMap map = MapOf({0, 1});
  See(7, &map.keyframes[0]);
  See(7, &map.keyframes[1]);
  EXPECT_TRUE(CollectLandmarks(map, {0, 1}, {}).empty());
}

TEST(LandmarkTracksTest, AddsLoopObservations) {
  KeyframeMap map = MapOf({0, 1, 1});
  See(7, &map.keyframes[0]);
  const Eigen::Vector2d xy(0.3, -0.1);
  const auto tracks =
      CollectLandmarks(map, {0, 1}, {{{0, 7}, 1, xy}, {{0, 7}, 2, xy}, {{0, 8}, 1, xy}});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].observations.size(), 2u);  // keyframe 2 was not requested
  EXPECT_FALSE(tracks[0].observations[0].again);
  EXPECT_TRUE(tracks[0].observations[1].again);
  EXPECT_EQ(tracks[0].observations[1].xy, xy);
}

// Several later keyframes that match the same earlier one repeat the same observation.
TEST(LandmarkTracksTest, CountsAKeyframeOnce) {
  KeyframeMap map = MapOf({0, 0, 1});
  See(7, &map.keyframes[0]);
  See(7, &map.keyframes[1]);
  const Eigen::Vector2d first(0.3, -0.1), second(0.31, -0.1);
  const auto tracks = CollectLandmarks(
      map, {0, 1, 2}, {{{0, 7}, 2, first}, {{0, 7}, 1, first}, {{0, 7}, 2, second}});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].observations.size(), 3u);
  EXPECT_FALSE(tracks[0].observations[1].again);
  EXPECT_EQ(tracks[0].observations[2].keyframe, 2);
  EXPECT_EQ(tracks[0].observations[2].xy, first);
}

TEST(LandmarkTracksTest, IgnoresDistantLandmarks) {
  KeyframeMap map = MapOf({0, 0});  // half a meter apart
  for (Keyframe& keyframe : map.keyframes) {
    See(1, &keyframe, Eigen::Vector3f(0, 0, 20));
    See(2, &keyframe, Eigen::Vector3f(0, 0, 40));
  }
  const auto tracks = CollectLandmarks(map, {0, 1}, {});
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].key.track, 1);
}

TEST(LandmarkTracksTest, IgnoresLandmarksWithoutPositionOrBehindTheCamera) {
  KeyframeMap map = MapOf({0, 0});
  for (Keyframe& keyframe : map.keyframes) {
    See(1, &keyframe, kPlace, /*is_known=*/false);
    See(2, &keyframe, Eigen::Vector3f(1, 2, -kDepth));
    See(-1, &keyframe);
  }
  EXPECT_TRUE(CollectLandmarks(map, {0, 1}, {}).empty());
}

}  // namespace
}  // namespace plm_vins
