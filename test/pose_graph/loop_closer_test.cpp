// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/loop_closer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "test/pose_graph/two_visits.h"

namespace plm_vins {
namespace {

constexpr double kDepth = 4;             // of the painted wall, along x [m]
constexpr double kPixelsPerMeter = 115;  // of the painting, as observed by the camera

// A camera that slides along a painted wall, looking at it. Its pixels are pixels of the painting,
// so images are simple crops.
class LoopCloserTest : public ::testing::Test {
 protected:
  LoopCloserTest() {
    cv::Mat small(130, 400, CV_8UC1);
    cv::RNG random(11);
    random.fill(small, cv::RNG::UNIFORM, 0, 256);
    cv::resize(small, painting_, cv::Size(3200, 1040), 0, 0, cv::INTER_CUBIC);
  }

  // The image at y [m] along the wall, with odometry that has drifted by T_O_W.
  OdometryFrame FrameAt(double y, double t, const LevelTransform& T_O_W) {
    const int left = 1600 - static_cast<int>(std::lround(y * kPixelsPerMeter)) - 376;
    OdometryFrame frame;
    frame.t_ns = ToNanoseconds(t);
    frame.covariance.diagonal().head<3>().setConstant(variance_rate_ * t);
    frame.T_B_C = {testing::LookingAhead()};
    frame.T_O_B = T_O_W.ToRigid() * Rigid3d(Eigen::Quaterniond::Identity(), {0, y, 0});
    frame.images[0].gray = painting_(cv::Rect(left, 280, 752, 480)).clone();
    const Rigid3d T_O_C = frame.T_O_B * frame.T_B_C[0];
    for (int u = 40; u < 720; u += 40) {
      for (int v = 40; v < 450; v += 40) {
        // One id for each place of the painting within a visit.
        TrackedCorner corner;
        const int place_u = (left + u) / 40 * 40;
        const int in_image_u = place_u - left;
        if (in_image_u < 30 || in_image_u > 720) continue;
        corner.observation.id = first_track_ + place_u * 10000 + v;
        corner.observation.uv_px = {in_image_u, v};
        corner.observation.xy = *camera_->Unproject(corner.observation.uv_px);
        corner.p_O = T_O_C * Eigen::Vector3d(kDepth * corner.observation.xy.homogeneous());
        frame.corners.push_back(corner);
      }
    }
    return frame;
  }

  // Adds a camera that looks back. With the body turned around, it sees what camera 0 saw before.
  static void AddCameraThatLooksBack(bool turned, OdometryFrame* frame) {
    const Rigid3d around(Eigen::Quaterniond(0, 0, 0, 1), {0, 0, 0});
    frame->T_B_C.push_back(around * frame->T_B_C[0]);
    frame->images[1].gray = cv::Mat(480, 752, CV_8UC1, cv::Scalar(100));
    if (!turned) return;
    frame->T_O_B = frame->T_O_B * around;
    std::swap(frame->images[0], frame->images[1]);
    for (TrackedCorner& corner : frame->corners) corner.observation.camera = 1;
  }

  struct Range {
    double from = -3;
    double to = 3;
  };

  // Slides along y from time `t` on; returns the last closure.
  LoopClosure Slide(LoopCloser* loops, double t, const LevelTransform& T_O_W,
                    bool restarted = false) {
    return Slide(loops, t, T_O_W, restarted, Range());
  }
  LoopClosure Slide(LoopCloser* loops, double t, const LevelTransform& T_O_W, bool restarted,
                    const Range& range) {
    first_track_ += 100'000'000;
    LoopClosure last;
    for (int i = 0; i <= std::lround((range.to - range.from) / 0.4); ++i) {
      OdometryFrame frame = FrameAt(range.from + 0.4 * i, t + 0.4 * i, T_O_W);
      frame.restarted = restarted && i == 0;
      if (looks_back_) AddCameraThatLooksBack(/*turned=*/t > 0, &frame);
      last = loops->Add(frame);
      for (const LoopCandidate& candidate : last.candidates) {
        if (!candidate.failed) ++accepted_;
      }
      confirmed_ += last.confirmed.size();
      reconsidered_ += last.reconsidered.size();
    }
    return last;
  }

