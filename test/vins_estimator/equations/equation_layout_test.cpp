// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/equation_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/factors/zero_velocity_factor.h"

namespace plm_vins {
namespace {

constexpr ChainKind kOtherFrame = {/*same_frame=*/false, /*same_camera=*/true};

using ::testing::ElementsAre;

// Poses of three frames, one motion, calibration, and a point that the first and last frames
// observe.
class EquationLayoutTest : public ::testing::Test {
 protected:
  EquationLayoutTest() {
    td_ = Add(BlockKind::kTimeOffset, 0);
    for (const int64_t frame : {1, 2, 3}) poses_[frame - 1] = Add(BlockKind::kPose, frame);
    motion_ = Add(BlockKind::kMotion, 3);
    earlier_motion_ = Add(BlockKind::kMotion, 2);
    extrinsic_ = problem_.AddVariable({BlockKind::kExtrinsic, 0}, values_.data(), true);
    problem_.AddTerm(ZeroVelocityFactor(1.0), nullptr, {motion_});
    const int landmark = problem_.AddLandmark({BlockKind::kPoint, 7}, values_.data());
    point_ = problem_.Find({BlockKind::kPoint, 7});
    problem_.AddLandmarkTerm(landmark, PointFactor(kOtherFrame, TimedBearing(), 1.0), nullptr,
                             {extrinsic_, poses_[2], poses_[0], td_, point_});
  }

  int Add(BlockKind kind, int64_t key) { return problem_.AddVariable({kind, key}, values_.data()); }

  std::array<double, 9> values_ = {};
  WindowProblem problem_;
  std::array<int, 3> poses_;
  int td_, motion_, earlier_motion_, extrinsic_, point_;
};

TEST_F(EquationLayoutTest, OrdersMotionsLastAndOmitsConstantsAndLandmarks) {
  const EquationLayout layout(problem_);
  EXPECT_EQ(layout.dense_size(), 3 * 6 + 2 * 9 + 1);
  EXPECT_EQ(layout.motion_size(), 2 * 9);
  const std::vector<int>& offset = layout.dense_offset();
  EXPECT_THAT((std::array{offset[poses_[0]], offset[poses_[1]], offset[poses_[2]]}),
              ElementsAre(1, 7, 13));
  EXPECT_EQ(offset[td_], 0);
  EXPECT_EQ(offset[earlier_motion_], 19);
  EXPECT_EQ(offset[motion_], 28);
  EXPECT_EQ(offset[extrinsic_], -1);
  EXPECT_EQ(offset[point_], -1);
}

TEST_F(EquationLayoutTest, TermsHaveTheirVariablesInOrderOfColumns) {
  const EquationLayout layout(problem_);
  ASSERT_EQ(layout.terms().size(), 2u);
  EXPECT_EQ(layout.terms()[0].landmark, -1);
  const TermLayout& seen = layout.terms()[1];
  EXPECT_EQ(seen.landmark, 0);
  EXPECT_EQ(seen.landmark_block, 4);
  ASSERT_EQ(seen.slot_count, 3);
  EXPECT_THAT((std::array{seen.slots[0].block, seen.slots[1].block, seen.slots[2].block}),
              ElementsAre(3, 2, 1));
  EXPECT_THAT((std::array{seen.slots[0].dense_offset, seen.slots[1].dense_offset,
                          seen.slots[2].dense_offset}),
              ElementsAre(0, 1, 13));
}

TEST_F(EquationLayoutTest, LandmarksHaveTheColumnsOfTheirTermsInRuns) {
  const EquationLayout layout(problem_);
  const std::vector<ColumnRun>& runs = layout.landmarks()[0];
  EXPECT_EQ(CountColumns(runs), 13);
  ASSERT_EQ(runs.size(), 2u);  // the time offset and the first pose are adjacent
  EXPECT_EQ(runs[0].size, 7);
  EXPECT_EQ(runs[1].dense, 13);
  EXPECT_EQ(runs[1].local, 7);
  EXPECT_EQ(runs[1].size, 6);
  const TermLayout& seen = layout.terms()[1];
  EXPECT_THAT((std::array{seen.slots[0].local_offset, seen.slots[1].local_offset,
                          seen.slots[2].local_offset}),
              ElementsAre(0, 1, 7));
}

}  // namespace
}  // namespace plm_vins
