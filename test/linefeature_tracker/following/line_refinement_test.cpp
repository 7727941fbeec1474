// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/following/line_refinement.h"

#include <gtest/gtest.h>

#include "linefeature_tracker/detection/line_finder.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

constexpr double kRefinementFocal = 458;

LineSegment Moved(const LineSegment& segment, double start_px, double end_px) {
  return {segment.start + start_px / kRefinementFocal * segment.Normal(),
          segment.end + end_px / kRefinementFocal * segment.Normal()};
}

LineSegment Orient(const LineScene& scene, const cv::Mat& image, const LineSegment& guess) {
  const CameraModel& camera = *scene.camera();
  return *UnprojectSegment(camera, OrientByBrightness(image, *ProjectSegment(camera, guess)));
}

// Largest error over all sufficiently long edges, from guesses that are off by up to 2.5 px.
double LargestErrorInPixels(const LineScene& scene, const cv::Mat& image, int* refined_count) {
  const LineRefinement refinement(LineTrackerConfig(), scene.camera());
  double largest = 0;
  int edges = 0;
  for (const LineSegment& edge : scene.Edges()) {
    if (kRefinementFocal * edge.Length() < 55) continue;
    const LineSegment guess = Moved(edge, ++edges % 2 == 0 ? 2.5 : -1.5, 1.0);
    const auto refined = refinement.Refine(image, Orient(scene, image, guess), 4);
    if (!refined) continue;
    ++*refined_count;
    largest = std::max(largest, NormalErrorInPixels(edge, *refined, kRefinementFocal));
  }
  return largest;
}

TEST(LineRefinementTest, FindsEdgesToTenthsOfAPixel) {
  const LineScene scene = BarScene(PlainParameters());
  int refined = 0;
  EXPECT_LT(LargestErrorInPixels(scene, scene.View(), &refined), 0.15);
  EXPECT_EQ(refined, 48);
}

// Distortion compresses the corners of the image, so errors there are larger in normalized
// coordinates.
TEST(LineRefinementTest, DistortionCostsLittle) {
  const LineScene scene = BarScene(DistortedParameters());
  int refined = 0;
  EXPECT_LT(LargestErrorInPixels(scene, scene.View(), &refined), 0.3);
  EXPECT_EQ(refined, 48);
}

TEST(LineRefinementTest, NoiseCostsLittle) {
  const LineScene scene = BarScene(PlainParameters());
  int refined = 0;
  EXPECT_LT(LargestErrorInPixels(scene, scene.View(Eigen::Matrix3d::Identity(), 4), &refined), 0.3);
  EXPECT_GE(refined, 44);
}

// A line across a strongly distorted image, bent by more than the search range.
TEST(LineRefinementTest, FollowsTheBendOfALongLine) {
  LineScene scene(DistortedParameters(), 60);
  scene.AddBar({20, 60}, {730, 40}, 40, 200);
  const LineRefinement refinement(LineTrackerConfig(), scene.camera());
  const cv::Mat image = scene.View();
  const LineSegment edge = scene.Edges()[0];
  const auto refined = refinement.Refine(image, Orient(scene, image, Moved(edge, 2, -2)), 4);
  ASSERT_TRUE(refined);
  EXPECT_LT(NormalErrorInPixels(edge, *refined, kRefinementFocal), 0.15);
  EXPECT_GT(refined->Length(), 0.9 * edge.Length());
}

class SingleBarTest : public testing::Test {
 protected:
  LineSegment Upper() const {  // the brighter side is below, where y is larger
    return {scene_.ToNormalised({200, 180}), scene_.ToNormalised({500, 180})};
  }

  LineScene scene_ = [] {
    LineScene scene(PlainParameters(), 60);
    scene.AddBar({200, 200}, {500, 200}, 40, 200);
    return scene;
  }();
  cv::Mat image_ = scene_.View();
  LineRefinement refinement_{LineTrackerConfig(), scene_.camera()};
};

