// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/output/ply_writer.h"

#include <gtest/gtest.h>

#include "test/testing/temporary_folder.h"

namespace plm_vins {
namespace {

constexpr char kVertexProperties[] = "property float x\nproperty float y\nproperty float z\n";

TEST(PlyPointWriter, FillsInTheCountAtTheEnd) {
  const testing::TemporaryFolder folder;
  PlyPointWriter writer(folder.File("map.ply"));
  writer.Add({1, 2, 3});
  writer.Add({-0.5, 0, 1e-5});
  writer.Finish();
  EXPECT_EQ(folder.Read("map.ply"),
            std::string("ply\nformat ascii 1.0\nelement vertex 2           \n") +
                kVertexProperties + "end_header\n1.0000 2.0000 3.0000\n-0.5000 0.0000 0.0000\n");
}

TEST(PlyPointWriter, AnEmptyMapIsValid) {
  const testing::TemporaryFolder folder;
  PlyPointWriter(folder.File("map.ply")).Finish();
  EXPECT_EQ(folder.Read("map.ply"),
            std::string("ply\nformat ascii 1.0\nelement vertex 0           \n") +
                kVertexProperties + "end_header\n");
}

TEST(Segments, PlyJoinsVerticesByEdgesInTheColorsOfTheirAxes) {
  std::ostringstream stream;
  WriteSegmentsPly({{7, {0, 0, 0}, {1, 0, 0}}, {8, {0, 1, 0}, {0, 1, 2}, LineAxis::kZ}}, &stream);
  EXPECT_EQ(stream.str(), std::string("ply\nformat ascii 1.0\nelement vertex 4\n") +
                              kVertexProperties +
                              "element edge 2\nproperty int vertex1\nproperty int vertex2\n"
                              "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                              "end_header\n"
                              "0.0000 0.0000 0.0000\n1.0000 0.0000 0.0000\n"
                              "0.0000 1.0000 0.0000\n0.0000 1.0000 2.0000\n"
                              "0 1 140 140 140\n2 3 50 90 230\n");
}

TEST(Segments, ObjCountsFromOne) {
  std::ostringstream stream;
  WriteSegmentsObj({{7, {0, 0, 0}, {1, 0, 0}}, {8, {0, 1, 0}, {0, 1, 2}}}, &stream);
  EXPECT_EQ(stream.str(),
            "v 0.0000 0.0000 0.0000\nv 1.0000 0.0000 0.0000\n"
            "v 0.0000 1.0000 0.0000\nv 0.0000 1.0000 2.0000\n"
            "l 1 2\nl 3 4\n");
}

}  // namespace
}  // namespace plm_vins
