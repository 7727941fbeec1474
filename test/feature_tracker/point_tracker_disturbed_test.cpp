// SPDX-License-Identifier: BSD-3-Clause
// The point tracker where images show something other than the scene.
#include <gtest/gtest.h>

#include "common/geometry/so3.h"
#include "test/feature_tracker/tracked_points.h"

namespace plm_vins {
namespace {

// Blank views: black, and a white wall with noise.
cv::Mat BlankView(bool noisy, uint64_t seed) {
  cv::Mat blank(kHeight, kWidth, CV_8U, cv::Scalar(noisy ? 200 : 0));
  if (!noisy) return blank;
  cv::Mat noise(blank.size(), CV_16S);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, 2);
  cv::add(blank, noise, blank, {}, CV_8U);
  return blank;
}

TEST_F(PointTrackerTest, TracksContinueAfterBlankImages) {
  for (const bool noisy : {false, true}) {
    for (const int blanks : {1, 3, 20}) {
      Configure(TestConfig());
      PointFrame last;
      for (int i = 0; i < 5; ++i) last = Track(scene_.View(Translation(0.5 * i, 0)));
      for (int i = 0; i < blanks; ++i) Track(BlankView(noisy, i + 1));
      const PointFrame frame = Track(scene_.View(Translation(2 + 0.5 * (blanks + 1), 0)));
      const auto errors = TrackErrors(last, frame, Translation(0.5 * (blanks + 1), 0));
      ASSERT_GT(errors.size(), 0.8 * last.points.size()) << noisy << ' ' << blanks;
      EXPECT_LT(errors[errors.size() / 2], 0.1) << noisy << ' ' << blanks;
    }
  }
}

TEST_F(PointTrackerTest, ARhythmOfBlankImagesEndsNoTrack) {
  const PointFrame first = Track(scene_.View());
  PointFrame frame;
  for (int i = 1; i <= 20; ++i) {
    const bool blank = i % 2 == 1;
    frame = Track(blank ? BlankView(false, i) : scene_.View(Translation(0.5 * i, 0.3 * i)));
  }
  EXPECT_GT(TrackErrors(first, frame, Translation(10, 6)).size(), 0.7 * first.points.size());
}

// Tracks from before a scene are not found in another one.
TEST_F(PointTrackerTest, NothingContinuesInAnotherScene) {
  const PointFrame last = Track(scene_.View());
  const TexturedScene other(7);
  PointFrame frame;
  for (int i = 0; i < 5; ++i) frame = Track(other.View(Translation(i, 0)));
  EXPECT_LT(TrackErrors(last, frame, Translation(0, 0)).size(), 16U);
  EXPECT_GT(frame.points.size(), 60U);
}

// Dots at random places of the image, as of an infrared projector.
cv::Mat Dots(int count) {
  cv::RNG random(3);
  cv::Mat dots(kHeight, kWidth, CV_8U, cv::Scalar(0));
  for (int i = 0; i < count; ++i) {
    const cv::Point dot(random.uniform(5, kWidth - 5), random.uniform(5, kHeight - 5));
    cv::circle(dots, dot, 1, cv::Scalar(140), cv::FILLED);
  }
  return dots;
}

class TurningCamera : public PointTrackerTest {
 protected:
  // Tracks a camera that turns by `rate` per image and back from each `swing` images on, with the
  // gyroscope of one that turns by `felt`.
  PointFrame Turn(int images, double rate, double felt, const cv::Mat& dots, int swing = 12) {
    PointFrame frame;
    int angle = 0;
    for (int i = 0; i < images; ++i) {
      const int step = i == 0 ? 0 : (i - 1) / swing % 2 == 0 ? 1 : -1;
      angle += step;
      const Eigen::Quaterniond R_now_start(SO3Exp({0, rate * angle, 0}));
      cv::Mat image;
      cv::addWeighted(scene_.View(RotationHomography(R_now_start)), 0.5, dots, 1, 0, image);
      cv::Mat noise(image.size(), CV_16S);
      cv::RNG(i + 1).fill(noise, cv::RNG::NORMAL, 0, 1);
      cv::add(image, noise, image, {}, CV_8U);
      frame = Track(image, Eigen::Quaterniond(SO3Exp({0, felt * step, 0})));
    }
    return frame;
  }
};

TEST_F(TurningCamera, DotsThatStandStillAreNotTracked) {
  for (const int count : {300, 600}) {
    Configure(TestConfig());
    const cv::Mat dots = Dots(count);
    const PointFrame frame = Turn(40, 0.006, 0.006, dots);
    cv::Mat near_dots;
    cv::dilate(dots, near_dots, cv::Mat::ones(3, 3, CV_8U));
    int on_dots = 0;
    for (const PointObservation& point : frame.points) {
      const bool still = point.velocity.norm() < 0.02;  // the scene moves by 0.12 per second
      on_dots += near_dots.at<uint8_t>(Pixel(point)) != 0 && still ? 1 : 0;
    }
    EXPECT_LT(on_dots, 5) << count << " of " << frame.points.size();
    EXPECT_GT(frame.points.size(), 30u) << count;
    EXPECT_EQ(tracker_->StillPartsFinding().rfind("corners stand still", 0), 0u) << count;
  }
}

// In a turn to one side, near points stand still where flying past cancels it.
TEST_F(TurningCamera, NothingIsMaskedInTurnsToOneSide) {
  Turn(60, 0.006, 0.006, Dots(300), 60);
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

// A biased gyroscope turns to the other side at standstill, when all stands still.
TEST_F(TurningCamera, AStandstillIsNoTurnToTheOtherSide) {
  const cv::Mat dots = Dots(300);
  Turn(30, 0, 0.006, dots, 30);
  Turn(30, -0.006, -0.006, dots, 30);
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

TEST_F(TurningCamera, DotsThatAreKnownAreNotTrackedFromTheFirstImageOn) {
  const cv::Mat dots = Dots(600);
  Turn(80, 0.006, 0.006, dots);
  EXPECT_TRUE(tracker_->HasLearned());
  const std::unique_ptr<PointTracker> earlier = std::move(tracker_);
  Configure(TestConfig());
  tracker_->LearnFrom(*earlier);
  EXPECT_NE(tracker_->StillPartsFinding(), "");
  cv::Mat near_dots;
  cv::dilate(dots, near_dots, cv::Mat::ones(3, 3, CV_8U));
  int on_dots = 0;
  const PointFrame frame = Turn(1, 0, 0, dots);
  for (const PointObservation& point : frame.points) {
    on_dots += near_dots.at<uint8_t>(Pixel(point)) != 0 ? 1 : 0;
  }
  EXPECT_LT(on_dots, 0.06 * frame.points.size());
  EXPECT_FALSE(tracker_->HasLearned());
}

// The projector is switched off, or the lens wiped.
TEST_F(TurningCamera, DotsThatVanishAreNoFindingAnyMore) {
  Turn(40, 0.006, 0.006, Dots(300));
  EXPECT_NE(tracker_->StillPartsFinding(), "");
  Turn(40, 0.006, 0.006, cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(0)));
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

TEST_F(TurningCamera, NothingStandsStillInACleanImage) {
  const cv::Mat none(kHeight, kWidth, CV_8U, cv::Scalar(0));
  EXPECT_GT(Turn(60, 0.006, 0.006, none).points.size(), 60u);
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

// A biased gyroscope feels a rotation at standstill.
TEST_F(TurningCamera, NothingIsMaskedAtStandstill) {
  EXPECT_GT(Turn(60, 0, 0.006, Dots(300)).points.size(), 60u);
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

// When it takes off, the scene moves by less than the biased gyroscope feels. Coarse texture then
// looks equal, fine texture does not.
TEST_F(TurningCamera, NothingIsMaskedAtTakeOff) {
  for (int i = 0; i < 30; ++i) {
    cv::Mat image = scene_.View(RotationHomography(Eigen::Quaterniond(SO3Exp({0, 0.001 * i, 0}))));
    cv::Mat coarse = image(cv::Rect(0, 0, kWidth * 2 / 3, kHeight));
    cv::GaussianBlur(coarse, coarse, {}, 3);
    coarse.convertTo(coarse, -1, 2.5, -190);  // contrast for corners
    Track(image, Eigen::Quaterniond(SO3Exp({0, 0.004, 0})));
  }
  EXPECT_EQ(tracker_->StillPartsFinding(), "");
}

}  // namespace
}  // namespace plm_vins
