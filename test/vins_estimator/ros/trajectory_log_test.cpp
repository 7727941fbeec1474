// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

const char kRow[] =
    "2.500000000 1.000000000 2.000000000 3.000000000 "
    "0.000000000 0.000000000 0.000000000 1.000000000\n";
const Rigid3d kPose(Eigen::Quaterniond::Identity(), {1, 2, 3});

class TrajectoryLogTest : public ::testing::Test {
 protected:
  // Content of the file after saving.
  std::string Saved() {
    log_.Save(folder_.File("a.tum"));
    return folder_.Read("a.tum");
  }

  const testing::TemporaryFolder folder_;
  TrajectoryLog log_;
};

TEST_F(TrajectoryLogTest, ASecondSaveTakesThePlaceOfTheFirst) {
  EXPECT_TRUE(log_.empty());
  EXPECT_EQ(Saved(), "");
  log_.Add(2'500'000'000, kPose);
  EXPECT_FALSE(log_.empty());
  EXPECT_EQ(log_.Save(folder_.File("a.tum")), 1u);
  EXPECT_EQ(Saved(), kRow);
}

TEST_F(TrajectoryLogTest, TellsOfANewWorldFrame) {
  log_.Add(1'000'000'000, Rigid3d());
  const std::string before = Saved();
  log_.BeginWorld("it flew away");
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(Saved(), before + "# the world frame starts anew: it flew away\n" + kRow);
}

TEST_F(TrajectoryLogTest, HasNoPoseFromBeforeTheStampsJumpedBack) {
  log_.Add(5'000'000'000, kPose);
  log_.BeginWorld("stamps jumped back");
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(Saved(), std::string("# the world frame starts anew: stamps jumped back\n") + kRow);
}

TEST_F(TrajectoryLogTest, MakesTheFolder) {
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(log_.Save(folder_.File("new/folder/a.tum")), 1u);
  EXPECT_EQ(folder_.Read("new/folder/a.tum"), kRow);
}

TEST_F(TrajectoryLogTest, SaysWhyAFileCannotBeWritten) {
  for (const auto& [file, why] : {std::pair("/dev/null/a.tum", "Not a directory"),
                                  {"/", "Is a directory"},
                                  {"/proc/a.tum", "No such file or directory"}}) {
    try {
      log_.Save(file);
      ADD_FAILURE() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::string("cannot write ") + file + ": " + why);
    }
  }
}

}  // namespace
}  // namespace plm_vins
