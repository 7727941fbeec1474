// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/point_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "common/features/feature_checks.h"
#include "common/geometry/so3.h"
#include "test/feature_tracker/tracked_points.h"

namespace plm_vins {
namespace {

TEST_F(PointTrackerTest, FirstImageGivesNewPoints) {
  const PointFrame frame = Track(scene_.View());
  EXPECT_EQ(frame.t_ns, t_ns_);
  EXPECT_EQ(frame.points.size(), 80U);
  for (const PointObservation& point : frame.points) {
    EXPECT_EQ(point.velocity, Eigen::Vector2d::Zero());
    const auto xy = camera_->Unproject(point.uv_px);
    ASSERT_TRUE(xy);
    EXPECT_LT((point.xy - *xy).norm(), 1e-12);
  }
  EXPECT_EQ(tracker_->statistics().detected, 80);
}

TEST_F(PointTrackerTest, FollowsAHomographyToSubpixels) {
  const cv::Matx33d step(1.004, 0.01, 2.2, -0.012, 1.006, -1.4, 1e-5, -2e-5, 1);
  cv::Matx33d H = cv::Matx33d::eye();
  PointFrame before = Track(scene_.View());
  for (int i = 0; i < 5; ++i) {
    H = step * H;
    const PointFrame after = Track(scene_.View(H));
    const auto errors = TrackErrors(before, after, step);
    ASSERT_GT(errors.size(), 60U);
    EXPECT_LT(errors[errors.size() / 2], 0.1);
    before = after;
  }
}

TEST_F(PointTrackerTest, HardlyDriftsUnderTranslation) {
  const PointFrame first = Track(scene_.View());
  PointFrame last;
  for (int i = 1; i <= 20; ++i) last = Track(scene_.View(Translation(2.3 * i, -0.7 * i)));
  const auto errors = TrackErrors(first, last, Translation(46, -14));
  ASSERT_GT(errors.size(), 40U);
  EXPECT_LT(errors[errors.size() / 2], 0.1);
}

// Flow alone drifts by up to 1 px, since it confuses a part of the deformation with translation.
TEST_F(PointTrackerTest, HardlyDriftsWhileTheImageTurnsAndGrows) {
  const cv::Matx33d step(1.004, 0.01, -1.2, -0.01, 1.004, 1.4, 0, 0, 1);
  cv::Matx33d H = cv::Matx33d::eye();
  const PointFrame first = Track(scene_.View());
  PointFrame last;
  for (int i = 1; i <= 40; ++i) {
    H = step * H;
    last = Track(scene_.View(H));
  }
  const auto errors = TrackErrors(first, last, H);
  ASSERT_GT(errors.size(), 30U);
  EXPECT_LT(errors[errors.size() / 2], 0.05);
}

TEST_F(PointTrackerTest, VelocityIsTheMotionOfNormalizedPoints) {
  const PointFrame first = Track(scene_.View());
  const PointFrame second = Track(scene_.View(Translation(3, -2)));
  const auto before = ById(first);
  int tracked = 0;
  for (const PointObservation& point : second.points) {
    const auto it = before.find(point.id);
    if (it == before.end()) continue;
    ++tracked;
    const Eigen::Vector2d expected = (point.xy - it->second.xy) / ToSeconds(kFrame_ns);
    EXPECT_LT((point.velocity - expected).norm(), 1e-9);
    EXPECT_NEAR(point.velocity.x(), 3 / kFocal / ToSeconds(kFrame_ns), 0.05);
  }
  EXPECT_GT(tracked, 60);
}

TEST_F(PointTrackerTest, NeverReusesIds) {
  std::set<int64_t> ids, previous;
  for (int i = 0; i < 12; ++i) {
    const PointFrame frame = Track(scene_.View(Translation(12 * i, 0)));
    std::set<int64_t> current;
    for (const PointObservation& point : frame.points) {
      EXPECT_TRUE(current.insert(point.id).second);
      const bool is_known = ids.count(point.id) > 0;
      EXPECT_EQ(is_known, previous.count(point.id) > 0) << "a lost point came back";
    }
    ids.insert(current.begin(), current.end());
    previous = current;
    if (i == 6) {
      tracker_->Reset();
      previous.clear();
    }
  }
  EXPECT_GT(ids.size(), 120U);
}

TEST_F(PointTrackerTest, KeepsTheMinimumDistance) {
  for (int i = 0; i < 8; ++i) {  // the scene shrinks: points come closer
    const double scale = 1 - 0.04 * i;
    const cv::Matx33d H(scale, 0, (1 - scale) * 188, 0, scale, (1 - scale) * 120, 0, 0, 1);
    const PointFrame frame = Track(scene_.View(H));
    for (const PointObservation& a : frame.points) {
      for (const PointObservation& b : frame.points) {
        if (a.id >= b.id) continue;
        EXPECT_GE((a.uv_px - b.uv_px).norm(), TestConfig().min_dist - 1e-4);
      }
    }
  }
}

TEST_F(PointTrackerTest, RotationPredictsLargeTurns) {
  const Eigen::Quaterniond R = SO3Exp({0.02, 0.4, 0});  // 23 degrees, about 100 px
  const cv::Matx33d H = RotationHomography(R);
  const auto tracked_well = [&](const std::optional<Eigen::Quaterniond>& prediction) {
    tracker_->Reset();
    const PointFrame first = Track(scene_.View());
    const auto errors = TrackErrors(first, Track(scene_.View(H), prediction), H);
    return std::count_if(errors.begin(), errors.end(), [](double error) { return error < 0.3; });
  };
  EXPECT_GT(tracked_well(R), 25);
  EXPECT_LT(tracked_well(std::nullopt), 10);
}

TEST_F(PointTrackerTest, OwnMotionPredictsConstantMotion) {
  PointFrame before, last;
  cv::Matx33d H;
  for (int i = 0; i <= 12; ++i) {  // accelerates to 36 px per image, gently at each step
    H = Translation(-0.5 * 3 * i * (i - 1) + 150, 0);
    before = last;
    last = Track(scene_.View(H));
  }
  const auto errors = TrackErrors(before, last, Translation(-33, 0));
  ASSERT_GT(errors.size(), 40U);
  EXPECT_LT(errors[errors.size() / 2], 0.1);
}

TEST_F(PointTrackerTest, PureRotationAndStandstillKeepPoints) {
  const Eigen::Quaterniond R = SO3Exp({0.01, -0.015, 0.02});
  for (const bool has_gyro : {true, false}) {
    tracker_->Reset();
    Track(scene_.View());
    Track(scene_.View(RotationHomography(R)),
          has_gyro ? std::optional<Eigen::Quaterniond>(R) : std::nullopt);
    EXPECT_LE(tracker_->statistics().epipolar_outliers, 1);
    EXPECT_LE(tracker_->statistics().flow_lost + tracker_->statistics().forward_backward, 12);
    Track(scene_.View(RotationHomography(R)));
    EXPECT_EQ(tracker_->statistics().epipolar_outliers, 0);
    EXPECT_LE(tracker_->statistics().flow_lost + tracker_->statistics().forward_backward, 2);
  }
}

TEST_F(PointTrackerTest, CornersOfARepeatedImageAreBitExact) {
  const cv::Mat image = scene_.View();
  const auto before = ById(Track(image));
  const PointFrame frame = Track(image.clone(), SO3Exp(Eigen::Vector3d(0, 0.01, 0)));
  EXPECT_EQ(frame.points.size(), before.size());
  for (const PointObservation& point : frame.points) {
    EXPECT_EQ(point.uv_px, before.at(point.id).uv_px);
    EXPECT_EQ(point.velocity, Eigen::Vector2d::Zero());
  }
}

TEST_F(PointTrackerTest, RejectsAPatchThatMovesOnItsOwn) {
  // The background moves sideways, a patch also upwards, off its epipolar lines.
  const TexturedScene other(77);
  const cv::Rect patch0(150, 60, 110, 110);
  const cv::Point motion(2, -5);
  cv::Mat image0 = scene_.View();
  cv::Mat image1 = scene_.View(Translation(5, 0));
  const cv::Mat content = other.View()(patch0);
  content.copyTo(image0(patch0));
  content.copyTo(image1(patch0 + motion));

  const PointFrame first = Track(image0);
  const auto after = ById(Track(image1, Eigen::Quaterniond::Identity()));
  int on_patch = 0, kept_on_patch = 0, on_background = 0, kept_on_background = 0;
  for (const PointObservation& point : first.points) {
    const bool kept = after.count(point.id) > 0;
    const cv::Point pixel(Pixel(point));
    const cv::Rect inner(patch0.x + 10, patch0.y + 10, 90, 90);
    const cv::Rect outer(patch0.x - 20, patch0.y - 20, 150, 150);
    if (inner.contains(pixel)) {
      ++on_patch;
      kept_on_patch += kept ? 1 : 0;
    } else if (!outer.contains(pixel)) {
      ++on_background;
      kept_on_background += kept ? 1 : 0;
    }
  }
  EXPECT_GT(on_patch, 3);
  EXPECT_EQ(kept_on_patch, 0);
  EXPECT_GT(kept_on_background, 0.85 * on_background);
}

TEST_F(PointTrackerTest, BlindImagesHaveNoPoints) {
  Track(scene_.View());
  for (const int gray : {0, 255, 0}) {
    EXPECT_TRUE(Track(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(gray))).points.empty());
  }
  EXPECT_EQ(Track(scene_.View()).points.size(), 80U);
}

TEST_F(PointTrackerTest, FindsNoCornersInDarkNoise) {
  cv::RNG random(3);
  for (int i = 0; i < 4; ++i) {
    cv::Mat noise(kHeight, kWidth, CV_8UC1);
    random.fill(noise, cv::RNG::NORMAL, 8, 1.8);
    EXPECT_LE(Track(noise).points.size(), 1U);
  }
}

TEST_F(PointTrackerTest, SurvivesASuddenChangeOfBrightness) {
  Track(scene_.View());
  cv::Mat bright;
  scene_.View().convertTo(bright, CV_8U, 0.5, 120);
  EXPECT_GE(Track(bright).points.size(), 72U);
}

TEST_F(PointTrackerTest, DetectsNewCornersOnceAFifthIsMissing) {
  Track(scene_.View());
  int searches = 0;
  for (int i = 1; i <= 20; ++i) {
    const PointFrame frame = Track(scene_.View(Translation(4 * i, 0)));
    EXPECT_GE(frame.points.size(), 64U);
    const PointTrackerStatistics& statistics = tracker_->statistics();
    if (statistics.detected == 0) continue;
    ++searches;
    EXPECT_LT(frame.points.size() - statistics.detected, 64U);
  }
  EXPECT_GT(searches, 0);
  EXPECT_LT(searches, 10);
}

TEST_F(PointTrackerTest, RejectsWrongImagesWithoutChange) {
  const cv::Mat view = scene_.View();
  const PointFrame first = Track(view);
  cv::Mat color;
  cv::cvtColor(view, color, cv::COLOR_GRAY2BGR);
  EXPECT_THROW(Track(color), std::invalid_argument);
  EXPECT_THROW(Track(view.rowRange(0, kHeight - 1)), std::invalid_argument);
  EXPECT_THROW(Track(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(tracker_->Track({first.t_ns, view}, std::nullopt), std::invalid_argument);
  EXPECT_THROW(tracker_->Track({first.t_ns - 1, view}, std::nullopt), std::invalid_argument);
  const PointFrame second = Track(view);
  EXPECT_GT(TrackErrors(first, second, cv::Matx33d::eye()).size(), 75U);
}

TEST_F(PointTrackerTest, ResetAllowsEarlierStamps) {
  Track(scene_.View());
  tracker_->Reset();
  EXPECT_EQ(tracker_->Track({1, scene_.View()}, std::nullopt).points.size(), 80U);
}

TEST_F(PointTrackerTest, DrawsTracksInColor) {
  EXPECT_TRUE(tracker_->DrawTracks().empty());
  const PointFrame frame = Track(scene_.View());
  const cv::Mat drawing = tracker_->DrawTracks();
  ASSERT_EQ(drawing.type(), CV_8UC3);
  ASSERT_EQ(drawing.size(), cv::Size(kWidth, kHeight));
  const auto color = drawing.at<cv::Vec3b>(cv::Point(Pixel(frame.points.front())));
  EXPECT_GT(color[0], color[2]);  // new: blue
}

TEST_F(PointTrackerTest, KeepsPointsWhereTheMaskAllowsThem) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  mask.colRange(0, kWidth / 2).setTo(255);
  tracker_ = std::make_unique<PointTracker>(TestConfig(), camera_, mask);
  for (int i = 0; i < 5; ++i) {  // points move out of the allowed half
    const PointFrame frame = Track(scene_.View(Translation(10 * i, 0)));
    EXPECT_GT(frame.points.size(), 20U);
    for (const PointObservation& point : frame.points) EXPECT_LT(point.uv_px.x(), kWidth / 2);
  }
}

TEST(PointTracker, IsDeterministicWhateverTheNumberOfThreads) {
  const TexturedScene scene;
  const auto run = [&](int threads) {
    cv::setNumThreads(threads);
    PointTracker tracker(TestConfig(), TestCamera());
    std::vector<double> numbers;
    for (int i = 0; i < 8; ++i) {
      const cv::Mat view = scene.View(Translation(7 * i, -3 * i));
      const PointFrame frame = tracker.Track({i * kFrame_ns, view}, std::nullopt);
      for (const PointObservation& p : frame.points) {
        numbers.insert(numbers.end(), {static_cast<double>(p.id), p.xy.x(), p.xy.y(), p.uv_px.x(),
                                       p.uv_px.y(), p.velocity.x(), p.velocity.y()});
      }
    }
    return numbers;
  };
  const auto numbers = run(1);
  EXPECT_EQ(numbers, run(1));
  EXPECT_EQ(numbers, run(4));
}

// Column 271 of this fisheye is perpendicular to the optical axis, so its rays have no image in z =
// 1.
TEST(PointTracker, IgnoresRaysPerpendicularToTheOpticalAxis) {
  CameraParameters parameters = TestCameraParameters();
  parameters.model = CameraParameters::Model::kPinholeEquidistant;
  parameters.fx = parameters.fy = 1000;
  parameters.cx = -1300;
  PointTracker tracker(TestConfig(), CameraModel::Create(parameters));
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  cv::RNG(3).fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {5, 5}, 1.5);
  for (int i = 1; i <= 3; ++i) {
    const PointFrame frame = tracker.Track({i * kFrame_ns, image}, std::nullopt);
    EXPECT_EQ(frame.points.size(), 80u);
    for (const PointObservation& point : frame.points) EXPECT_TRUE(IsPossible(point)) << point.xy;
  }
}

// Half of this image is beyond the fold of the distortion.
TEST(PointTracker, PixelsWithoutRaysUseNoCorners) {
  CameraParameters parameters = TestCameraParameters();
  parameters.distortion[0] = -0.5;
  PointTracker tracker(TestConfig(), CameraModel::Create(parameters));
  const TexturedScene scene;
  for (int i = 1; i <= 6; ++i) {
    const cv::Mat view = scene.View(Translation(6 * i, 0));
    EXPECT_GE(tracker.Track({i * kFrame_ns, view}, std::nullopt).points.size(), 64u);
  }
}

}  // namespace
}  // namespace plm_vins
