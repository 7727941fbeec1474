// SPDX-License-Identifier: BSD-3-Clause
#include "offline/recordings/bag_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/offline/recording_contents.h"
#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::MessageOf;

class BagFiles : public ::testing::Test {
 protected:
  BagFiles() {
    for (const char* name : {"flight/a_1.bag", "flight/a_0.bag", "flight/notes.txt", "b.bag"}) {
      folder_.Write(name, "");
    }
  }

  testing::TemporaryFolder folder_;
  const std::string first_ = folder_.File("flight/a_0.bag");
  const std::string second_ = folder_.File("flight/a_1.bag");
};

TEST_F(BagFiles, ComeFromFilesFoldersAndPatternsOnce) {
  EXPECT_THAT(FindBags({second_, first_}), ElementsAre(first_, second_));
  EXPECT_THAT(FindBags({folder_.File("flight")}), ElementsAre(first_, second_));
  EXPECT_THAT(FindBags({folder_.File("*/a_?.bag")}), ElementsAre(first_, second_));
  EXPECT_THAT(FindBags({first_, folder_.File("flight/../b.bag"), folder_.path() + "/*/a*.bag"}),
              ElementsAre(folder_.File("flight/../b.bag"), first_, second_));
}

TEST_F(BagFiles, MayHaveTheCharactersOfAPatternInTheirNames) {
  folder_.Write("a[1].bag", "");
  EXPECT_THAT(FindBags({folder_.File("a[1].bag")}), ElementsAre(folder_.File("a[1].bag")));
}

TEST_F(BagFiles, ErrorNamesAPlaceWithoutBags) {
  EXPECT_THAT(MessageOf([&] { FindBags({folder_.File("*.bags")}); }),
              HasSubstr("no file matches " + folder_.File("*.bags")));
  EXPECT_THAT(MessageOf([&] {
                FindBags({folder_.path(), folder_.File("flight/..")});
              }),
              ::testing::IsEmpty());
  folder_.Write("empty/data.csv", "");
  EXPECT_THAT(MessageOf([&] { FindBags({folder_.File("empty")}); }),
              AllOf(HasSubstr(folder_.File("empty")), HasSubstr("--asl")));
}

TEST_F(BagFiles, PassesMissingFilesOn) {
  EXPECT_THAT(FindBags({"missing.bag"}), ElementsAre("missing.bag"));
}

}  // namespace
}  // namespace plm_vins
