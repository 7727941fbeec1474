// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/retrieval/place_recognition.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr int64_t kSecond = 1'000'000'000;

// Keyframes of places that share a few corners with the previous and the next place.
class PlaceRecognitionTest : public ::testing::Test {
 protected:
  std::vector<PlaceCandidate> See(int place, double t, int world = 0) {
    Keyframe keyframe;
    keyframe.t_ns = static_cast<int64_t>(t * kSecond);
    keyframe.world = world;
    AddCorners(place, 30, &keyframe);
    AddCorners(place + 1, 10, &keyframe);
    keyframes_.push_back(keyframe);
    recognition_.Add(keyframe, static_cast<int>(keyframes_.size()) - 1);
    return recognition_.Find(keyframes_);
  }

  // Observes the places 0 to 9, one per second.
  void SeeTen() {
    for (int place = 0; place < 10; ++place) See(place, place);
  }

  std::vector<Keyframe> keyframes_;
  PlaceRecognition recognition_;

 private:
  static void AddCorners(int place, int count, Keyframe* keyframe) {
    simulator::Random random(place + 1);
    for (int i = 0; i < count; ++i) {
      keyframe->corners.emplace_back().descriptor = testing::RandomDescriptor(&random);
    }
  }
};

TEST_F(PlaceRecognitionTest, FindsARevisitedPlace) {
  SeeTen();
  See(4, 30);
  const auto candidates = See(5, 31);
  ASSERT_FALSE(candidates.empty());
  EXPECT_NEAR(candidates.front().earlier.keyframe, 5, 1);
  EXPECT_TRUE(candidates.front().similar);
}

TEST_F(PlaceRecognitionTest, IgnoresTheSameVisit) {
  SeeTen();
  EXPECT_TRUE(See(9, 10).empty());
}

TEST_F(PlaceRecognitionTest, AnotherWorldIsAlwaysAnotherVisit) {
  SeeTen();
  EXPECT_FALSE(See(9, 10, /*world=*/1).empty());
}

TEST_F(PlaceRecognitionTest, NeedsTwoConsecutiveCandidates) {
  SeeTen();
  See(3, 29);
  const auto first = See(4, 30);  // the first that is similar to its predecessor as well
  EXPECT_TRUE(first.front().similar);
  EXPECT_FALSE(first.front().repeated);
  EXPECT_TRUE(See(5, 31).front().repeated);
}

TEST_F(PlaceRecognitionTest, DistantCandidatesAreNotConsecutive) {
  SeeTen();
  See(0, 30);
  See(1, 31);
  EXPECT_FALSE(See(8, 32).front().repeated);
}

TEST_F(PlaceRecognitionTest, NormalizesByThePreviousImage) {
  SeeTen();
  See(40, 30);
  See(41, 31);
  const auto candidates = See(5, 32);  // its predecessor shows another place
  ASSERT_FALSE(candidates.empty());
  EXPECT_FALSE(candidates.front().similar);
}

// The predecessor belongs to another world and shows another place.
TEST_F(PlaceRecognitionTest, NormalizesTheFirstImageOfAWorldByItself) {
  SeeTen();
  See(40, 10);
  const auto candidates = See(5, 30, /*world=*/1);
  ASSERT_FALSE(candidates.empty());
  EXPECT_TRUE(candidates.front().similar);
}

}  // namespace
}  // namespace plm_vins
