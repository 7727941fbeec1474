// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/standstill_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/imu_simulator.h"
#include "simulator/random.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

constexpr double kFocal = 460;             // [px]
constexpr int64_t kSample_ns = 5'000'000;  // 200 Hz

// An artificial sensor: IMU readings and corner positions as functions of time.
class StandstillDetectorTest : public ::testing::Test {
 protected:
  // Returns the next image for the motion at time t [s].
  template <typename Gyro, typename Accel, typename Shift>
  FrameMeasurement Next(const Gyro& gyro, const Accel& accel, const Shift& shift_px) {
    FrameMeasurement frame;
    frame.t_ns = t_ns_ + frame_ns_;
    for (int64_t t = t_ns_; t <= frame.t_ns; t += kSample_ns) {
      const Vector3d gyro_noise = noise_.gyro_density / std::sqrt(0.005) * random_.NormalVector3();
      const Vector3d accel_noise =
          noise_.accel_density / std::sqrt(0.005) * random_.NormalVector3();
      frame.imu.push_back({t, bias_.gyro + gyro(ToSeconds(t)) + gyro_noise,
                           bias_.accel + Vector3d(0, 0, 9.81) + accel(ToSeconds(t)) + accel_noise});
    }
    t_ns_ = frame.t_ns;
    frame.points.t_ns = frame.t_ns;
    for (int id = 0; id < points_; ++id) {
      PointObservation point;
      point.id = first_id_ + id;
      const double t = ToSeconds(frame.t_ns);
      const Eigen::Vector2d from_middle = Eigen::Vector2d(10.0, 5.0) * (id - 0.5 * (points_ - 1));
      point.uv_px = (1 + zoom_ * t) * (Eigen::Rotation2Dd(turn_ * t) * from_middle) +
                    Eigen::Vector2d(shift_px(t), 0) +
                    0.1 * Eigen::Vector2d(random_.Normal(), random_.Normal());
      point.xy = point.uv_px / kFocal;
      frame.points.points.push_back(point);
    }
    return frame;
  }

  // Number of images classified as standstill among `count` in this motion.
  template <typename Gyro, typename Accel, typename Shift>
  int CountStill(int count, const Gyro& gyro, const Accel& accel, const Shift& shift_px) {
    int still = 0;
    for (int i = 0; i < count; ++i) still += detector_.Add(Next(gyro, accel, shift_px)).has_value();
    return still;
  }

  static Vector3d Nothing(double) { return Vector3d::Zero(); }
  static double NoShift(double) { return 0; }

  ImuNoise noise_;
  ImuBias bias_{{0.3, -0.2, 0.1}, {0.08, -0.03, 0.02}};
  StandstillDetector detector_{noise_};
  simulator::Random random_{3};
  int64_t t_ns_ = 0;
  int64_t frame_ns_ = 50'000'000;  // 20 Hz
  double zoom_ = 0, turn_ = 0;     // of the image [1/s], [rad/s]
  int points_ = 60;
  int first_id_ = 0;
};

TEST_F(StandstillDetectorTest, DetectsStandstillOnceTheWindowIsFull) {
  EXPECT_EQ(CountStill(10, Nothing, Nothing, NoShift), 0);
  EXPECT_EQ(CountStill(50, Nothing, Nothing, NoShift), 50);
}

TEST_F(StandstillDetectorTest, ReturnsWhenStandstillBegan) {
  CountStill(30, Nothing, Nothing, NoShift);
  const FrameMeasurement frame = Next(Nothing, Nothing, NoShift);
  const auto standstill = detector_.Add(frame);
  ASSERT_TRUE(standstill.has_value());
  EXPECT_EQ(standstill->since_ns, frame.t_ns - 10 * frame_ns_);
}

TEST_F(StandstillDetectorTest, DecidesOnEveryImageDownTo3Hz) {
  for (const int64_t frame_ns : {150'000'000, 200'000'000, 330'000'000}) {
    frame_ns_ = frame_ns;
    detector_.Reset();
    CountStill(4, Nothing, Nothing, NoShift);
    EXPECT_EQ(CountStill(30, Nothing, Nothing, NoShift), 30) << frame_ns;
  }
  detector_.Reset();
  frame_ns_ = 400'000'000;
  EXPECT_EQ(CountStill(30, Nothing, Nothing, NoShift), 0);
}

TEST_F(StandstillDetectorTest, AfterAPauseOfImagesItStartsOver) {
  CountStill(30, Nothing, Nothing, NoShift);
  frame_ns_ = 2'000'000'000;
  EXPECT_EQ(CountStill(1, Nothing, Nothing, NoShift), 0);
  frame_ns_ = 50'000'000;
  EXPECT_EQ(CountStill(9, Nothing, Nothing, NoShift), 0);
  EXPECT_EQ(CountStill(10, Nothing, Nothing, NoShift), 10);
}

