// SPDX-License-Identifier: BSD-3-Clause
// Parameter blocks, and a scene that they describe, for tests of factors.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"
#include "vins_estimator/geometry/plucker.h"

namespace plm_vins::testing {

inline Block ScalarBlock(double value) { return Block::Constant(1, value); }

inline Block PoseBlockOf(const Rigid3d& T) {
  Block block(kPoseSize);
  block << T.translation, T.rotation.coeffs();
  return block;
}

inline Block PointBlockOf(const Eigen::Vector3d& p_C) {
  return Eigen::Vector3d(p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1 / p_C.z());
}

inline Block LineBlockOf(const PluckerLine& line) {
  const OrthonormalLine coordinates = ToOrthonormal(line);
  return Eigen::Map<const Eigen::Matrix<double, kLineSize, 1>>(coordinates.data());
}

// A stereo camera on a body at two poses, of host and target, and two points that both see, which
// are the ends of a line.
struct FactorScene {
  explicit FactorScene(uint64_t seed) {
    simulator::Random random(seed);
    const auto rotation = [&random](double scale) {
      return SO3Exp(scale * random.NormalVector3());
    };
    const auto point = [&random]() {
      const double x = random.Normal(), y = random.Normal();
      return Eigen::Vector3d(x, y, random.Uniform(3, 8));
    };
    T_W_Bh = {rotation(1.0), random.NormalVector3()};
    T_W_Bt = T_W_Bh * Rigid3d(rotation(0.1), 0.3 * random.NormalVector3());
    T_B_C = {rotation(0.3), 0.1 * random.NormalVector3()};
    T_C_C1 = {rotation(0.05), Eigen::Vector3d(0.2, 0, 0) + 0.05 * random.NormalVector3()};
    p_Ch = point();
    q_Ch = point();
  }

  Eigen::Vector3d InTarget(const Eigen::Vector3d& p) const {
    return (T_W_Bt * T_B_C).Inverse() * (T_W_Bh * (T_B_C * p));
  }
  Eigen::Vector2d SeenInTarget(const Eigen::Vector3d& p) const { return InTarget(p).hnormalized(); }
  Eigen::Vector2d SeenInRight(const Eigen::Vector3d& p_C) const {
    return (T_C_C1.Inverse() * p_C).hnormalized();
  }

  // Blocks of the poses: host, target, extrinsics.
  std::vector<Block> Poses() const {
    return {PoseBlockOf(T_W_Bh), PoseBlockOf(T_W_Bt), PoseBlockOf(T_B_C)};
  }
  Block Mounting() const { return PoseBlockOf(T_C_C1); }
  Block Point() const { return PointBlockOf(p_Ch); }
  Block Line() const { return LineBlockOf(LineThrough(p_Ch, q_Ch)); }

  Rigid3d T_W_Bh, T_W_Bt, T_B_C, T_C_C1;
  Eigen::Vector3d p_Ch, q_Ch;
};

// Concatenates blocks.
inline std::vector<Block> Joined(std::vector<Block> blocks, const std::vector<Block>& others) {
  blocks.insert(blocks.end(), others.begin(), others.end());
  return blocks;
}

}  // namespace plm_vins::testing