TEST_F(SingleBarTest, OrientsByTheBrighterSide) {
  const LineSegment upper = Upper();
  for (const LineSegment& guess : {upper, upper.Reversed()}) {
    const LineSegment oriented = Orient(scene_, image_, guess);
    EXPECT_GT(oriented.Distance(scene_.ToNormalised({350, 200})), 0);
  }
}

TEST_F(SingleBarTest, RejectsAnEdgeOfTheOtherSign) {
  EXPECT_TRUE(refinement_.Refine(image_, Upper(), 4));
  EXPECT_FALSE(refinement_.Refine(image_, Upper().Reversed(), 4));
}

TEST_F(SingleBarTest, RejectsWhereThereIsNoEdge) {
  EXPECT_FALSE(refinement_.Refine(image_, Moved(Upper(), 10, 10), 4));
  EXPECT_FALSE(refinement_.Refine(cv::Mat::zeros(480, 752, CV_8UC1), Upper(), 4));
}

TEST_F(SingleBarTest, TrimsEndsThatReachTooFar) {
  const LineSegment guess{scene_.ToNormalised({170, 180}), scene_.ToNormalised({520, 180})};
  const auto refined = refinement_.Refine(image_, guess, 4);
  ASSERT_TRUE(refined);
  EXPECT_NEAR(kRefinementFocal * refined->start.x() + 375.5, 200, 12);
  EXPECT_NEAR(kRefinementFocal * refined->end.x() + 375.5, 500, 12);
}

TEST_F(SingleBarTest, GrowsToTheEndsOfTheEdge) {
  LineSegment line{scene_.ToNormalised({300, 180}), scene_.ToNormalised({400, 180})};
  for (int i = 0; i < 12; ++i) {
    const auto refined = refinement_.Refine(image_, line, 2);
    ASSERT_TRUE(refined);
    line = *refined;
  }
  EXPECT_NEAR(kRefinementFocal * line.start.x() + 375.5, 200, 8);
  EXPECT_NEAR(kRefinementFocal * line.end.x() + 375.5, 500, 8);
}

TEST_F(SingleBarTest, KeepsDistanceFromTheBorder) {
  LineScene scene(PlainParameters(), 60);
  scene.AddBar({-100, 200}, {900, 200}, 40, 200);
  LineSegment line{scene.ToNormalised({10, 180}), scene.ToNormalised({740, 180})};
  for (int i = 0; i < 3; ++i) line = *refinement_.Refine(scene.View(), line, 2);
  EXPECT_GE(kRefinementFocal * line.start.x() + 375.5, kLineBorder_px);
  EXPECT_LE(kRefinementFocal * line.end.x() + 375.5, 751 - kLineBorder_px);
}

TEST_F(SingleBarTest, EndsWhereTheMaskBegins) {
  cv::Mat mask(image_.size(), CV_8UC1, cv::Scalar(255));
  mask.colRange(350, mask.cols).setTo(0);
  const LineRefinement masked(LineTrackerConfig(), scene_.camera(), mask);
  const auto refined = masked.Refine(image_, Upper(), 4);
  ASSERT_TRUE(refined);
  EXPECT_NEAR(kRefinementFocal * refined->start.x() + 375.5, 200, 12);
  EXPECT_NEAR(kRefinementFocal * refined->end.x() + 375.5, 344, 6);
  mask.setTo(0);
  EXPECT_FALSE(
      LineRefinement(LineTrackerConfig(), scene_.camera(), mask).Refine(image_, Upper(), 4));
}

TEST_F(SingleBarTest, RejectsShortLines) {
  const LineSegment guess{scene_.ToNormalised({180, 180}), scene_.ToNormalised({220, 180})};
  EXPECT_FALSE(refinement_.Refine(image_, guess, 2));  // about 30 px of it are an edge
}

}  // namespace
}  // namespace plm_vins
