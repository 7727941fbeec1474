// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/recall/anchor_policy.h"

#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "common/measurements.h"

namespace plm_vins {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int64_t kLine = 5;

int64_t Stamp(double seconds) { return ToNanoseconds(seconds); }

FrameState StateAt(double seconds, const Vector3d& p_W = Vector3d::Zero(),
                   const Quaterniond& q_W_B = Quaterniond::Identity()) {
  FrameState state;
  state.t_ns = Stamp(seconds);
  state.SetPose({q_W_B, p_W});
  return state;
}

// Three frames at the origin, at 10 s to 12 s, and a line that the first two have observed.
class AnchorPolicyTest : public ::testing::Test {
 protected:
  AnchorPolicyTest() {
    for (const double t : {10, 11, 12}) {
      WindowFrame frame;
      frame.state = StateAt(t);
      window_.frames.push_back(frame);
    }
    for (const double t : {10, 11}) See(t);
    Line().triangulated = true;
  }

  void See(double t) {
    LineFrame frame;
    frame.t_ns = Stamp(t);
    frame.lines = {{kLine, {0, 0}, {1, 0}}};
    lines_.AddFrame(frame);
  }

  LineLandmark& Line() { return lines_.landmarks().at(kLine); }
  bool Stays() const { return StaysAsAnchor(options_, window_, lines_); }

  AnchorPolicyOptions options_{EstimatorConfig()};
  SlidingWindow window_;
  LineMap lines_;
};

TEST_F(AnchorPolicyTest, KeepsAnAnchorForALineThatLeaves) { EXPECT_TRUE(Stays()); }

TEST_F(AnchorPolicyTest, KeepsNoAnchorForAnObservedLine) {
  See(12);
  EXPECT_FALSE(Stays());
}

TEST_F(AnchorPolicyTest, KeepsNoAnchorForAnUntriangulatedLine) {
  Line().triangulated = false;
  EXPECT_FALSE(Stays());
}

TEST_F(AnchorPolicyTest, KeepsNoAnchorForALineOfALaterFrame) {
  Line().observations.erase(Line().observations.begin());
  EXPECT_FALSE(Stays());
}

TEST_F(AnchorPolicyTest, KeepsNoAnchorIfDisabled) {
  options_.max_anchors = 0;
  EXPECT_FALSE(Stays());
}

TEST_F(AnchorPolicyTest, KeepsNoAnchorIfOneInUseIsClose) {
  window_.anchors = {{StateAt(2), Stamp(11)}};
  EXPECT_FALSE(Stays());
  window_.anchors = {{StateAt(1, {9, 0, 0}), Stamp(11)}, {StateAt(2), Stamp(11)}};
  EXPECT_FALSE(Stays());
}

TEST_F(AnchorPolicyTest, DistantAnchorDoesNotCount) {
  const double limit = options_.max_distance;
  window_.anchors = {{StateAt(2, {0.99 * limit, 0, 0}), Stamp(11)}};
  EXPECT_FALSE(Stays());
  window_.anchors = {{StateAt(2, {1.01 * limit, 0, 0}), Stamp(11)}};
  EXPECT_TRUE(Stays());
}

TEST_F(AnchorPolicyTest, RotatedAnchorDoesNotCount) {
  const double limit = options_.max_angle;
  window_.anchors = {{StateAt(2, Vector3d::Zero(), SO3Exp({0, 0, 0.99 * limit})), Stamp(11)}};
  EXPECT_FALSE(Stays());
  window_.anchors = {{StateAt(2, Vector3d::Zero(), SO3Exp({0, 0, 1.01 * limit})), Stamp(11)}};
  EXPECT_TRUE(Stays());
}

TEST_F(AnchorPolicyTest, UnusedAnchorDoesNotCount) {
  window_.anchors = {{StateAt(2), Stamp(12 - options_.max_idle)}};
  EXPECT_FALSE(Stays());
  window_.anchors[0].last_use_ns -= 1;
  EXPECT_TRUE(Stays());
}

TEST_F(AnchorPolicyTest, EvictsNoAnchorBelowCapacity) {
  options_.max_anchors = 2;
  EXPECT_EQ(AnchorToReplace(options_, window_), std::nullopt);
  window_.anchors = {{StateAt(1), Stamp(5)}};
  EXPECT_EQ(AnchorToReplace(options_, window_), std::nullopt);
}

TEST_F(AnchorPolicyTest, EvictsTheLeastRecentlyUsedAnchor) {
  options_.max_anchors = 3;
  window_.anchors = {{StateAt(1), Stamp(9)}, {StateAt(2), Stamp(5)}, {StateAt(3), Stamp(7)}};
  EXPECT_EQ(AnchorToReplace(options_, window_), Stamp(2));
}

TEST_F(AnchorPolicyTest, RecordsUseOfAnchorsThatObservedAnOptimizedLine) {
  window_.anchors = {{StateAt(1), Stamp(5)}, {StateAt(2), Stamp(6)}};
  NoteUse(lines_, &window_);
  EXPECT_EQ(window_.anchors[0].last_use_ns, Stamp(5));
  LineLandmark::Observation observation;
  observation.t_ns = Stamp(1);
  Line().anchor_observations = {observation};
  NoteUse(lines_, &window_);
  EXPECT_EQ(window_.anchors[0].last_use_ns, Stamp(12));
  EXPECT_EQ(window_.anchors[1].last_use_ns, Stamp(6));
}

}  // namespace
}  // namespace plm_vins
