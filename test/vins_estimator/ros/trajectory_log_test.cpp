// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

TEST(TrajectoryLog, SavesWhatWasAddedSinceClear) {
  const testing::TemporaryFolder folder;
  TrajectoryLog log;
  log.Add(1'000'000'000, Rigid3d());
  log.Clear();
  log.Add(2'500'000'000, Rigid3d(Eigen::Quaterniond::Identity(), {1, 2, 3}));
  EXPECT_EQ(log.Save(folder.File("a.tum")), 1u);
  EXPECT_EQ(folder.Read("a.tum"),
            "2.500000000 1.000000000 2.000000000 3.000000000 "
            "0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(TrajectoryLog, SaysThatAFileCannotBeWritten) {
  EXPECT_THROW(TrajectoryLog().Save("no/such/folder/a.tum"), std::runtime_error);
}

}  // namespace
}  // namespace plm_vins
