// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/stamp_jitter.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "simulator/imu_simulator.h"
#include "simulator/trajectory.h"
#include "test/testing/numeric_jacobian.h"
#include "vins_estimator/factors/imu_factor.h"

namespace plm_vins {
namespace {

const Eigen::Vector3d kGravity_W(0, 0, -9.81);

// Jitter measured in two hundred images of a flight with timestamp errors of at most `jitter` [s].
// Other errors are random in all directions [rad], or a constant share of each rotation [s]. With
// `gaps`, every third interval is missing.
double Measure(double jitter, double noise, double rate = 0.5, double same = 0, bool gaps = false) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> error(-jitter, jitter);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(size * normal(random), size * normal(random), size * normal(random));
  };
  StampJitterMonitor monitor;
  double before = 0;
  for (int i = 0; i < 200; ++i) {
    const double now = error(random);
    const Eigen::Vector3d turn = vector(rate);
    if (gaps && i % 3 == 0) {
      monitor.Skip();
    } else {
      monitor.Add((now - before + same) * turn + vector(noise), turn);
    }
    before = now;
  }
  return monitor.deviation();
}

TEST(StampJitterMonitor, MeasuresTheJitter) {
  EXPECT_NEAR(Measure(0.005, 2e-4), 0.005 / std::sqrt(3), 7e-4);
}

TEST(StampJitterMonitor, ComparesNeighborsOnly) {
  EXPECT_NEAR(Measure(0.005, 2e-4, 0.5, 0, /*gaps=*/true), 0.005 / std::sqrt(3), 7e-4);
}

TEST(StampJitterMonitor, IgnoresOtherErrors) {
  EXPECT_EQ(Measure(0, 1e-4), 0);
  EXPECT_EQ(Measure(0, 2e-2), 0);
  EXPECT_EQ(Measure(0, 1e-4, 0.5, 0.005), 0);
}

TEST(StampJitterMonitor, IgnoresLittleJitterAndNeedsRotation) {
  EXPECT_EQ(Measure(0.0005, 1e-5), 0);
  EXPECT_EQ(Measure(0.005, 0, 0.01), 0);
}

simulator::Trajectory Flight() {
  simulator::TrajectoryOptions options;
  options.motion = simulator::Motion::kFast;
  options.duration = 6.0;
  return simulator::Trajectory(options);
}

Preintegration Integrate(const simulator::Trajectory& trajectory, double begin, double end) {
  simulator::ImuSimulationOptions options;
  options.add_noise = false;
  Preintegration motion({}, {});
  for (const ImuSample& sample : simulator::SimulateImu(trajectory, options).samples) {
    const double t = ToSeconds(sample.t_ns);
    if (t > begin - 1e-6 && t < end + 1e-6) motion.Append(sample);
  }
  return motion;
}

FrameState At(const simulator::Trajectory& trajectory, double t) {
  FrameState state;
  state.SetPose(trajectory.At(t).T_W_B);
  state.velocity() = trajectory.At(t).v_W;
  return state;
}

TEST(StampErrors, AreTheTimeDerivativeOfTheResidual) {
  const simulator::Trajectory trajectory = Flight();
  for (const double begin : {2.0, 3.1, 4.7}) {
    const double end = begin + 0.2, step = 1e-3;
    const Preintegration motion = Integrate(trajectory, begin, end);
    const auto residual = [&](double start_error, double end_error) {
      return ImuResidual(motion, kGravity_W, At(trajectory, begin + start_error),
                         At(trajectory, end + end_error), nullptr);
    };
    const Vector15d at_start = (residual(step, 0) - residual(-step, 0)) / (2 * step);
    const Vector15d at_end = (residual(0, step) - residual(0, -step)) / (2 * step);
    const StampErrors errors =
        StampErrorsOf(1.0, motion, kGravity_W, At(trajectory, begin), At(trajectory, end));
    EXPECT_MATRIX_NEAR(motion.jacobian() * errors.at_start, -at_start, 0.01);
    EXPECT_MATRIX_NEAR(errors.at_end, at_end, 0.01);
  }
}

}  // namespace
}  // namespace plm_vins
