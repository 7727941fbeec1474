// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/imu/imu_propagator.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/imu/imu_samples.h"
#include "simulator/imu_simulator.h"
#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/imu/preintegration.h"

namespace plm_vins {
namespace {

using Eigen::Vector3d;

const Vector3d kPropagatorGravity_W(0, 0, -9.81);
constexpr int64_t kMillisecond = 1'000'000;

class ImuPropagatorTest : public ::testing::Test {
 protected:
  ImuPropagatorTest() {
    simulator::TrajectoryOptions options;
    options.motion = simulator::Motion::kFast;
    options.duration = 8.0;
    samples_ = simulator::SimulateImu(simulator::Trajectory(options), {}).samples;
    start_.SetPose({Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1, 2, 3}});
    start_.velocity() = Vector3d(0.5, -1, 0.2);
    start_.SetBias({{0.1, 0.05, -0.1}, {0.01, 0, -0.02}});
  }

  // Predicts by a single preintegration from time `t_ns` to the sample `last`.
  FrameState Predict(int64_t t_ns, size_t last) const {
    Preintegration preintegration(ImuNoise(), start_.bias());
    size_t i = 0;
    while (samples_[i + 1].t_ns <= t_ns) ++i;
    preintegration.Append(InterpolateImu(samples_[i], samples_[i + 1], t_ns));
    for (++i; i <= last; ++i) preintegration.Append(samples_[i]);
    return preintegration.Predict(start_, kPropagatorGravity_W);
  }

  static void ExpectSame(const std::optional<FrameState>& actual, const FrameState& expected) {
    ASSERT_TRUE(actual.has_value());
    EXPECT_MATRIX_NEAR(actual->position(), expected.position(), 1e-11);
    EXPECT_MATRIX_NEAR(actual->rotation().coeffs(), expected.rotation().coeffs(), 1e-11);
    EXPECT_MATRIX_NEAR(actual->velocity(), expected.velocity(), 1e-11);
    EXPECT_MATRIX_NEAR(actual->accel_bias(), expected.accel_bias(), 0.0);
  }

  std::vector<ImuSample> samples_;  // 200 Hz from 0
  FrameState start_;
  ImuPropagator propagator_{kPropagatorGravity_W};
};

// The twist of ~imu_propagate is that of ~odometry.
TEST_F(ImuPropagatorTest, AngularVelocityIsCorrectedAndWithoutBias) {
  ImuSensor sensor;
  sensor.gyro_correction << 0, -1.1, 0, 0.9, 0, 0, 0, 0, 1;
  ImuPropagator propagator(kPropagatorGravity_W, sensor);
  propagator.Reset(start_, 0);
  for (size_t i = 0; i < 10; ++i) {
    ASSERT_TRUE(propagator.Add(Uncorrected(samples_[i], sensor)));
    EXPECT_MATRIX_NEAR(propagator.AngularVelocity(), samples_[i].gyro - start_.gyro_bias(), 1e-12);
  }
}

TEST_F(ImuPropagatorTest, ReturnsNulloptWithoutAState) {
  EXPECT_FALSE(propagator_.Add(samples_[0]).has_value());
  EXPECT_FALSE(propagator_.Add(samples_[1]).has_value());
}

TEST_F(ImuPropagatorTest, EqualsThePreintegratedPrediction) {
  const int64_t t_ns = 502 * kMillisecond;  // between two samples
  for (size_t i = 0; i <= 100; ++i) propagator_.Add(samples_[i]);
  propagator_.Reset(start_, t_ns);
  for (size_t i = 101; i <= 300; ++i) {
    const auto state = propagator_.Add(samples_[i]);
    ExpectSame(state, Predict(t_ns, i));
    EXPECT_EQ(state->t_ns, samples_[i].t_ns);
  }
}

TEST_F(ImuPropagatorTest, LateStateIsPropagatedThroughNewerSamples) {
  const int64_t t_ns = 502 * kMillisecond;
  propagator_.Reset(FrameState(), 0);  // an earlier state
  for (size_t i = 0; i <= 150; ++i) propagator_.Add(samples_[i]);
  propagator_.Reset(start_, t_ns);
  ExpectSame(propagator_.Add(samples_[151]), Predict(t_ns, 151));
}

TEST_F(ImuPropagatorTest, ResetOnASampleStartsThere) {
  for (size_t i = 0; i <= 100; ++i) propagator_.Add(samples_[i]);
  propagator_.Reset(start_, samples_[100].t_ns);
  ExpectSame(propagator_.Add(samples_[101]), Predict(samples_[100].t_ns, 101));
}

TEST_F(ImuPropagatorTest, WaitsForSamplesAfterAStateThatIsAhead) {
  propagator_.Add(samples_[0]);
  propagator_.Reset(start_, samples_[2].t_ns);
  EXPECT_FALSE(propagator_.Add(samples_[1]).has_value());
  propagator_.Add(samples_[2]);
  ExpectSame(propagator_.Add(samples_[3]), Predict(samples_[2].t_ns, 3));
}

TEST_F(ImuPropagatorTest, StopsBeyondItsHorizonUntilTheNextState) {
  propagator_.Reset(start_, 0);
  size_t answered = 0;
  for (size_t i = 0; i < 1200; ++i) answered += propagator_.Add(samples_[i]).has_value();
  EXPECT_EQ(answered, 401u);  // 0 to 2 s at 200 Hz
  propagator_.Reset(start_, samples_[1190].t_ns);
  ExpectSame(propagator_.Add(samples_[1200]), Predict(samples_[1190].t_ns, 1200));
}

TEST_F(ImuPropagatorTest, ReturnsNulloptAfterClear) {
  propagator_.Add(samples_[0]);
  propagator_.Reset(start_, samples_[0].t_ns);
  propagator_.Clear();
  EXPECT_FALSE(propagator_.Add(samples_[1]).has_value());
}

TEST_F(ImuPropagatorTest, SpikeIsDelayedAndReplaced) {
  for (size_t i = 0; i <= 200; ++i) propagator_.Add(samples_[i]);
  propagator_.Reset(start_, samples_[100].t_ns);
  ImuSample spike = samples_[201];
  spike.accel.x() = 150;
  EXPECT_FALSE(propagator_.Add(spike));
  const auto state = propagator_.Add(samples_[202]);
  ASSERT_TRUE(state.has_value());
  EXPECT_EQ(state->t_ns, samples_[202].t_ns);
  EXPECT_MATRIX_NEAR(state->position(), Predict(samples_[100].t_ns, 202).position(), 1e-3);
}

}  // namespace
}  // namespace plm_vins
