// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/timed_file.h"

#include <gtest/gtest.h>

#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

TEST(TimedFile, IsOneFileIfTimeRunsForward) {
  const testing::TemporaryFolder folder;
  TimedFile file(folder.File("rows.csv"), "names\n");
  file.Row(1) << "one\n";
  file.Comment("# why\n");
  file.Row(2) << "two\n";
  file.Comment("# end\n");
  file.Close();
  EXPECT_EQ(file.parts(), 0);
  EXPECT_EQ(folder.Read("rows.csv"), "names\none\n# why\ntwo\n# end\n");
}

TEST(TimedFile, KeepsRowsBeforeEachBackwardJump) {
  const testing::TemporaryFolder folder;
  TimedFile file(folder.File("rows.csv"), "names\n");
  file.Row(8) << "eight\n";
  file.Comment("# why\n");
  file.Row(4) << "four\n";
  file.Row(4) << "four again\n";
  file.Close();
  EXPECT_EQ(file.parts(), 2);
  EXPECT_EQ(folder.Read("rows_1.csv"), "names\neight\n");
  EXPECT_EQ(folder.Read("rows_2.csv"), "names\n# why\nfour\n");
  EXPECT_EQ(folder.Read("rows.csv"), "names\nfour again\n");
}

}  // namespace
}  // namespace plm_vins
