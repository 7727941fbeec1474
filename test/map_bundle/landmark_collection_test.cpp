// SPDX-License-Identifier: BSD-3-Clause
#include "map_bundle/landmark_collection.h"

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

// Collects the landmarks of the first keyframes of a map.
std::vector<LandmarkTrack> Collect(const KeyframeMap& map, int keyframes,
                                   const std::vector<Reobservation>& again = {}) {
  BundleState bundle;
  for (int i = 0; i < keyframes; ++i) {
    bundle.keyframes[i].state.SetPose(map.T_M_O(i).ToRigid() * map.keyframes[i].T_O_B);
  }
  return CollectLandmarks(map, bundle, again);
}

// Observation of a track of world 0 by a loop.
Reobservation Again(int64_t track, int keyframe, const Eigen::Vector2d& xy) {
  LandmarkTrack::Observation observation;
  observation.keyframe = keyframe;
  observation.xy = xy;
  observation.again = true;
  return {{0, track}, observation};
}

TEST(LandmarkCollectionTest, JoinsTheCornersOfATrack) {
  KeyframeMap map = MapOf({0, 0, 0});
  See(7, &map.keyframes[0], kPlace, /*is_known=*/false);
  See(7, &map.keyframes[2]);
  const auto tracks = Collect(map, 3);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].key.track, 7);
  EXPECT_EQ(tracks[0].p_M, kPlace.cast<double>());
  ASSERT_EQ(tracks[0].observations.size(), 2u);
  EXPECT_EQ(tracks[0].observations[0].keyframe, 0);
  EXPECT_EQ(tracks[0].observations[1].keyframe, 2);
}

TEST(LandmarkCollectionTest, KeepsTracksOfTwoWorldsApart) {
  KeyframeMap map = MapOf({0, 1});
  See(7, &map.keyframes[0]);
  See(7, &map.keyframes[1]);
  EXPECT_TRUE(Collect(map, 2).empty());
}

TEST(LandmarkCollectionTest, AddsLoopObservations) {
  KeyframeMap map = MapOf({0, 1, 1});
  See(7, &map.keyframes[0]);
  const Eigen::Vector2d xy(0.3, -0.1);
  const auto tracks = Collect(map, 2, {Again(7, 1, xy), Again(7, 2, xy), Again(8, 1, xy)});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].observations.size(), 2u);  // keyframe 2 was not requested
  EXPECT_FALSE(tracks[0].observations[0].again);
  EXPECT_TRUE(tracks[0].observations[1].again);
  EXPECT_EQ(tracks[0].observations[1].xy, xy);
}

// Several later keyframes that match the same earlier one repeat the same observation.
TEST(LandmarkCollectionTest, CountsAKeyframeOnce) {
  KeyframeMap map = MapOf({0, 0, 1});
  See(7, &map.keyframes[0]);
  See(7, &map.keyframes[1]);
  const Eigen::Vector2d first(0.3, -0.1), second(0.31, -0.1);
  const auto tracks =
      Collect(map, 3, {Again(7, 2, first), Again(7, 1, first), Again(7, 2, second)});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].observations.size(), 3u);
  EXPECT_FALSE(tracks[0].observations[1].again);
  EXPECT_EQ(tracks[0].observations[2].keyframe, 2);
  EXPECT_EQ(tracks[0].observations[2].xy, first);
}

// Another camera hosts what the first one does not see; a measured depth belongs to the first one.
TEST(LandmarkCollectionTest, AddsObservationsByOtherCamerasAndDepths) {
  KeyframeMap map = MapOf({0, 0});
  See(7, &map.keyframes[0]);
  BundleState bundle;
  bundle.T_B_C.push_back({Eigen::Quaterniond::Identity(), {0.2, 0, 0}});
  for (int i = 0; i < 2; ++i) {
    BundleKeyframe& keyframe = bundle.keyframes[i];
    keyframe.state.SetPose(map.keyframes[i].T_O_B);
    for (const int64_t track : {7, 8}) {
      KeyframeObservation other;
      other.track = track;
      other.camera = 1;
      const Eigen::Vector3d p_O = kPlace.cast<double>();
      other.xy = (bundle.T_M_C(i, 1).Inverse() * p_O).hnormalized();
      other.p_O = p_O;
      keyframe.observations.push_back(other);
    }
  }
  KeyframeObservation measured;
  measured.track = 7;
  measured.depth = kDepth;
  bundle.keyframes[0].observations.insert(bundle.keyframes[0].observations.begin(), measured);
  const auto tracks = CollectLandmarks(map, bundle, {});
  ASSERT_EQ(tracks.size(), 2u);
  ASSERT_EQ(tracks[0].observations.size(), 3u);
  EXPECT_EQ(tracks[0].observations[0].depth, kDepth);
  EXPECT_EQ(tracks[0].observations[1].camera, 1);
  EXPECT_FALSE(tracks[0].observations[1].depth);
  ASSERT_EQ(tracks[1].observations.size(), 2u);
  EXPECT_EQ(tracks[1].observations[0].camera, 1) << "host";
}

TEST(LandmarkCollectionTest, IgnoresDistantLandmarks) {
  KeyframeMap map = MapOf({0, 0});  // half a meter apart
  for (Keyframe& keyframe : map.keyframes) {
    See(1, &keyframe, Eigen::Vector3f(0, 0, 20));
    See(2, &keyframe, Eigen::Vector3f(0, 0, 40));
  }
  const auto tracks = Collect(map, 2);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].key.track, 1);
}

TEST(LandmarkCollectionTest, IgnoresLandmarksWithoutPositionOrBehindTheCamera) {
  KeyframeMap map = MapOf({0, 0});
  for (Keyframe& keyframe : map.keyframes) {
    See(1, &keyframe, kPlace, /*is_known=*/false);
    See(2, &keyframe, Eigen::Vector3f(1, 2, -kDepth));
    See(-1, &keyframe);
  }
  EXPECT_TRUE(Collect(map, 2).empty());
}

}  // namespace
}  // namespace plm_vins
