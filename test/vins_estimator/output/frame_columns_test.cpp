// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_columns.h"

#include <gtest/gtest.h>

#include <sstream>

namespace plm_vins {
namespace {

TEST(FrameTable, HasARowOfNamesAndOneForEachFrame) {
  const FrameColumns columns{{{"tracking", 0}, {"total", 9.25}}, {{"points", 1}, {"lines", 37}}};
  std::ostringstream stream;
  WriteFrameHeader(columns, &stream);
  WriteFrameRow(1403636579763555584, columns, &stream);
  EXPECT_EQ(stream.str(),
            "stamp_ns,tracking,total,points,lines\n1403636579763555584,0.0000,9.2500,1,37\n");
}

}  // namespace
}  // namespace plm_vins
