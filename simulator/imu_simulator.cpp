// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/imu_simulator.h"

#include <algorithm>
#include <cmath>

#include "simulator/random.h"

namespace plm_vins::simulator {
namespace {

using Eigen::Vector3d;

ImuSample IdealSample(const BodyState& state, double gravity_norm) {
  ImuSample sample;
  sample.gyro = state.gyro_B;
  sample.accel = state.T_W_B.rotation.conjugate() * (state.a_W + Vector3d(0, 0, gravity_norm));
  return sample;
}

}  // namespace

const ImuBias& ImuSimulation::BiasAt(int64_t t_ns) const {
  const auto after = std::upper_bound(samples.begin(), samples.end(), t_ns,
                                      [](int64_t t, const ImuSample& s) { return t < s.t_ns; });
  return biases[std::max<std::ptrdiff_t>(after - samples.begin() - 1, 0)];
}

ImuSimulation SimulateImu(const Trajectory& trajectory, const ImuSimulationOptions& options) {
  Random random(options.seed);
  const double noise_scale = options.add_noise ? std::sqrt(options.rate_hz) : 0.0;
  const double walk_scale = options.add_noise ? std::sqrt(1.0 / options.rate_hz) : 0.0;
  const ImuNoise& noise = options.noise;

  ImuSimulation result;
  ImuBias bias = options.initial_bias;
  const int count =
      static_cast<int>(std::floor(trajectory.duration() * options.rate_hz + 1e-9)) + 1;
  for (int i = 0; i < count; ++i) {
    const double t = i / options.rate_hz;
    ImuSample sample = IdealSample(trajectory.At(t), options.gravity_norm);
    sample.t_ns = options.start_ns + ToNanoseconds(t);
    sample.gyro += bias.gyro + noise_scale * noise.gyro_density * random.NormalVector3();
    sample.accel += bias.accel + noise_scale * noise.accel_density * random.NormalVector3();
    result.samples.push_back(Uncorrected(sample, options.sensor));
    result.biases.push_back(bias);
    bias.gyro += walk_scale * noise.gyro_walk * random.NormalVector3();
    bias.accel += walk_scale * noise.accel_walk * random.NormalVector3();
  }
  return result;
}

FrameState TrueState(int64_t t_ns, const BodyState& body, const ImuBias& bias) {
  FrameState state;
  state.t_ns = t_ns;
  state.SetPose(body.T_W_B);
  state.velocity() = body.v_W;
  state.SetBias(bias);
  return state;
}

}  // namespace plm_vins::simulator
