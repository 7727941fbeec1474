// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "common/measurements.h"
#include "pose_graph/map/keyframe_map.h"

namespace plm_vins {

// Validates a map that was read from a file of any origin: a NaN in an edge makes every
// optimization fail, and an edge from a node to itself aborts the program. Throws
// std::runtime_error if the condition does not hold.

inline void RequireOfMap(bool holds, const char* otherwise) {
  if (!holds) throw std::runtime_error(std::string("is damaged: ") + otherwise);
}

// An archive that checks that all numbers are finite and small enough for products of a few of them
// to be finite.
class MapNumberCheck {
 public:
  template <typename T>
  void Value(const T& value) const {
    if constexpr (std::is_floating_point_v<T>) {
      RequireOfMap(std::abs(value) < kMost, "a number is not finite or too large");
    }
  }
  template <typename Items, typename Layout>
  void List(const Items& items, const Layout& layout) const {
    for (const auto& item : items) layout(this, item);
  }
  template <typename T>
  bool Has(const std::optional<T>& value) const {
    return value.has_value();
  }

 private:
  static constexpr double kMost = 1e30;
};

inline bool IsUnit(const Eigen::Quaterniond& q) {
  constexpr double kTolerance = 1e-2;  // deviation of the quaternion's norm
  return std::abs(q.norm() - 1) < kTolerance;
}

// Returns whether the matrix is symmetric and positive definite, with a minimum variance.
inline bool IsCovariance(const Matrix4d& covariance) {
  constexpr double kTolerance = 1e-3;       // relative asymmetry
  constexpr double kLeastDeviation = 1e-9;  // [m, rad]
  const Eigen::LLT<Matrix4d> factor(covariance);
  return factor.info() == Eigen::Success &&
         factor.matrixLLT().diagonal().minCoeff() > kLeastDeviation &&
         covariance.isApprox(covariance.transpose(), kTolerance);
}

// Corners with a position need a track: without it they would all be the same landmark.
inline void CheckKeyframe(const Keyframe& keyframe) {
  constexpr int kMostWorlds = 1 << 30;  // upper bound, since each run adds one
  RequireOfMap(IsStamp(keyframe.t_ns), "the timestamp of a keyframe is invalid");
  RequireOfMap(keyframe.world >= 0 && keyframe.world < kMostWorlds,
               "the world of a keyframe is invalid");
  RequireOfMap(IsUnit(keyframe.T_O_B.rotation) && IsUnit(keyframe.T_B_C.rotation) &&
                   IsUnit(keyframe.R_O_Manhattan.value_or(Eigen::Quaterniond::Identity())),
               "a rotation is not normalized");
  for (const DescribedCorner& corner : keyframe.corners) {
    RequireOfMap(corner.track >= 0 || !corner.p_O, "a corner without a track has a position");
  }
}

// Negative lengths would make the search for the shortest path endless.
inline void CheckEdge(const LevelEdge& edge, int nodes) {
  RequireOfMap(std::min(edge.from, edge.to) >= 0 && std::max(edge.from, edge.to) < nodes,
               "an edge leads to a keyframe that does not exist");
  RequireOfMap(edge.from != edge.to, "an edge leads from a keyframe to itself");
  RequireOfMap(edge.way >= 0, "an edge has a negative length");
  RequireOfMap(IsCovariance(edge.covariance), "the covariance of an edge is invalid");
}

// Requires that MapNumberCheck has passed.
inline void CheckMap(const std::vector<Keyframe>& keyframes,
                     const std::vector<LevelTransform>& nodes,
                     const std::vector<LevelEdge>& edges) {
  RequireOfMap(nodes.size() == keyframes.size(),
               "the number of poses differs from the number of keyframes");
  for (const Keyframe& keyframe : keyframes) CheckKeyframe(keyframe);
  for (const LevelEdge& edge : edges) CheckEdge(edge, static_cast<int>(nodes.size()));
}

}  // namespace plm_vins