  std::shared_ptr<const CameraModel> camera_ = testing::SimpleCamera();
  CameraModels cameras_ = {camera_};
  cv::Mat painting_;
  bool looks_back_ = false;
  int64_t first_track_ = 0;
  double variance_rate_ = 1e-4;  // of odometry's position estimate [m^2/s]
  int accepted_ = 0;
  size_t confirmed_ = 0;
  size_t reconsidered_ = 0;
};

const LevelTransform kDrift = {0.001, {0.05, -0.08, 0.03}};

TEST_F(LoopCloserTest, UndoesTheDriftOfASecondVisit) {
  LoopCloser loops(cameras_);
  const LoopClosure first = Slide(&loops, 0, LevelTransform());
  ASSERT_TRUE(first.fix);
  EXPECT_EQ(first.fix->T_M_O.ToVector(), Vector4d::Zero());
  EXPECT_EQ(accepted_, 0);
  EXPECT_FALSE(first.place);

  const LoopClosure second = Slide(&loops, 60, kDrift);
  EXPECT_GT(accepted_, 3);
  ASSERT_TRUE(second.place);
  EXPECT_LT(loops.map().keyframes[second.place->earlier].t_ns, ToNanoseconds(60.0));
  EXPECT_FALSE(second.place->observations.of_earlier.empty());
  ASSERT_TRUE(second.fix);
  const LevelTransform rest = loops.map().T_M_O(0).Inverse() * second.fix->T_M_O * kDrift;
  EXPECT_LT(rest.translation.norm(), 0.05);
  EXPECT_NEAR(rest.yaw, 0, 0.01);
  // The loops are more certain than odometry, whose covariance increases.
  EXPECT_LT(second.fix->covariance(0, 0), 0.5 * second.fix->odometry_covariance(0, 0));
}

TEST_F(LoopCloserTest, RecognizesByAnotherCameraWhatTheFirstOneSaw) {
  looks_back_ = true;
  cameras_.push_back(camera_);
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  const LoopClosure second = Slide(&loops, 60, kDrift);
  EXPECT_GT(accepted_, 3);
  ASSERT_FALSE(second.candidates.empty());
  EXPECT_EQ(second.candidates.back().later_camera, 1);
  EXPECT_EQ(second.candidates.back().earlier_camera, 0);
  ASSERT_TRUE(second.fix);
  const LevelTransform rest = loops.map().T_M_O(0).Inverse() * second.fix->T_M_O * kDrift;
  EXPECT_LT(rest.translation.norm(), 0.05);
  EXPECT_NEAR(rest.yaw, 0, 0.01);
}

TEST_F(LoopCloserTest, RejectsAMapOfMoreCameras) {
  looks_back_ = true;
  LoopCloser of_two({camera_, camera_});
  Slide(&of_two, 0, LevelTransform());
  LoopCloser of_one(cameras_);
  EXPECT_THROW(of_one.SetMap(of_two.map()), std::runtime_error);
}

TEST_F(LoopCloserTest, RelocalizesAfterARestart) {
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  const LevelTransform T_O_W = {2.0, {7, 8, 9}};
  const LoopClosure found = Slide(&loops, 10, T_O_W, /*restarted=*/true);
  ASSERT_TRUE(found.fix);
  EXPECT_LT((found.fix->T_M_O * T_O_W).translation.norm(), 0.05);
  EXPECT_EQ(confirmed_, 1u);  // the first loop waited for the second
}

TEST_F(LoopCloserTest, StartsInAnEarlierMap) {
  LoopCloser before(cameras_);
  Slide(&before, 0, LevelTransform());
  LoopCloser loops(cameras_);
  loops.SetMap(before.map());
  const LevelTransform T_O_W = {-1.0, {2, 1, 0}};
  const LoopClosure found = Slide(&loops, 5, T_O_W);
  ASSERT_TRUE(found.fix);
  EXPECT_LT((found.fix->T_M_O * T_O_W).translation.norm(), 0.05);
}

TEST_F(LoopCloserTest, DoesNotMoveALoadedMap) {
  LoopCloser before(cameras_);
  Slide(&before, 0, LevelTransform());
  LoopCloser loops(cameras_);
  loops.SetMap(before.map());
  Slide(&loops, 10, LevelTransform());
  const LevelTransform drift = {0, {0.5, 0, 0}};
  constexpr int kSteps = 60;  // away and back, with dark images
  for (int i = 0; i <= kSteps; ++i) {
    const double y = 3 + 0.5 * std::min(i, kSteps - i);
    OdometryFrame frame = FrameAt(0, 20 + 0.4 * i, LevelTransform());
    frame.T_O_B.translation = Eigen::Vector3d(0, y, 0) + drift.translation * i / kSteps;
    frame.images[0].gray = cv::Scalar(100);
    frame.corners.clear();
    loops.Add(frame);
  }
  accepted_ = 0;
  const LoopClosure back = Slide(&loops, 60, drift);
  EXPECT_GT(accepted_, 3);
  EXPECT_LT((back.fix->T_M_O * drift).translation.norm(), 0.05);
  for (int i = 0; i < before.map().graph.size(); ++i) {
    const LevelTransform& was = before.map().graph.node(i);
    EXPECT_LT((loops.map().graph.node(i).translation - was.translation).norm(), 0.02) << i;
  }
}

// A world that is connected with the map meets one that is not.
TEST_F(LoopCloserTest, MovesAWorldToTheMap) {
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform(), false, {-9, -5});
  const int second = loops.map().graph.size();
  EXPECT_FALSE(Slide(&loops, 60, {2.0, {70, 80, 9}}, /*restarted=*/true, {5, 9}).fix);
  const LevelTransform T_O_W = {-1.0, {5, 6, 7}};
  const LoopClosure last = Slide(&loops, 120, T_O_W, /*restarted=*/true, {-9, 9});
  ASSERT_TRUE(last.fix);
  EXPECT_TRUE(loops.map().graph.AreConnected(0, second));
  EXPECT_LT((last.fix->T_M_O * T_O_W).translation.norm(), 0.05);
  EXPECT_LT((loops.map().graph.node(0).translation - Eigen::Vector3d(0, -9, 0)).norm(), 0.05);
  EXPECT_LT((loops.map().graph.node(second).translation - Eigen::Vector3d(0, 5, 0)).norm(), 0.05);
}

// Odometry after a blind stretch with dead reckoning has a large covariance.
TEST_F(LoopCloserTest, AcceptsALoopWithinTheDrift) {
  variance_rate_ = 0;
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  variance_rate_ = 16.0 / 60;  // 4 m by the second visit
  const LevelTransform drift = {0, {0, 4, 0}};
  const LoopClosure second = Slide(&loops, 60, drift);
  EXPECT_GT(accepted_, 3);
  const LevelTransform rest = loops.map().T_M_O(0).Inverse() * second.fix->T_M_O * drift;
  EXPECT_LT(rest.translation.norm(), 0.05);
}

TEST_F(LoopCloserTest, RejectsPerceptualAliasing) {
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  // Odometry reaches the same images by a path of 10 m.
  OdometryFrame on_the_way = FrameAt(0, 30, {0, {0, 5, 0}});
  on_the_way.images[0].gray = cv::Scalar(100);
  loops.Add(on_the_way);
  const LoopClosure twin = Slide(&loops, 60, {0, {0, 10, 0}});
  EXPECT_EQ(accepted_, 0);
  ASSERT_FALSE(twin.candidates.empty());
  EXPECT_EQ(twin.candidates.front().failed, LoopGate::kOdometry);
  EXPECT_EQ(twin.fix->T_M_O.ToVector(), Vector4d::Zero());
}

// The wall was moved by more than the covariance of odometry, but by less than its possible drift.
TEST_F(LoopCloserTest, DropsALoopThatTheGraphContradicts) {
  const LevelTransform moved = {0, {0, 0.3, 0}};
  LoopCloser unsure(cameras_);
  Slide(&unsure, 0, LevelTransform());
  const LoopClosure accepted = Slide(&unsure, 60, moved);
  ASSERT_TRUE(accepted.place);
  EXPECT_FALSE(accepted.candidates.back().failed);

  variance_rate_ = 0;
  accepted_ = 0;
  LoopCloser sure(cameras_);
  Slide(&sure, 0, LevelTransform());
  const LoopClosure refused = Slide(&sure, 60, moved);
  EXPECT_EQ(accepted_, 0);
  ASSERT_TRUE(refused.place);  // it passed all other gates
  EXPECT_EQ(refused.place->earlier, accepted.place->earlier);
  const LoopCandidate& loop = refused.candidates.back();
  EXPECT_EQ(loop.failed, LoopGate::kGraph);
  EXPECT_LT(*loop.odometry_error, kThreeSigmaOf4Dof);
  EXPECT_GT(*loop.graph_error, kThreeSigmaOf4Dof);
  EXPECT_LT(refused.fix->T_M_O.ToVector().norm(), 1e-6);
}

// Odometry that has just started may have a wrong scale.
TEST_F(LoopCloserTest, DropsALoopThatAllLaterOnesContradict) {
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  variance_rate_ = 1e-7;
  const LevelTransform at_first = {0.016, {0.12, -0.1, 0.05}};
  Slide(&loops, 60, at_first, /*restarted=*/true, {-3, -2.2});
  EXPECT_GT(accepted_, 0);
  const size_t confirmed_before = confirmed_;
  Slide(&loops, 62, kDrift, /*restarted=*/false, {-1.8, 3});
  EXPECT_EQ(confirmed_, confirmed_before);
  EXPECT_GE(reconsidered_, 3u);
  const KeyframeMap& map = loops.map();
  const LevelTransform rest = map.T_M_O(0).Inverse() * map.T_M_O(map.graph.size() - 1) * kDrift;
  EXPECT_LT(rest.translation.norm(), 0.03);
  EXPECT_NEAR(rest.yaw, 0, 0.003);
}

// Odometry jumps after the first loop of the second visit. The next loop, which contradicts it, is
// less certain.
TEST_F(LoopCloserTest, DroppedLoopDoesNotLocateAWorld) {
  LoopCloser loops(cameras_);
  Slide(&loops, 0, LevelTransform());
  first_track_ += 100'000'000;
  LoopClosure closure;
  std::pair<int, int> first = {-1, -1};  // loop
  for (int i = 0; i <= 10 && closure.dropped.empty(); ++i) {
    const LevelTransform T_O_W = {0, {0, i < 4 ? 0.2 : 0, 0}};
    OdometryFrame frame = FrameAt(-3 + 0.4 * i, 60 + 0.4 * i, T_O_W);
    frame.covariance.diagonal().head<3>().setConstant(0.006);  // no drift in this visit
    closure = loops.Add(frame);
    if (first.second < 0 && closure.place)
      first = {closure.place->earlier, loops.map().graph.size() - 1};
  }
  ASSERT_EQ(closure.dropped.size(), 1u);
  EXPECT_EQ(std::make_pair(closure.dropped[0].from, closure.dropped[0].to), first);
  const std::vector<LevelEdge>& edges = loops.map().graph.edges();
  EXPECT_TRUE(std::any_of(edges.begin(), edges.end(), [&](const LevelEdge& edge) {
    const Keyframe& later = loops.map().keyframes[edge.to];
    return edge.is_loop && later.T_O_B.translation == closure.fix->T_O_L.translation;
  }));
}

TEST_F(LoopCloserTest, MapSizeIsBoundedOverManyVisits) {
  LoopCloser loops(cameras_);
  std::vector<int> sizes;
  for (int visit = 0; visit < 8; ++visit) {
    Slide(&loops, 60 * visit, kDrift);
    sizes.push_back(loops.map().CountKept());
  }
  EXPECT_GT(accepted_, 8);
  EXPECT_LT(sizes[1], sizes[2]);
  EXPECT_LE(sizes[7], sizes[5]);
  for (int i = 0; i < loops.map().graph.size(); ++i) {
    if (loops.map().graph.Has(i)) continue;
    EXPECT_EQ(loops.map().keyframes[i].corners.capacity(), 0u);
    EXPECT_EQ(loops.map().keyframes[i].segments.capacity(), 0u);
  }
}

}  // namespace
}  // namespace plm_vins
