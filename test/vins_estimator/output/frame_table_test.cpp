// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/frame_table.h"

#include <gtest/gtest.h>

#include <numeric>
#include <sstream>

namespace plm_vins {
namespace {

TEST(FrameTable, HasTheAgreedColumns) {
  std::ostringstream stream;
  WriteFrameHeader(&stream);
  FrameCounts counts;
  std::iota(counts.begin(), counts.end(), 1);
  WriteFrameRow(1403636579763555584, {1, 2, 3, 4, 5, 6, 7, 8, 9.25}, counts, &stream);
  EXPECT_EQ(stream.str(),
            "stamp_ns,point_tracking,line_detection,line_tracking,initialization,line_merging,"
            "optimization,marginalization,estimator,total,points_followed,points_flow_lost,"
            "points_not_back,points_epipolar,points_crowded,points_added,points_observed,"
            "points_in_window,points_rejected,"
            "lines_followed,lines_unmatched,lines_off_course,"
            "lines_edge_lost,lines_duplicate,lines_detected,lines_added,lines_observed,"
            "lines_triangulated,lines_degenerate,lines_behind,lines_inconsistent,lines_too_long,"
            "lines_merged,lines_recognized,merge_candidates,merge_other_direction,merge_distant,"
            "merge_apart,merge_distant_in_image,merge_side_by_side,merge_inconsistent,"
            "lines_in_window,lines_rejected,right_used,right_rejected,depths_used,"
            "depths_rejected\n"
            "1403636579763555584,1.0000,2.0000,3.0000,4.0000,5.0000,6.0000,7.0000,8.0000,9.2500,"
            "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31,"
            "32,33,34,35,36,37\n");
}

}  // namespace
}  // namespace plm_vins