TEST_F(StandstillDetectorTest, DetectsCommonMotionBelowTheCornerNoise) {
  const auto common_px = [this](double shift, double zoom, double turn) {
    zoom_ = zoom, turn_ = turn;
    detector_.Reset();
    CountStill(20, Nothing, Nothing, [shift](double t) { return shift * t; });
    return detector_.Add(Next(Nothing, Nothing, [shift](double t) { return shift * t; }))
        .value()
        .common_px;
  };
  EXPECT_LT(common_px(0, 0, 0), 0.08);
  EXPECT_NEAR(common_px(0.6, 0, 0), 0.3, 0.08);
  EXPECT_NEAR(common_px(-0.6, 0, 0), 0.3, 0.08);
  // The median corner is 168 px from the center.
  EXPECT_NEAR(common_px(0, 0.003, 0), 0.25, 0.08);
  EXPECT_NEAR(common_px(0, 0, -0.003), 0.25, 0.08);
}

TEST_F(StandstillDetectorTest, ToleratesPropellerVibrationOnTheGround) {
  const auto gyro = [](double t) { return Vector3d(0.05 * std::sin(2 * M_PI * 80 * t), 0, 0); };
  const auto accel = [](double t) { return Vector3d(0, 0, 1.0 * std::sin(2 * M_PI * 80 * t)); };
  EXPECT_EQ(CountStill(60, gyro, accel, NoShift), 50);
}

TEST_F(StandstillDetectorTest, HoverIsNotStandstillEvenIfTheImageIsStill) {
  const auto gyro = [](double t) { return Vector3d(0.1 * std::sin(2 * M_PI * 1.5 * t), 0, 0); };
  EXPECT_EQ(CountStill(200, gyro, Nothing, NoShift), 0);
  const auto accel = [](double t) { return Vector3d(0.5 * std::sin(2 * M_PI * 1.5 * t), 0, 0); };
  EXPECT_EQ(CountStill(200, Nothing, accel, NoShift), 0);
}

TEST_F(StandstillDetectorTest, SteadyMotionIsNotStandstillEvenIfTheImuIsQuiet) {
  // 5 cm/s at 5 m distance and 460 px focal length.
  const auto shift = [](double t) { return 460 * 0.05 * t / 5.0; };
  EXPECT_EQ(CountStill(200, Nothing, Nothing, shift), 0);
}

TEST_F(StandstillDetectorTest, DetectsTakeOffWithinTwoImages) {
  EXPECT_GT(CountStill(40, Nothing, Nothing, NoShift), 0);
  const double start = ToSeconds(t_ns_);
  const auto accel = [](double) { return Vector3d(0, 0, 2.0); };
  const auto shift = [start](double t) { return 460 * (t - start) * (t - start) / 3.0; };
  CountStill(1, Nothing, accel, shift);
  EXPECT_EQ(CountStill(40, Nothing, accel, shift), 0);
}

TEST_F(StandstillDetectorTest, DoesNotDecideWithoutFeaturesFromTheStart) {
  points_ = 5;
  EXPECT_EQ(CountStill(30, Nothing, Nothing, NoShift), 0);
  points_ = 60;
  EXPECT_GT(CountStill(30, Nothing, Nothing, NoShift), 0);
}

TEST_F(StandstillDetectorTest, AStandstillOutlastsBlindImagesAndLostTracks) {
  CountStill(40, Nothing, Nothing, NoShift);
  points_ = 0;
  EXPECT_EQ(CountStill(1, Nothing, Nothing, NoShift), 1);
  EXPECT_EQ(CountStill(400, Nothing, Nothing, NoShift), 400);
  points_ = 60;
  first_id_ = 1000;
  EXPECT_EQ(CountStill(60, Nothing, Nothing, NoShift), 60);
}

// Both are below what counts as quiet in half a second.
TEST_F(StandstillDetectorTest, DetectsASlowStartWithoutFeatures) {
  const auto accel = [](double) { return Vector3d(0.1, 0, 0); };
  const auto gyro = [](double) { return Vector3d(0, 0, 0.01); };
  CountStill(100, Nothing, Nothing, NoShift);
  points_ = 0;
  EXPECT_LE(CountStill(60, Nothing, accel, NoShift), 30);
  EXPECT_EQ(CountStill(60, Nothing, accel, NoShift), 0);
  detector_.Reset();
  points_ = 60;
  CountStill(100, Nothing, Nothing, NoShift);
  points_ = 0;
  EXPECT_LE(CountStill(60, gyro, Nothing, NoShift), 30);
  EXPECT_EQ(CountStill(60, gyro, Nothing, NoShift), 0);
}

