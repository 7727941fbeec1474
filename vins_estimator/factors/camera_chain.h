// SPDX-License-Identifier: BSD-3-Clause
// The transform of a landmark from the camera that hosts it to a camera that observes it,
//   T_Ct_Ch = T_B_Ct^-1 T_W_Bt^-1 T_W_Bh T_B_Ch,
// with the derivatives along it, for the factors of all observations.
#pragma once

#include <Eigen/Core>
#include <array>

#include "vins_estimator/factors/manifolds.h"

namespace plm_vins {

// Relation of an observation to the host: in one frame the poses cancel, and in one frame
// and one camera nothing is left of the chain. With one camera in two frames, both ends of the
// chain have the same extrinsics.
struct ChainKind {
  bool same_frame = false;
  bool same_camera = false;

  // Returns whether the observation is that of the host itself.
  bool is_host() const { return same_frame && same_camera; }

  // Number of pose blocks. Their order is: extrinsics of the host's camera; poses of host and
  // target if the frames differ; extrinsics of the target's camera if the cameras differ.
  int CountBlocks() const {
    return is_host() ? 0 : 1 + (same_frame ? 0 : 2) + (same_camera ? 0 : 1);
  }
};

// Derivative of a residual with kRows rows with respect to a pose.
template <int kRows>
struct PoseDerivative {
  using Matrix = Eigen::Matrix<double, kRows, 3>;
  Matrix position = Matrix::Zero(), rotation = Matrix::Zero();
};

// The coordinates of a landmark in each frame of the chain. A Landmark, such as a point or a line,
// provides
//   Landmark ToParent(const PoseBlock&, const Landmark& in_child), and ToChild,
//   Derivative ByParent(const PoseBlock&, const Derivative& by_child), and ByChild,
//   AddPoseDerivative(sign, by_child, in_child, by_parent, in_parent, PoseDerivative*).
template <typename Landmark>
class CameraChain {
 public:
  // `poses` are the blocks that `kind` states.
  CameraChain(const ChainKind& kind, double const* const* poses, const Landmark& in_host)
      : block_count_(kind.CountBlocks()) {
    landmarks_[0] = in_host;
    for (int i = 0; i < block_count_; ++i) poses_[i] = PoseBlock(poses[i]);
    if (kind.is_host()) return;
    GoToParent(0);
    if (!kind.same_frame) {
      GoToParent(1);
      GoToChild(2);
    }
    GoToChild(kind.same_camera ? 0 : block_count_ - 1);
  }

  const Landmark& in_target() const { return landmarks_[step_count_]; }

  // Writes the requested Jacobians with respect to the poses, given the derivative with respect to
  // the landmark in the target. Returns that with respect to the landmark in the host.
  template <int kRows, typename Derivative>
  Derivative SetJacobians(Derivative derivative, double** jacobians) const {
    std::array<PoseDerivative<kRows>, kMaxSteps> sums;
    for (int i = step_count_ - 1; i >= 0; --i) {
      const auto [block, sign] = steps_[i];
      const Derivative after = derivative;
      const Landmark &in_before = landmarks_[i], &in_after = landmarks_[i + 1];
      if (sign > 0) {
        derivative = ByChild(poses_[block], after);
        if (jacobians[block]) {
          AddPoseDerivative(sign, derivative, in_before, after, in_after, &sums[block]);
        }
      } else {
        derivative = ByParent(poses_[block], after);
        if (jacobians[block]) {
          AddPoseDerivative(sign, after, in_after, derivative, in_before, &sums[block]);
        }
      }
    }
    for (int i = 0; i < block_count_; ++i) {
      if (jacobians[i]) SetPoseJacobian<kRows>(sums[i].position, sums[i].rotation, jacobians[i]);
    }
    return derivative;
  }

 private:
  static constexpr int kMaxSteps = 4;
  struct Step {
    int block;
    double sign;  // 1 to the parent frame, -1 to the child
  };

  void GoToParent(int block) {
    landmarks_[step_count_ + 1] = ToParent(poses_[block], landmarks_[step_count_]);
    steps_[step_count_++] = {block, 1};
  }
  void GoToChild(int block) {
    landmarks_[step_count_ + 1] = ToChild(poses_[block], landmarks_[step_count_]);
    steps_[step_count_++] = {block, -1};
  }

  int block_count_, step_count_ = 0;
  std::array<PoseBlock, kMaxSteps> poses_;
  std::array<Step, kMaxSteps> steps_;
  std::array<Landmark, kMaxSteps + 1> landmarks_;
};

}  // namespace plm_vins
