// SPDX-License-Identifier: BSD-3-Clause
// Each gate has a test case that it alone rejects.
#include "pose_graph/verification/loop_verification.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::Visit;
using testing::VisitOptions;
using testing::Wall;

constexpr double kDegree = M_PI / 180;

class LoopVerificationTest : public ::testing::Test {
 protected:
  LoopVerificationTest() {
    later_.first_track = 1000;
    later_.T_O_W = {10 * kDegree, {0.5, -0.3, 0.2}};  // drift
  }

  LoopCandidate Verify() {
    const Keyframe earlier = Visit(wall_, *camera_, Rigid3d(), 0, earlier_);
    const Rigid3d T_W_B(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())),
                        {0.3, 0.2, 0.1});
    const Keyframe later = Visit(second_wall_ ? *second_wall_ : wall_, *camera_, T_W_B, 1, later_);
    return VerifyPair(earlier, later);
  }

  LoopCandidate VerifyPair(const Keyframe& earlier, const Keyframe& later) {
    const LoopVerification verification(options_, {camera_});
    LoopCandidate candidate;
    observations_ =
        verification.Verify({&earlier, 0, {&earlier}}, {&later, 0, {&later}}, &candidate);
    truth_ = earlier_.T_O_W * later_.T_O_W.Inverse();
    error_ = earlier.T_O_L() * candidate.T_earlier_later * later.T_O_L().Inverse();
    return candidate;
  }

  std::shared_ptr<const CameraModel> camera_ = testing::SimpleCamera();
  Wall wall_;
  std::optional<Wall> second_wall_;
  VisitOptions earlier_;
  VisitOptions later_;
  LoopVerificationOptions options_{testing::kFocalLength};
  LoopObservations observations_;
  LevelTransform truth_;
  LevelTransform error_;
};

// Gates are in pixels: corners of a wide-angle lens have the same pixel errors, and larger angular
// ones.
TEST_F(LoopVerificationTest, ThresholdsAreInPixelsForEveryLens) {
  constexpr double kWide = 191;  // [px]
  camera_ = testing::SimpleCamera(kWide);
  earlier_.noise = later_.noise = 2.5 / kWide;
  EXPECT_EQ(Verify().failed, LoopGate::kInliers);
  options_ = LoopVerificationOptions(kWide);
  EXPECT_FALSE(Verify().failed);
}

TEST_F(LoopVerificationTest, AcceptsTheSamePlaceAndMeasuresTheDrift) {
  const LoopCandidate candidate = Verify();
  EXPECT_FALSE(candidate.failed) << ToString(*candidate.failed);
  EXPECT_NEAR(error_.yaw, truth_.yaw, 0.2 * kDegree);
  EXPECT_LT((error_.translation - truth_.translation).norm(), 0.02);
  EXPECT_GT(candidate.inlier_share, 0.9);
  EXPECT_GT(candidate.line_share, 0.9);
  EXPECT_GT(candidate.covariance(0, 0), 0);
  EXPECT_EQ(observations_.of_earlier.size(), static_cast<size_t>(*candidate.inliers));
  EXPECT_EQ(observations_.of_later.size(), static_cast<size_t>(*candidate.backward_inliers));
  EXPECT_FALSE(observations_.lines.empty());
}

TEST_F(LoopVerificationTest, RejectsTheSameVisit) {
  later_.first_track = earlier_.first_track;  // tracks continue
  EXPECT_EQ(Verify().failed, LoopGate::kApart);
}

TEST_F(LoopVerificationTest, IgnoresContinuingTracks) {
  const int inliers = Verify().inliers.value();
  later_.first_track = earlier_.first_track + 120;  // of 150: some tracks are in both visits
  const LoopCandidate candidate = Verify();
  EXPECT_FALSE(candidate.failed) << ToString(*candidate.failed);
  EXPECT_GT(*candidate.common_tracks, 10);
  EXPECT_LE(*candidate.inliers, inliers - *candidate.common_tracks / 2);
}

TEST_F(LoopVerificationTest, DoesNotPairEqualTrackIdsOfDifferentWorlds) {
  later_.first_track = earlier_.first_track;
  later_.world = 1;
  EXPECT_FALSE(Verify().failed);
}

TEST_F(LoopVerificationTest, RejectsAnotherPlace) {
  second_wall_.emplace(/*seed=*/77);
  EXPECT_EQ(Verify().failed, LoopGate::kMatches);
}

