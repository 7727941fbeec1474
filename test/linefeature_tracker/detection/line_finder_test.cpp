// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/detection/line_finder.h"

#include <gtest/gtest.h>

#include "linefeature_tracker/following/line_flow.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

// Counts the edges that coincide with a line, to about one pixel.
int CountFound(const std::vector<LineSegment>& edges, const std::vector<FoundLine>& lines) {
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](const LineSegment& edge) {
    return std::any_of(lines.begin(), lines.end(), [&](const FoundLine& line) {
      return Relate(edge, line.segment).overlap > 0.5 &&
             NormalErrorInPixels(edge, line.segment, 458) < 2.5;
    });
  }));
}

TEST(LineFinderTest, FindsTheLongEdgesAtFullAndHalfResolution) {
  const LineScene scene = BarScene(DistortedParameters());
  std::vector<LineSegment> edges = scene.Edges();
  edges.erase(std::remove_if(edges.begin(), edges.end(),
                             [](const LineSegment& edge) { return 458 * edge.Length() < 55; }),
              edges.end());
  for (const bool half : {false, true}) {
    LineTrackerConfig config;
    config.half_resolution = half;
    LineFinder finder(config, scene.camera());
    int fragments = 0;
    const auto lines = finder.Find(LineFlow::BuildPyramid(scene.View()), &fragments);
    EXPECT_GE(fragments, static_cast<int>(lines.size()));
    EXPECT_GE(CountFound(edges, lines), 0.9 * static_cast<double>(edges.size()));
    for (size_t i = 0; i < lines.size(); ++i) {
      EXPECT_GE(lines[i].segment_px.Length(), 0.08 * 480);
      if (i == 0) continue;
      EXPECT_LE(lines[i].segment_px.Length(), lines[i - 1].segment_px.Length());
    }
  }
}

// Detectors split a line that the lens bends; without distortion it is joined again.
TEST(LineFinderTest, JoinsABentLine) {
  LineScene scene(DistortedParameters(), 60);
  scene.AddBar({30, 5}, {720, 5}, 60, 200);
  int fragments = 0;
  const auto lines = LineFinder(LineTrackerConfig(), scene.camera())
                         .Find(LineFlow::BuildPyramid(scene.View()), &fragments);
  EXPECT_GT(fragments, static_cast<int>(lines.size()));
  EXPECT_GT(lines.front().segment_px.Length(), 350);
}

}  // namespace
}  // namespace plm_vins
