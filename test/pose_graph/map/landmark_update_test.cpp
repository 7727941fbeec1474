// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map/landmark_update.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::Wall;

constexpr double kMaxError = 4 / testing::kFocalLength;  // normalized

// Three keyframes a meter apart with the same tracks.
class UpdateLandmarksTest : public ::testing::Test {
 protected:
  UpdateLandmarksTest() {
    testing::VisitOptions options;
    options.noise = 0;
    for (int i = 0; i < 3; ++i) {
      const Rigid3d T_W_B(Eigen::Quaterniond::Identity(), {0, 0.5 * i, 0});
      keyframes_.push_back(testing::Visit(wall_, *camera_, T_W_B, i, options));
    }
  }

  // Moves the landmarks of a keyframe along their rays, so that their images stay the same.
  static void SpoilDepths(Keyframe* keyframe) {
    const Eigen::Vector3f from = keyframe->T_O_C(0).translation.cast<float>();
    for (DescribedCorner& corner : keyframe->corners) {
      corner.p_O = from + 1.1f * (*corner.p_O - from);
    }
  }

  static const DescribedCorner* Find(const Keyframe& keyframe, int64_t track) {
    for (const DescribedCorner& corner : keyframe.corners) {
      if (corner.track == track) return &corner;
    }
    return nullptr;
  }

  // Largest landmark error of a keyframe over the tracks of the newest one [m].
  double LargestError(const Keyframe& keyframe) const {
    double largest = 0;
    for (const DescribedCorner& corner : keyframe.corners) {
      if (!Find(keyframes_.back(), corner.track) || !corner.p_O) continue;
      const Eigen::Vector3d truth = wall_.points[static_cast<size_t>(corner.track)].p_W;
      largest = std::max(largest, (corner.p_O->cast<double>() - truth).norm());
    }
    return largest;
  }

  const Wall wall_;
  std::shared_ptr<const CameraModel> camera_ = testing::SimpleCamera();
  std::vector<Keyframe> keyframes_;
};

TEST_F(UpdateLandmarksTest, GivesAllCornersOfATrackTheNewestPosition) {
  SpoilDepths(&keyframes_[0]);
  SpoilDepths(&keyframes_[1]);
  ASSERT_GT(LargestError(keyframes_[0]), 0.2);
  UpdateLandmarks(kMaxError, &keyframes_);
  EXPECT_LT(LargestError(keyframes_[0]), 1e-5);
  EXPECT_LT(LargestError(keyframes_[1]), 1e-5);
}

TEST_F(UpdateLandmarksTest, AddsAMissingPosition) {
  for (DescribedCorner& corner : keyframes_[0].corners) corner.p_O.reset();
  UpdateLandmarks(kMaxError, &keyframes_);
  int placed = 0;
  for (const DescribedCorner& corner : keyframes_[0].corners) placed += corner.p_O ? 1 : 0;
  EXPECT_GT(placed, 20);
  EXPECT_LT(LargestError(keyframes_[0]), 1e-5);
}

TEST_F(UpdateLandmarksTest, KeepsAContradictingPosition) {
  for (DescribedCorner& corner : keyframes_[2].corners) *corner.p_O += Eigen::Vector3f(0, 0.3f, 0);
  UpdateLandmarks(kMaxError, &keyframes_);
  EXPECT_LT(LargestError(keyframes_[0]), 1e-5);
}

TEST_F(UpdateLandmarksTest, SkipsRemovedKeyframes) {
  SpoilDepths(&keyframes_[0]);
  keyframes_[1].corners.clear();
  UpdateLandmarks(kMaxError, &keyframes_);
  EXPECT_LT(LargestError(keyframes_[0]), 1e-5);
}

TEST_F(UpdateLandmarksTest, DoesNotChangeOtherWorlds) {
  SpoilDepths(&keyframes_[0]);
  keyframes_[1].world = keyframes_[2].world = 1;
  UpdateLandmarks(kMaxError, &keyframes_);
  EXPECT_GT(LargestError(keyframes_[0]), 0.2);
}

TEST_F(UpdateLandmarksTest, DoesNotChangeUntrackedCorners) {
  for (Keyframe& keyframe : keyframes_) {
    for (DescribedCorner& corner : keyframe.corners) corner.track = -1;
  }
  keyframes_[0].corners.front().p_O.reset();
  UpdateLandmarks(kMaxError, &keyframes_);
  EXPECT_FALSE(keyframes_[0].corners.front().p_O);
}

TEST(UpdateLandmarks, AcceptsAnEmptyMap) {
  std::vector<Keyframe> none;
  UpdateLandmarks(kMaxError, &none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace plm_vins