// A train sets out: 20 px in the first half second.
TEST_F(StandstillDetectorTest, FastMovingSceneDoesNotEndStandstill) {
  CountStill(60, Nothing, Nothing, NoShift);
  const double begin = ToSeconds(t_ns_);
  const auto shift = [begin](double t) { return 80 * (t - begin) * (t - begin); };
  CountStill(10, Nothing, Nothing, shift);
  for (int i = 0; i < 100; ++i) {
    const auto standstill = detector_.Add(Next(Nothing, Nothing, shift), /*depth=*/4);
    ASSERT_TRUE(standstill);
    EXPECT_TRUE(standstill->scene_moves);
  }
  const double end = shift(ToSeconds(t_ns_));
  CountStill(10, Nothing, Nothing, [end](double) { return end; });
  const auto standstill = detector_.Add(Next(Nothing, Nothing, [end](double) { return end; }));
  ASSERT_TRUE(standstill);
  EXPECT_FALSE(standstill->scene_moves);
}

// A motion too slow for the IMU, or a scene that moves slowly: the camera is doubted for as long as
// the IMU shows its noise alone, and for two seconds if it vibrates as in a hover.
TEST_F(StandstillDetectorTest, SlowMotionOfAnUnknownSceneNeedsConfirmation) {
  for (const bool vibrates : {false, true}) {
    detector_.Reset();
    points_ = 60;
    CountStill(60, Nothing, Nothing, NoShift);
    const double begin = ToSeconds(t_ns_);
    const auto shift = [begin](double t) { return 10 * (t - begin); };
    const auto accel = [vibrates](double t) {
      return Vector3d(vibrates ? 0.15 * std::sin(20 * M_PI * t) : 0, 0, 0);
    };
    int doubts = 0, unfelt = 0;
    for (int i = 0; i < 60; ++i) {
      EXPECT_FALSE(detector_.Add(Next(Nothing, accel, shift)) && i > 10) << i;
      doubts += detector_.doubts_camera() ? 1 : 0;
      unfelt += detector_.sees_unfelt_motion() ? 1 : 0;
    }
    EXPECT_GT(doubts, vibrates ? 25 : 50);
    EXPECT_LE(doubts, vibrates ? 41 : 60);
    EXPECT_GE(doubts, unfelt);
    EXPECT_EQ(unfelt > 50, !vibrates) << unfelt;
    points_ = 0;
    EXPECT_EQ(CountStill(20, Nothing, accel, shift), 0) << "it has seen a motion";
  }
}

TEST_F(StandstillDetectorTest, SlowTakeOffNearTheGroundIsNotSceneMotion) {
  CountStill(60, Nothing, Nothing, NoShift);
  const double begin = ToSeconds(t_ns_);
  const auto accel = [](double) { return Vector3d(0.15, 0, 0); };
  const auto shift = [begin](double t) { return kFocal / 0.1 * 0.15 / 2 * std::pow(t - begin, 2); };
  for (int i = 0; i < 40; ++i) {
    const auto standstill = detector_.Add(Next(Nothing, accel, shift), /*depth=*/0.1);
    EXPECT_FALSE(standstill && standstill->scene_moves) << i;
  }
}

TEST_F(StandstillDetectorTest, DoesNotReturnToStandstillWithoutFeatures) {
  CountStill(40, Nothing, Nothing, NoShift);
  points_ = 0;
  CountStill(
      4, Nothing, [](double) { return Vector3d(0, 0, 2.0); }, NoShift);
  CountStill(10, Nothing, Nothing, NoShift);
  EXPECT_EQ(CountStill(40, Nothing, Nothing, NoShift), 0);
}

TEST_F(StandstillDetectorTest, WithoutImuOrAfterResetItStartsOver) {
  EXPECT_GT(CountStill(30, Nothing, Nothing, NoShift), 0);
  FrameMeasurement blind = Next(Nothing, Nothing, NoShift);
  blind.imu.clear();
  EXPECT_FALSE(detector_.Add(blind).has_value());
  EXPECT_EQ(CountStill(10, Nothing, Nothing, NoShift), 0);
  EXPECT_EQ(CountStill(5, Nothing, Nothing, NoShift), 5);
  detector_.Reset();
  EXPECT_EQ(CountStill(10, Nothing, Nothing, NoShift), 0);
}

// The IMU of simulated flights with constant images: the worst case for the IMU part.
TEST_F(StandstillDetectorTest, SimulatedFlightIsNeverStill) {
  simulator::TrajectoryOptions options;
  options.motion = simulator::Motion::kFast;
  options.duration = 30.0;
  options.rest = 0.0;
  const auto imu = simulator::SimulateImu(simulator::Trajectory(options), {}).samples;
  int still = 0;
  for (size_t i = 200; i + 10 < imu.size(); i += 10) {
    FrameMeasurement frame = Next(Nothing, Nothing, NoShift);
    frame.imu.assign(imu.begin() + static_cast<std::ptrdiff_t>(i),
                     imu.begin() + static_cast<std::ptrdiff_t>(i) + 11);
    still += detector_.Add(frame).has_value();
  }
  EXPECT_EQ(still, 0);
}

}  // namespace
}  // namespace plm_vins
