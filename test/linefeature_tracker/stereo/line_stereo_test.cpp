// SPDX-License-Identifier: BSD-3-Clause
#include "linefeature_tracker/stereo/line_stereo.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/geometry/so3.h"
#include "linefeature_tracker/line_tracker.h"
#include "test/linefeature_tracker/bar_scene.h"

namespace plm_vins {
namespace {

const Rigid3d kExtrinsics(SO3Exp({0.005, -0.01, 0.01}), Eigen::Vector3d(-0.11, 0.002, 0.001));

class LineStereoTest : public testing::Test {
 protected:
  // How points of the plane n . p = 1 move from the first image to the second.
  static Eigen::Matrix3d Homography(const Rigid3d& T_S_C) {
    const Eigen::Vector3d normal(0.1, 0.05, 0.6);
    return T_S_C.R() + T_S_C.translation * normal.transpose();
  }

  LineFrame Match(const cv::Mat& right) {
    LineTracker tracker(LineTrackerConfig(), scene_.camera(), {}, pair_);
    return tracker.Track({kFrame_ns, scene_.View()}, {}, {right, {}});
  }

  // Returns the observation of a line in the second camera, or null.
  static const LineObservation* SecondOf(const LineObservation& line, const LineFrame& frame) {
    for (const LineObservation& second : frame.lines) {
      if (second.camera == 1 && second.id == line.id) return &second;
    }
    return nullptr;
  }

  // Distance of the end that is farther from where the line is really seen, in its deviations.
  static double Error(const LineObservation& line, const LineObservation& second) {
    const Eigen::Matrix3d H = Homography(kExtrinsics);
    const LineSegment truth{(H * line.start.homogeneous()).hnormalized(),
                            (H * line.end.homogeneous()).hnormalized()};
    const Eigen::Vector2d errors(truth.Distance(second.start), truth.Distance(second.end));
    return errors.cwiseAbs().cwiseQuotient(second.deviation).maxCoeff();
  }

  static int CountMatched(const LineFrame& frame) {
    return static_cast<int>(
        std::count_if(frame.lines.begin(), frame.lines.end(),
                      [](const LineObservation& line) { return line.camera == 1; }));
  }

  static double Slope(const LineObservation& line) {
    const Eigen::Vector2d direction = (line.end - line.start).normalized();
    return std::abs(direction.y());  // the epipolar curves are almost horizontal
  }

  LineScene scene_ = BarScene(DistortedParameters());
  CameraPair pair_{scene_.camera(), scene_.camera(), kExtrinsics};
};

TEST_F(LineStereoTest, FindsSteepLinesWhereTheyAre) {
  const LineFrame frame = Match(scene_.View(Homography(kExtrinsics)));
  int steep = 0;
  for (const LineObservation& line : frame.lines) {
    if (line.camera == 1) continue;
    steep += Slope(line) > 0.5;
    const LineObservation* second = SecondOf(line, frame);
    if (second != nullptr) {
      EXPECT_LT(Error(line, *second), 2) << line.id;
    }
  }
  ASSERT_GT(steep, 10);
  EXPECT_GT(CountMatched(frame), 0.6 * steep);
}

TEST_F(LineStereoTest, DoesNotMatchLinesAlongTheEpipolarCurves) {
  const LineFrame frame = Match(scene_.View(Homography(kExtrinsics)));
  for (const LineObservation& line : frame.lines) {
    if (line.camera == 0 && Slope(line) < 0.15) {
      EXPECT_EQ(SecondOf(line, frame), nullptr) << line.id;
    }
  }
}

TEST_F(LineStereoTest, FlatterLinesHaveLargerDeviations) {
  const LineFrame frame = Match(scene_.View(Homography(kExtrinsics)));
  double steepest = 0, flattest = 1, steepest_deviation = 0, flattest_deviation = 0;
  for (const LineObservation& line : frame.lines) {
    const LineObservation* second = line.camera == 0 ? SecondOf(line, frame) : nullptr;
    if (second == nullptr) continue;
    if (Slope(line) > steepest) {
      steepest = Slope(line);
      steepest_deviation = second->deviation[0];
    }
    if (Slope(line) < flattest) {
      flattest = Slope(line);
      flattest_deviation = second->deviation[0];
    }
  }
  ASSERT_LT(flattest, steepest);
  EXPECT_LT(steepest_deviation, flattest_deviation);
}

TEST_F(LineStereoTest, FindsThemInTheNextPair) {
  LineTracker tracker(LineTrackerConfig(), scene_.camera(), {}, pair_);
  LineFrame frame;
  const cv::Mat left = scene_.View(), right = scene_.View(Homography(kExtrinsics));
  int first = 0;
  for (int i = 1; i <= 4; ++i) {
    frame = tracker.Track({i * kFrame_ns, left}, {}, {right, {}});
    if (i == 1) first = CountMatched(frame);
  }
  EXPECT_GE(CountMatched(frame), first);
  for (const LineObservation& line : frame.lines) {
    const LineObservation* second = line.camera == 0 ? SecondOf(line, frame) : nullptr;
    if (second != nullptr) {
      EXPECT_LT(Error(line, *second), 2) << line.id;
    }
  }
}

TEST_F(LineStereoTest, FindsNothingWithoutAnImageOrInAnotherScene) {
  EXPECT_EQ(CountMatched(Match(cv::Mat())), 0);
  const cv::Mat blank(480, 752, CV_8UC1, cv::Scalar(90));
  EXPECT_EQ(CountMatched(Match(blank)), 0);
  cv::Mat turned;
  cv::flip(scene_.View(), turned, -1);
  const LineFrame frame = Match(turned);  // edges of bars are similar: some match by chance
  EXPECT_LT(CountMatched(frame),
            0.2 * static_cast<double>(frame.lines.size() - CountMatched(frame)));
}

TEST_F(LineStereoTest, ChecksTheImage) {
  EXPECT_THROW(Match(cv::Mat(10, 10, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace plm_vins
