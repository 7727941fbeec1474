// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_timings.h"

#include <gtest/gtest.h>

#include <sstream>

namespace plm_vins {
namespace {

TEST(FrameTimings, FileHasTheAgreedColumns) {
  std::ostringstream stream;
  WriteTimingHeader(&stream);
  WriteTimingRow(1403636579763555584, {1, 2, 3, 4, 5, 6, 7, 8.25}, &stream);
  EXPECT_EQ(stream.str(),
            "stamp_ns,point_tracking,line_detection,line_tracking,initialization,optimization,"
            "marginalization,estimator,total\n"
            "1403636579763555584,1.0000,2.0000,3.0000,4.0000,5.0000,6.0000,7.0000,8.2500\n");
}

TEST(FrameTimings, MeanAndPercentileAreOfTheStage) {
  std::vector<FrameTimings> frames(100);
  for (int i = 0; i < 100; ++i) {
    frames[i].fill(-1);
    frames[i][kOptimization] = (i * 37) % 100 + 1;  // 1 ... 100 in some order
  }
  const TimingSummary summary = Summarize(frames, kOptimization);
  EXPECT_DOUBLE_EQ(summary.mean, 50.5);
  EXPECT_DOUBLE_EQ(summary.p95, 95);
}

TEST(FrameTimings, OneFrameAndNone) {
  EXPECT_DOUBLE_EQ(Summarize({{1, 2, 3, 4, 5, 6, 7, 8}}, kTotal).p95, 8);
  EXPECT_DOUBLE_EQ(Summarize({}, kTotal).p95, 0);
  EXPECT_DOUBLE_EQ(Summarize({}, kTotal).mean, 0);
}

}  // namespace
}  // namespace plm_vins
