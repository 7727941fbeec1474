// SPDX-License-Identifier: BSD-3-Clause
#include "common/io/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::HasSubstr;
using testing::MessageOf;
using testing::TemporaryFolder;

constexpr char kFullDisk[] = "/dev/full";  // accepts only what fits into a buffer

TEST(OutputFile, ErrorNamesTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder.File("missing/poses.tum");
  EXPECT_THAT(MessageOf([&] { OutputFile{file}; }),
              ::testing::AllOf(HasSubstr(file), HasSubstr("No such file")));
}

TEST(OutputFile, NoticesAFullDiskWhenItIsClosed) {
  OutputFile file(kFullDisk);
  file.stream() << "a few bytes, which stay in the buffer";
  EXPECT_TRUE(file.stream().good());
  EXPECT_THAT(MessageOf([&] { file.Close(); }), HasSubstr("/dev/full"));
}

TEST(OutputFile, NoticesAFullDiskWhileItIsWritten) {
  OutputFile file(kFullDisk);
  const auto write = [&] {
    for (int i = 0; i < 100; ++i) file.stream() << std::string(1000, 'x');
  };
  EXPECT_THAT(MessageOf(write), HasSubstr("cannot write /dev/full: disk full?"));
}

TEST(ReplacedFile, KeepsTheOldFileUntilCommit) {
  const TemporaryFolder folder;
  folder.Write("map", "old");
  ReplacedFile file(folder.File("map"));
  file.stream() << "new";
  EXPECT_EQ(folder.Read("map"), "old");
  file.Commit();
  EXPECT_EQ(folder.Read("map"), "new");
}

TEST(ReplacedFile, LeavesNoTraceWithoutCommit) {
  const TemporaryFolder folder;
  folder.Write("map", "old");
  { ReplacedFile(folder.File("map")).stream() << "half of the n"; }
  EXPECT_EQ(folder.Read("map"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder.File("map.part")));
}

TEST(ReplacedFile, DoesNotReplaceAFolderOrADevice) {
  const TemporaryFolder folder;
  folder.Write("map/in", "a folder of that name");
  const std::string path = folder.File("map");
  EXPECT_THAT(MessageOf([&] { ReplacedFile{path}; }), HasSubstr(path));
  EXPECT_THAT(MessageOf([&] { ReplacedFile{kFullDisk}; }), HasSubstr(kFullDisk));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(ReplacedFile, FollowsALink) {
  const TemporaryFolder folder;
  folder.Write("map", "old");
  std::filesystem::create_symlink(folder.File("map"), folder.File("link"));
  ReplacedFile file(folder.File("link"));
  file.stream() << "new";
  file.Commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.File("link")));
  EXPECT_EQ(folder.Read("map"), "new");
}

}  // namespace
}  // namespace plm_vins
