// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/csv_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/testing/message_of.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

TEST(CsvReader, ReadsRowsWithBlanksAndWindowsLineEnds) {
  const testing::TemporaryFolder folder;
  folder.Write("data.csv", "#timestamp [ns],a,b\r\n1403636579763555584, 1.5 ,x.png\r\n\n7,2,y\n");
  CsvReader reader(folder.File("data.csv"), 2);
  const auto first = reader.Next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->t_ns, 1403636579763555584);
  EXPECT_EQ(first->values, (std::vector<std::string>{"1.5", "x.png"}));
  EXPECT_EQ(reader.Next()->t_ns, 7);
  EXPECT_FALSE(reader.Next());
  EXPECT_EQ(reader.bad_lines(), 0);
}

TEST(CsvReader, SkipsBadLinesAndReportsTheFirst) {
  const testing::TemporaryFolder folder;
  folder.Write("data.csv", "#t,a\n1,ok\n2\nthree,3\n4.5,4\n5,ok\n");
  CsvReader reader(folder.File("data.csv"), 1);
  EXPECT_EQ(reader.Next()->t_ns, 1);
  EXPECT_EQ(reader.Next()->t_ns, 5);
  EXPECT_FALSE(reader.Next());
  EXPECT_EQ(reader.bad_lines(), 3);
  EXPECT_EQ(reader.first_bad_line(), folder.File("data.csv") + ":3");
}

TEST(CsvReader, SkipsAByteOrderMark) {
  const testing::TemporaryFolder folder;
  folder.Write("data.csv",
               "\xef\xbb\xbf"
               "1,ok\n");
  folder.Write("head.csv", "\xef\xbb\xbf#t,a\n1,ok\n");
  for (const char* name : {"data.csv", "head.csv"}) {
    CsvReader reader(folder.File(name), 1);
    ASSERT_TRUE(reader.Next());
    EXPECT_EQ(reader.bad_lines(), 0);
  }
}

TEST(CsvReader, SkipsInvalidStamps) {
  const testing::TemporaryFolder folder;
  folder.Write("data.csv",
               "-1,a\n9223372036854775807,a\n4294967296000000000,a\n"
               "4294967295999999999,a\n");
  CsvReader reader(folder.File("data.csv"), 1);
  EXPECT_EQ(reader.Next()->t_ns, 4294967295999999999);
  EXPECT_EQ(reader.bad_lines(), 3);
}

TEST(CsvReader, ErrorNamesAMissingFile) {
  EXPECT_THAT(testing::MessageOf([] { CsvReader reader("no/such/data.csv", 1); }),
              ::testing::HasSubstr("no/such/data.csv"));
}

}  // namespace
}  // namespace plm_vins
