// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/imu_agreement.h"

#include <gtest/gtest.h>

#include <memory>

#include "common/measurements.h"
#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

const ImuNoise kImuNoise = {1e-3, 1e-2, 1e-5, 1e-3};
constexpr double kInterval = 0.05;  // [s]
constexpr int kWindowFrames = 5;    // in the window; the third one is the keyframe
constexpr PointMap::Fit kFits = {100, 0};

// A window at standstill with exact readings.
class ImuAgreementTest : public ::testing::Test {
 protected:
  ImuAgreementTest() {
    window_.gravity_W = Eigen::Vector3d(0, 0, -9.81);
    for (int i = 0; i < kWindowFrames; ++i) Append();
  }

  void Append() {
    WindowFrame frame;
    const int64_t end_ns = window_.frames.empty() ? 0 : window_.newest().state.t_ns + Interval();
    frame.state.t_ns = end_ns;
    if (!window_.frames.empty()) {
      frame.motion_since_previous = std::make_shared<Preintegration>(kImuNoise, ImuBias());
      constexpr int kSamples = 10;
      for (int i = kSamples; i >= 0; --i) {
        frame.motion_since_previous->Append({end_ns - i * Interval() / kSamples,
                                             Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 0, 9.81)});
      }
    }
    window_.frames.push_back(frame);
  }

  static int64_t Interval() { return ToNanoseconds(kInterval); }

  int64_t Keyframe() const { return window_.frames[2].state.t_ns; }

  // Changes the end of an interval until it contradicts the IMU by this chi-square.
  void Contradict(size_t end, double chi_square) {
    FrameState& state = window_.frames[end].state;
    state.velocity().x() += 1e-3;
    state.velocity().x() *= std::sqrt(chi_square / ChiSquare(end));
  }

  double ChiSquare(size_t end) const {
    const WindowFrame& frame = window_.frames[end];
    return ImuChiSquare(*frame.motion_since_previous, window_.gravity_W,
                        window_.frames[end - 1].state, frame.state);
  }

  SlidingWindow window_;
  ImuAgreement agreement_;
};

TEST_F(ImuAgreementTest, TrustsAConsistentImu) {
  EXPECT_LT(ChiSquare(kWindowFrames - 1), 1e-6);
  EXPECT_TRUE(agreement_.IsUndoubted(window_, Keyframe()));
}

TEST_F(ImuAgreementTest, RaisesTheNoiseOfAnIntervalAfterTheKeyframe) {
  Contradict(kWindowFrames - 1, 3.9);
  ASSERT_NEAR(ChiSquare(kWindowFrames - 1), 3.9, 0.01);
  EXPECT_TRUE(agreement_.IsUndoubted(window_, Keyframe()));
  Contradict(kWindowFrames - 1, 4.1);
  EXPECT_FALSE(agreement_.IsUndoubted(window_, Keyframe()));
}

TEST_F(ImuAgreementTest, DoesNotCheckBeforeTheKeyframe) {
  window_.frames[0].state.velocity().x() += 1;
  ASSERT_GT(ChiSquare(1), 10);
  EXPECT_TRUE(agreement_.IsUndoubted(window_, Keyframe()));
  window_.frames[2].state.velocity().x() += 1;  // end of one interval and start of the next
  EXPECT_FALSE(agreement_.IsUndoubted(window_, Keyframe()));
}

TEST_F(ImuAgreementTest, ChecksAnImuWithRaisedNoise) {
  for (int i = 0; i < 40; ++i) {
    Append();
    Contradict(window_.frames.size() - 1, 20);
    agreement_.Add(window_, kFits);
    window_.newest().state.velocity().setZero();
  }
  EXPECT_GT(agreement_.noise_scale(), 1);
  EXPECT_FALSE(agreement_.IsUndoubted(window_, window_.second_newest().state.t_ns));
}

TEST_F(ImuAgreementTest, ContradictionRaisesTheNoiseAtOnce) {
  EXPECT_FALSE(agreement_.Add(window_, kFits));
  Append();
  Contradict(window_.frames.size() - 1, 60);
  EXPECT_TRUE(agreement_.Add(window_, kFits));
}

TEST_F(ImuAgreementTest, DoubtedIntervalIsNoisierAndAllowsBiasSteps) {
  Contradict(kWindowFrames - 1, 60);
  Preintegration& motion = *window_.newest().motion_since_previous;
  DoubtInterval(Scaled(kImuNoise, 30), &motion);
  EXPECT_TRUE(motion.HasBiasStep());
  EXPECT_LT(ChiSquare(kWindowFrames - 1), 60.0 / 30 + 0.1);
}

}  // namespace
}  // namespace plm_vins
