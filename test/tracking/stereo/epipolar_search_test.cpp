// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stereo/epipolar_search.h"

#include <gtest/gtest.h>

#include <utility>

#include "test/tracking/stereo/stereo_scene.h"

namespace plm_vins {
namespace {

class EpipolarSearchTest : public testing::Test {
 protected:
  SearchedPoint Point(double x, double y) const {
    const Eigen::Vector2d xy(x, y);
    return {*pair_.first().Project(xy.homogeneous()), xy};
  }

  std::optional<CurvePoint> Search(const SearchedPoint& point, const SearchRange& range) const {
    return SearchAlongCurve(pair_, left_, point, right_, range);
  }

  CameraPair pair_ = StereoCameras();
  StereoScene scene_;
  cv::Mat left_ = scene_.View(pair_.first());
  cv::Mat right_ = scene_.View(pair_.second(), StereoExtrinsics());
};

TEST_F(EpipolarSearchTest, FindsPointsOfAPlane) {
  for (const double x : {-0.3, 0.0, 0.25, 0.5}) {
    for (const double y : {-0.3, 0.0, 0.3}) {
      const SearchedPoint point = Point(x, y);
      const auto place = Search(point, {0, 3, 0});
      ASSERT_TRUE(place) << x << " " << y;
      const double truth = scene_.InverseDepth(point.xy);
      EXPECT_LT((place->pixel - *pair_.Project(point.xy, truth)).norm(), 0.3) << x << " " << y;
      EXPECT_NEAR(place->inverse_depth, truth, 2 * pair_.InverseDepthPerPixel());
    }
  }
}

TEST_F(EpipolarSearchTest, FindsNothingOutsideTheRange) {
  const SearchedPoint point = Point(0.1, 0.1);
  const double truth = scene_.InverseDepth(point.xy);
  EXPECT_TRUE(Search(point, {truth - 0.1, truth + 0.1, 0}));
  EXPECT_FALSE(Search(point, {truth + 0.3, truth + 2, 0}));
}

TEST_F(EpipolarSearchTest, FindsNothingInAnotherScene) {
  right_ = StereoScene({0, 0, 0.5}, 7).View(pair_.second(), StereoExtrinsics());
  EXPECT_FALSE(Search(Point(0, 0), {0, 3, 0}));
  EXPECT_FALSE(Search(Point(0.2, 0.1), {0, 3, 0}));
}

TEST_F(EpipolarSearchTest, BandAllowsForTurnedExtrinsics) {
  const SearchedPoint point = Point(0.1, 0.1);
  const auto truth = pair_.Project(point.xy, scene_.InverseDepth(point.xy));
  const Rigid3d stated = StereoExtrinsics();
  const std::pair<double, double> cases[] = {{0.015, 4.5}, {0.002, 0.46}};  // 3.4 px and 0.46 px
  for (const auto& [turn, band_px] : cases) {
    const Rigid3d turned = {SO3Exp({turn, 0, 0}) * stated.rotation, stated.translation};
    const auto found = SearchAlongCurve(pair_.With(turned), left_, point, right_, {0, 3, band_px});
    ASSERT_TRUE(found) << turn;
    EXPECT_LT((found->pixel - *truth).norm(), 0.3) << turn;
  }
}

TEST_F(EpipolarSearchTest, RejectsRepetitivePatterns) {
  for (cv::Mat* image : {&left_, &right_}) {
    for (int column = 0; column < image->cols; ++column) {
      image->col(column) = cv::Scalar(128 + 100 * std::sin(2 * M_PI * column / 12.0));
    }
  }
  EXPECT_FALSE(Search(Point(0.1, 0.1), {0, 3, 0}));
}

// Two bars that differ by less than the noise of an image.
TEST_F(EpipolarSearchTest, RejectsASecondBarThatIsAlmostTheSame) {
  const auto draw = [](int column, int gray, cv::Mat* image) {
    image->col(column) = cv::Scalar(gray);
    image->col(column + 1) = cv::Scalar(200);
    image->col(column + 2) = cv::Scalar(150);
  };
  const SearchedPoint point = Point(0.1, 0.1);
  const auto place = pair_.Project(point.xy, 1.0);
  const int left = cvRound(point.pixel.x()), right = cvRound(place->x());
  left_.setTo(100);
  right_.setTo(100);
  draw(left, 150, &left_);
  draw(right, 150, &right_);
  ASSERT_TRUE(Search(point, {0, 3, 0}));
  draw(right + 12, 134, &right_);
  EXPECT_FALSE(Search(point, {0, 3, 0}));
}

}  // namespace
}  // namespace plm_vins
