// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/loop_acceptance.h"

#include <gtest/gtest.h>

namespace plm_vins {
namespace {

// A path of 40 keyframes there and back, at intervals of a second and a meter: keyframe 20 + i is
// at the place of 20 - i.
class LoopAcceptanceTest : public ::testing::Test {
 protected:
  LoopAcceptanceTest() { AddWay(/*world=*/0, 41); }

  void AddWay(int world, int count) {
    const int first = static_cast<int>(keyframes_.size());
    for (int i = 0; i < count; ++i) {
      Keyframe keyframe;
      keyframe.t_ns = (first + i) * int64_t{1'000'000'000};
      keyframe.world = world;
      keyframe.path = i;
      keyframe.T_O_B.translation = {i <= 20 ? 1.0 * i : 40.0 - i, 0, 0};
      keyframes_.push_back(keyframe);
      graph_.AddNode(keyframe.T_O_L());
      if (i == 0) continue;
      const LevelTransform step = keyframes_[first + i - 1].T_O_L().Inverse() * keyframe.T_O_L();
      graph_.AddEdge({first + i - 1, first + i, step, 1e-4 * Matrix4d::Identity(), false,
                      step.translation.norm()});
    }
  }

  // A loop that requests a correction of odometry.
  LoopCandidate Loop(int earlier, int later, const Eigen::Vector3d& correction) {
    LoopCandidate loop;
    loop.earlier = earlier;
    loop.later = later;
    loop.later_ns = keyframes_[later].t_ns;
    loop.T_earlier_later = keyframes_[earlier].T_O_L().Inverse() * keyframes_[later].T_O_L();
    loop.T_earlier_later.translation += correction;
    loop.covariance = 1e-4 * Matrix4d::Identity();
    return loop;
  }

  // Returns the number of accepted loops.
  size_t Judge(LoopCandidate* loop) {
    const size_t confirmed = acceptance_.Judge(keyframes_, graph_, loop).size();
    return confirmed + (loop->failed ? 0 : 1);
  }

  std::vector<Keyframe> keyframes_;
  PoseGraph graph_;
  LoopAcceptance acceptance_;
};

TEST_F(LoopAcceptanceTest, AcceptsLoopsWithinTheDrift) {
  LoopCandidate loop = Loop(10, 30, {0, 0.5, 0});  // 2 % of 20 m are 0.4 m
  EXPECT_EQ(Judge(&loop), 1u);
  EXPECT_FALSE(loop.failed);
  EXPECT_LT(*loop.odometry_error, kThreeSigmaOf4Dof);
}

TEST_F(LoopAcceptanceTest, RejectsLoopsBeyondTheDrift) {
  LoopCandidate loop = Loop(10, 30, {0, 6, 0});
  EXPECT_EQ(Judge(&loop), 0u);
  EXPECT_EQ(loop.failed, LoopGate::kOdometry);
}

TEST_F(LoopAcceptanceTest, LargeCorrectionsNeedASecondLoop) {
  LoopCandidate first = Loop(10, 30, {0, 2.5, 0});
  EXPECT_EQ(Judge(&first), 0u);
  EXPECT_EQ(first.failed, LoopGate::kAgreement);
  LoopCandidate second = Loop(8, 32, {0, 2.5, 0});
  EXPECT_EQ(Judge(&second), 2u);
  EXPECT_FALSE(second.failed);
}

TEST_F(LoopAcceptanceTest, RejectsTwoLoopsThatDisagree) {
  LoopCandidate first = Loop(10, 30, {0, 2.5, 0});
  LoopCandidate second = Loop(8, 32, {0, -2.8, 0});
  EXPECT_EQ(Judge(&first) + Judge(&second), 0u);
  EXPECT_EQ(second.failed, LoopGate::kAgreement);
}

TEST_F(LoopAcceptanceTest, ALoopDoesNotConfirmItself) {
  LoopCandidate loop = Loop(10, 30, {0, 2.5, 0});
  EXPECT_EQ(Judge(&loop) + Judge(&loop), 0u);
}

TEST_F(LoopAcceptanceTest, ConfirmationExpires) {
  LoopCandidate first = Loop(14, 26, {0, 1.6, 0});
  LoopCandidate second = Loop(2, 38, {0, 4.0, 0});
  EXPECT_EQ(Judge(&first) + Judge(&second), 0u);
}

// The map has been rotated since: the uncertain direction of one loop is also that of the other.
TEST_F(LoopAcceptanceTest, ComparesLoopsAlongTheAxesOfTheMap) {
  AddWay(/*world=*/1, 21);
  graph_.MovePart(0, {M_PI / 2, {0, 0, 0}});
  for (const bool along : {true, false}) {
    acceptance_ = LoopAcceptance();
    LoopCandidate first = Loop(10, 41 + 10, {3, 4, 5});
    LoopCandidate second = Loop(12, 41 + 12, {along ? 4.5 : 3, along ? 4 : 5.5, 5});
    first.covariance(0, 0) = second.covariance(0, 0) = 1;  // along x of the earlier world
    EXPECT_EQ(Judge(&first), 0u);
    EXPECT_EQ(Judge(&second), along ? 2u : 0u);
  }
}

TEST_F(LoopAcceptanceTest, JoinsAnotherWorldWithTwoLoopsThatAgree) {
  AddWay(/*world=*/1, 21);
  LoopCandidate first = Loop(10, 41 + 10, {3, 4, 5});
  LoopCandidate second = Loop(12, 41 + 12, {3, 4, 5});
  EXPECT_EQ(Judge(&first), 0u);
  EXPECT_FALSE(first.odometry_error);  // odometry cannot predict it
  EXPECT_EQ(Judge(&second), 2u);
}

}  // namespace
}  // namespace plm_vins