TEST_F(LoopVerificationTest, RejectsTheSameThingsInAnotherOrder) {
  second_wall_ = wall_;
  simulator::Random random(5);
  for (testing::WallPoint& point : second_wall_->points) {
    point.p_W = {random.Uniform(3, 8), random.Uniform(-4, 4), random.Uniform(-2, 2)};
  }
  EXPECT_EQ(Verify().failed, LoopGate::kPose);
}

// A displaced poster: a part of the image agrees on a pose, the rest does not.
TEST_F(LoopVerificationTest, RejectsIfMostLandmarksAreElsewhere) {
  second_wall_ = wall_;
  constexpr double kShifts[] = {0, 0.15, -0.2, 0.3};  // a quarter of the points agrees on a pose
  options_.matching.search_radius = 0.15;             // shows that the others are off
  for (size_t i = 0; i < second_wall_->points.size(); ++i) {
    second_wall_->points[i].p_W.y() += kShifts[i % 4];
  }
  EXPECT_EQ(Verify().failed, LoopGate::kInliers);
}

TEST_F(LoopVerificationTest, RejectsMatchesInOneImageCornerOnly) {
  wall_ = Wall(1, 0);
  simulator::Random random(6);
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d p_W(random.Uniform(4, 6), random.Uniform(1.2, 1.6),
                              random.Uniform(0.6, 0.9));
    wall_.points.push_back({p_W, testing::RandomDescriptor(&random)});
  }
  EXPECT_EQ(Verify().failed, LoopGate::kSpread);
}

TEST_F(LoopVerificationTest, RejectsLoopsThatFailInReverse) {
  const Keyframe earlier = Visit(wall_, *camera_, Rigid3d(), 0, earlier_);
  Keyframe later = Visit(wall_, *camera_, Rigid3d(), 1, later_);
  for (DescribedCorner& corner : later.corners) *corner.p_O *= 1.3F;  // wrong scale
  EXPECT_EQ(VerifyPair(earlier, later).failed, LoopGate::kBackwards);
}

// The two directions have different minimum numbers, and their sum has another.
TEST_F(LoopVerificationTest, RejectsTooFewInliersOverBothDirections) {
  wall_ = Wall(/*seed=*/1, /*point_count=*/19);
  const Keyframe earlier = Visit(wall_, *camera_, Rigid3d(), 0, earlier_);
  const Keyframe later = Visit(wall_, *camera_, Rigid3d(), 1, later_);
  const auto verify_with_places = [&](int count) {
    Keyframe with_places = later;
    for (size_t i = count; i < later.corners.size(); ++i) with_places.corners[i].p_O.reset();
    return VerifyPair(earlier, with_places);
  };
  const int forwards = VerifyPair(earlier, later).inliers.value();
  ASSERT_LT(forwards, 20);
  const int backwards = options_.min_inliers_of_both - forwards;
  ASSERT_GT(backwards, options_.min_backward_inliers);
  EXPECT_EQ(verify_with_places(backwards - 1).failed, LoopGate::kBackwards);
  EXPECT_FALSE(verify_with_places(backwards).failed);
}

// Comparisons with NaN positions are false.
TEST_F(LoopVerificationTest, RejectsLandmarksWithoutPosition) {
  const Keyframe earlier = Visit(wall_, *camera_, Rigid3d(), 0, earlier_);
  Keyframe later = Visit(wall_, *camera_, Rigid3d(), 1, later_);
  const LoopCandidate accepted = VerifyPair(earlier, later);
  EXPECT_FALSE(accepted.failed);
  for (DescribedCorner& corner : later.corners) corner.p_O->setConstant(std::nanf(""));
  const LoopCandidate candidate = VerifyPair(earlier, later);
  EXPECT_EQ(candidate.failed, LoopGate::kRefinement);
  EXPECT_EQ(candidate.inliers, accepted.inliers);
  EXPECT_EQ(candidate.cells, accepted.cells);
  EXPECT_GE(candidate.backward_inliers, accepted.backward_inliers);
  EXPECT_GE(candidate.backward_share, accepted.backward_share);
}

TEST_F(LoopVerificationTest, RejectsIfLinesAreMissing) {
  later_.with_lines = false;
  EXPECT_EQ(Verify().failed, LoopGate::kLines);
  earlier_.with_lines = false;
  EXPECT_FALSE(Verify().failed);  // without lines the gate passes
}

}  // namespace
}  // namespace plm_vins
