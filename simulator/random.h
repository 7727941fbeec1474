// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

namespace plm_vins::simulator {

// Seeded random numbers that do not depend on the standard library: the results of the
// distributions in <random> are implementation-defined, so they are implemented here. The `stream`s
// of a seed are independent of each other. A call draws at most one of its arguments, since
// compilers evaluate arguments in different orders.
class Random {
 public:
  explicit Random(uint64_t seed, uint64_t stream = 0) : engine_(Mix(seed ^ Mix(stream + 1))) {}

  // Uniform in [low, high).
  double Uniform(double low = 0.0, double high = 1.0) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }

  // Uniform in 0 ... count - 1.
  int Index(int count) { return static_cast<int>(Uniform(0.0, count)); }

  // Standard normal by Box-Muller, which generates two numbers at a time.
  double Normal() {
    if (spare_normal_) {
      const double spare = *spare_normal_;
      spare_normal_.reset();
      return spare;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    const double angle = 2.0 * M_PI * Uniform();
    spare_normal_ = radius * std::sin(angle);
    return radius * std::cos(angle);
  }

  // Each coordinate is uniform in +-limit.
  Eigen::Vector3d UniformInBox(const Eigen::Vector3d& limit) {
    const double x = Uniform(-1, 1), y = Uniform(-1, 1), z = Uniform(-1, 1);
    return limit.cwiseProduct(Eigen::Vector3d(x, y, z));
  }

  Eigen::Vector3d NormalVector3() {
    const double x = Normal(), y = Normal(), z = Normal();
    return {x, y, z};
  }

 private:
  // The finalizer of SplitMix64, which decorrelates consecutive seeds.
  static uint64_t Mix(uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
  std::optional<double> spare_normal_;
};

}  // namespace plm_vins::simulator
