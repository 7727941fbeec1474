// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/ros/trajectory_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"
#include "test/vins_estimator/ros/busy_disk.h"

namespace plm_vins {
namespace {

const char kRow[] =
    "2.500000000 1.000000000 2.000000000 3.000000000 "
    "0.000000000 0.000000000 0.000000000 1.000000000\n";
const Rigid3d kPose(Eigen::Quaterniond::Identity(), {1, 2, 3});

class TrajectoryLogTest : public ::testing::Test {
 protected:
  // Returns the content of the file after saving.
  std::string Saved() {
    log_.Save(folder_.File("a.tum"));
    return folder_.Read("a.tum");
  }

  const testing::TemporaryFolder folder_;
  TrajectoryLog log_;
};

TEST_F(TrajectoryLogTest, SecondSaveReplacesTheFirst) {
  log_.Add(1'000'000'000, kPose);
  const std::string first = Saved();
  std::ifstream reader(folder_.File("a.tum"));
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(log_.Save(folder_.File("a.tum")), 2u);
  EXPECT_EQ(folder_.Read("a.tum"), first + kRow);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), first) << "not in one step";
}

TEST_F(TrajectoryLogTest, WithoutAPoseTheFileIsUnchanged) {
  folder_.Write("a.tum", "of the flight before");
  EXPECT_TRUE(log_.empty());
  EXPECT_EQ(testing::MessageOf([&] { Saved(); }),
            "there is no pose to save yet; " + folder_.File("a.tum") + " is unchanged");
  EXPECT_EQ(folder_.Read("a.tum"), "of the flight before");
  log_.Add(2'500'000'000, kPose);
  EXPECT_FALSE(log_.empty());
}

TEST_F(TrajectoryLogTest, MarksANewWorldFrame) {
  log_.Add(1'000'000'000, Rigid3d());
  const std::string before = Saved();
  log_.BeginWorld("it flew away");
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(Saved(), before + "# the world frame starts anew: it flew away\n" + kRow);
}

TEST_F(TrajectoryLogTest, DropsPosesBeforeABackwardJump) {
  log_.Add(5'000'000'000, kPose);
  log_.BeginWorld("timestamps jumped back");
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(Saved(), std::string("# the world frame starts anew: timestamps jumped back\n") + kRow);
}

TEST_F(TrajectoryLogTest, MakesTheFolder) {
  log_.Add(2'500'000'000, kPose);
  EXPECT_EQ(log_.Save(folder_.File("new/folder/a.tum")), 1u);
  EXPECT_EQ(folder_.Read("new/folder/a.tum"), kRow);
}

TEST(FullPath, IsEmptyForAnEmptyName) {
  EXPECT_EQ(FullPath(""), "");
  EXPECT_EQ(FullPath("/a/../b.tum"), "/b.tum");
  EXPECT_EQ(FullPath("a.tum"), (std::filesystem::current_path() / "a.tum").string());
}

TEST_F(TrajectoryLogTest, ChecksWritabilityBeforeSaving) {
  folder_.Write("a.tum", "of the flight before");
  TrajectoryLog::CheckWritable(folder_.File("a.tum"));
  EXPECT_EQ(folder_.Read("a.tum"), "of the flight before");
  TrajectoryLog::CheckWritable(folder_.File("new/a.tum"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.File("new")));
  for (const std::string file : {"/dev/null/a.tum", "/", "/proc/a.tum"}) {
    EXPECT_THROW(TrajectoryLog::CheckWritable(file), std::runtime_error) << file;
  }
}

TEST_F(TrajectoryLogTest, ErrorSaysWhyAFileIsNotWritable) {
  log_.Add(2'500'000'000, kPose);
  for (const auto& [file, why] : {std::pair("/dev/null/a.tum", "Not a directory"),
                                  {"/", "it exists and is not a regular file"},
                                  {"/proc/a.tum", "No such file or directory"}}) {
    const std::string name = file;
    EXPECT_EQ(testing::MessageOf([&] { log_.Save(name); }), "cannot write " + name + ": " + why);
  }
}

TEST_F(TrajectoryLogTest, AcceptsPosesWhileSaving) {
  for (int i = 1; i <= 1000; ++i) log_.Add(i, kPose);  // more than a stream buffers
  EXPECT_TRUE(testing::EndsWhileSaving(
      folder_.File("a.tum"), [&] { EXPECT_EQ(log_.Save(folder_.File("a.tum")), 1000u); },
      [&] { log_.Add(1001, kPose); }));
}

}  // namespace
}  // namespace plm_vins
