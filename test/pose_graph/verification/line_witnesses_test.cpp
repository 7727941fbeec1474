// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/verification/line_witnesses.h"

#include <gtest/gtest.h>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

using testing::kFocalLength;

class FindWitnessesTest : public ::testing::Test {
 protected:
  LineWitnesses Find(const Rigid3d& T_O_B, const std::vector<SpaceSegment>& lines) const {
    return FindWitnesses(LineWitnessOptions(kFocalLength), *camera_,
                         T_O_B * testing::LookingAhead(), lines, seen_.segments);
  }

  std::shared_ptr<const CameraModel> camera_ = testing::SimpleCamera();
  testing::Wall wall_;
  Keyframe seen_ = testing::Visit(wall_, *camera_, Rigid3d(), 0, testing::VisitOptions());
};

TEST_F(FindWitnessesTest, FindsAllLinesFromTheTruePlace) {
  const LineWitnesses witnesses = Find(Rigid3d(), wall_.lines);
  EXPECT_EQ(witnesses.visible, 12);
  EXPECT_EQ(witnesses.share(), 1);
}

TEST_F(FindWitnessesTest, FindsFewFromAWrongPlace) {
  EXPECT_LT(Find({Eigen::Quaterniond::Identity(), {0, 0.2, 0}}, wall_.lines).share(), 0.2);
}

TEST_F(FindWitnessesTest, CountsOnlyLinesInView) {
  std::vector<SpaceSegment> lines = wall_.lines;
  lines.push_back({{-5, 0, -1}, {-5, 0, 1}});  // behind
  lines.push_back({{5, 20, -1}, {5, 20, 1}});  // outside the image
  EXPECT_EQ(Find(Rigid3d(), lines).visible, 12);
}

TEST_F(FindWitnessesTest, RequiresOverlappingSegments) {
  const SpaceSegment& line = wall_.lines[6];
  const Eigen::Vector3d along = line.end_O - line.start_O;
  // Another piece of the same infinite line, beyond the segment's end.
  const SpaceSegment beyond = {line.end_O + 0.05 * along, line.end_O + 0.4 * along};
  EXPECT_EQ(Find(Rigid3d(), {beyond}).visible, 1);
  EXPECT_EQ(Find(Rigid3d(), {beyond}).seen.size(), 0u);
}

TEST_F(FindWitnessesTest, HasNoShareWithoutLines) { EXPECT_EQ(Find(Rigid3d(), {}).share(), 0); }

}  // namespace
}  // namespace plm_vins
