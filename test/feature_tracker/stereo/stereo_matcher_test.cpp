// SPDX-License-Identifier: BSD-3-Clause
#include "feature_tracker/stereo/stereo_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/tracking/stereo/stereo_scene.h"

namespace plm_vins {
namespace {

constexpr double kDegree = M_PI / 180;

class StereoMatcherTest : public testing::Test {
 protected:
  // Tracks on a grid, aligned with what `left_` shows there.
  std::vector<PointTrack> Tracks() const {
    std::vector<PointTrack> tracks;
    for (int y = 30; y < 220; y += 20) {
      for (int x = 60; x < 350; x += 20) {
        PointTrack track;
        track.id = static_cast<int64_t>(tracks.size());
        track.uv_px = cv::Point2f(static_cast<float>(x) + 0.3F, static_cast<float>(y) - 0.2F);
        track.xy = *pair_.first().Unproject({track.uv_px.x, track.uv_px.y});
        const auto patch = CornerPatch::Cut(left_, {track.uv_px.x, track.uv_px.y});
        if (!patch) continue;
        track.patch = std::make_shared<const CornerPatch>(*patch);
        tracks.push_back(track);
      }
    }
    return tracks;
  }

  std::vector<PointTrack> Match(const cv::Mat& right, StereoMatcher* matcher) const {
    std::vector<PointTrack> tracks = Tracks();
    matcher->Match(left_, right, &tracks);
    return tracks;
  }

  static double ShareOfFound(const std::vector<PointTrack>& tracks) {
    const auto count = std::count_if(tracks.begin(), tracks.end(), [](const PointTrack& track) {
      return track.second.has_value();
    });
    return static_cast<double>(count) / static_cast<double>(tracks.size());
  }

  // Share of the tracks whose match is less than this far from the truth by these extrinsics.
  double ShareOfTrue(const std::vector<PointTrack>& tracks, const Rigid3d& truth,
                     double limit_px) const {
    int good = 0;
    for (const PointTrack& track : tracks) {
      const auto expected = pair_.With(truth).Transfer(track.xy, scene_.InverseDepth(track.xy));
      good += track.second && (track.second->xy - *expected).norm() * 228 < limit_px;
    }
    return static_cast<double>(good) / static_cast<double>(tracks.size());
  }

  CameraPair pair_ = StereoCameras();
  StereoScene scene_;
  cv::Mat left_ = scene_.View(pair_.first());
  cv::Mat right_ = scene_.View(pair_.second(), StereoExtrinsics());
};

TEST_F(StereoMatcherTest, FindsPointsOfAPlaneToATenthOfAPixel) {
  StereoMatcher matcher(pair_);
  const std::vector<PointTrack> tracks = Match(right_, &matcher);
  EXPECT_GT(ShareOfFound(tracks), 0.9);
  EXPECT_GT(ShareOfTrue(tracks, StereoExtrinsics(), 0.1), 0.85);
  EXPECT_GE(ShareOfTrue(tracks, StereoExtrinsics(), 0.5), ShareOfFound(tracks) - 1e-9);
}

TEST_F(StereoMatcherTest, FindsThemInTheNextPair) {
  StereoMatcher matcher(pair_);
  std::vector<PointTrack> tracks = Match(right_, &matcher);
  for (int i = 0; i < 3; ++i) matcher.Match(left_, right_, &tracks);
  EXPECT_GT(ShareOfTrue(tracks, StereoExtrinsics(), 0.1), 0.85);
}

// The first two images only show that it is turned.
TEST_F(StereoMatcherTest, LearnsTheActualExtrinsics) {
  const Rigid3d truth = {
      SO3Exp(Eigen::Vector3d(0.3, 0.2, -0.3) * kDegree) * StereoExtrinsics().rotation,
      StereoExtrinsics().translation};
  StereoMatcher matcher(pair_);
  const cv::Mat right = scene_.View(pair_.second(), truth);
  std::vector<PointTrack> tracks = Match(right, &matcher);
  EXPECT_EQ(ShareOfFound(tracks), 0);
  for (int i = 0; i < 2; ++i) matcher.Match(left_, right, &tracks);
  EXPECT_GT(ShareOfTrue(tracks, truth, 0.15), 0.8);
  EXPECT_NEAR(matcher.extrinsics().rotation().x(), 0.3 * kDegree, 0.03 * kDegree);
  EXPECT_NE(matcher.Finding().find("turned by"), std::string::npos) << matcher.Finding();
}

TEST_F(StereoMatcherTest, DoesNotUsePointsOfAWrongFocalLength) {
  CameraParameters wrong = pair_.second().parameters();
  wrong.fx *= 1.03;
  wrong.fy *= 1.03;
  StereoMatcher matcher(CameraPair(CameraModel::Create(pair_.first().parameters()),
                                   CameraModel::Create(wrong), StereoExtrinsics(), {0, 1}));
  std::vector<PointTrack> tracks = Match(right_, &matcher);
  for (int i = 0; i < 9; ++i) matcher.Match(left_, right_, &tracks);
  EXPECT_EQ(ShareOfFound(tracks), 0);
  EXPECT_EQ(matcher.Finding().rfind("the focal length of camera 1 is wrong by +3.", 0), 0u)
      << matcher.Finding();
}

TEST_F(StereoMatcherTest, DoesNotMatchAnotherScene) {
  StereoMatcher matcher(pair_);
  const cv::Mat other = StereoScene({0, 0, 0.5}, 9).View(pair_.second(), StereoExtrinsics());
  EXPECT_LT(ShareOfFound(Match(other, &matcher)), 0.03);
}

TEST_F(StereoMatcherTest, DoesNotMatchCamerasThatAreSwapped) {
  StereoMatcher matcher(pair_);
  std::swap(left_, right_);
  const std::vector<PointTrack> tracks = Match(right_, &matcher);
  EXPECT_LT(ShareOfFound(tracks), 0.03);
  EXPECT_NE(matcher.Finding().find("swapped"), std::string::npos) << matcher.Finding();
}

TEST_F(StereoMatcherTest, SearchesAtOnceForTracksThatBeganInSkippedImages) {
  StereoMatcher matcher(pair_);
  std::vector<PointTrack> tracks = Tracks();
  matcher.Match(left_, cv::Mat(), &tracks);
  for (PointTrack& track : tracks) ++track.length;
  matcher.Match(left_, right_, &tracks);
  EXPECT_GT(ShareOfFound(tracks), 0.9);
}

TEST_F(StereoMatcherTest, FindsNothingWithoutAnImage) {
  StereoMatcher matcher(pair_);
  std::vector<PointTrack> tracks = Match(right_, &matcher);
  matcher.Match(left_, cv::Mat(), &tracks);
  EXPECT_EQ(ShareOfFound(tracks), 0);
}

TEST_F(StereoMatcherTest, ChecksTheImage) {
  const StereoMatcher matcher(pair_);
  EXPECT_NO_THROW(matcher.CheckImage(right_));
  EXPECT_THROW(matcher.CheckImage(cv::Mat(10, 10, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace plm_vins
