// SPDX-License-Identifier: BSD-3-Clause
// Parameter blocks, and a scene that they describe, for tests of factors.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/rigid3.h"
#include "common/geometry/so3.h"
#include "simulator/random.h"
#include "test/testing/cost_function_check.h"
#include "vins_estimator/factors/camera_chain.h"
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

// All kinds of observations.
inline const std::vector<ChainKind>& ChainKinds() {
  static const std::vector<ChainKind> kinds = {
      {false, false}, {false, true}, {true, false}, {true, true}};
  return kinds;
}

// A body with two cameras at two poses; a host and a target among these four images; and two points
// that both see, which are the ends of a line.
struct FactorScene {
  explicit FactorScene(uint64_t seed, const ChainKind& chain_kind = {false, true})
      : kind(chain_kind) {
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
    T_B_Ch = {rotation(0.3), 0.1 * random.NormalVector3()};
    T_B_Ct = T_B_Ch * Rigid3d(rotation(0.05), Eigen::Vector3d(0.2, 0, 0));
    if (kind.same_frame) T_W_Bt = T_W_Bh;
    if (kind.same_camera) T_B_Ct = T_B_Ch;
    p_Ch = point();
    q_Ch = point();
  }

  Eigen::Vector3d InTarget(const Eigen::Vector3d& p) const {
    return (T_W_Bt * T_B_Ct).Inverse() * (T_W_Bh * (T_B_Ch * p));
  }
  Eigen::Vector2d SeenInTarget(const Eigen::Vector3d& p) const { return InTarget(p).hnormalized(); }

  // Blocks of the poses that the chain consists of.
  std::vector<Block> Poses() const {
    if (kind.is_host()) return {};
    std::vector<Block> poses = {PoseBlockOf(T_B_Ch)};
    if (!kind.same_frame) {
      poses.push_back(PoseBlockOf(T_W_Bh));
      poses.push_back(PoseBlockOf(T_W_Bt));
    }
    if (!kind.same_camera) poses.push_back(PoseBlockOf(T_B_Ct));
    return poses;
  }
  Block Point() const { return PointBlockOf(p_Ch); }
  Block Line() const { return LineBlockOf(LineThrough(p_Ch, q_Ch)); }

  ChainKind kind;
  Rigid3d T_W_Bh, T_W_Bt, T_B_Ch, T_B_Ct;
  Eigen::Vector3d p_Ch, q_Ch;
};

// Calls `test` with scenes of each kind.
template <typename Test>
void ForEachScene(const Test& test) {
  for (const ChainKind& kind : ChainKinds()) {
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE("same frame " + std::to_string(kind.same_frame) + ", same camera " +
                   std::to_string(kind.same_camera) + ", seed " + std::to_string(seed));
      test(FactorScene(seed, kind));
    }
  }
}

// Concatenates blocks.
inline std::vector<Block> Joined(std::vector<Block> blocks, const std::vector<Block>& others) {
  blocks.insert(blocks.end(), others.begin(), others.end());
  return blocks;
}

}  // namespace plm_vins::testing
