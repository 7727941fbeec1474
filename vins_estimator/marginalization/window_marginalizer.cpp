// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_marginalizer.h"

#include <algorithm>
#include <utility>

#include "vins_estimator/problem/normal_equations.h"

namespace plm_vins {
namespace {

MarginalizationPrior::Block MakeBlock(const BlockId& id, int offset, const double* values) {
  MarginalizationPrior::Block block;
  block.id = id;
  block.offset = offset;
  std::copy(values, values + VariableTypeOf(id.kind).ambient_size, block.linearization.begin());
  return block;
}

void SetInformation(int offset, int size, double sigma, Eigen::MatrixXd* H) {
  H->diagonal().segment(offset, size).setConstant(1.0 / (sigma * sigma));
}

// Information on the rotation of a body, from the uncertainty of its heading and its inclination in
// the world.
Eigen::Matrix3d RotationInformation(const Eigen::Matrix3d& R_W_B, double inclination,
                                    double heading) {
  const Eigen::Vector3d sigma(inclination, inclination, heading);
  return R_W_B.transpose() * sigma.cwiseAbs2().cwiseInverse().asDiagonal() * R_W_B;
}

// All that a problem says about its frame variables, as a prior on them.
MarginalizationPrior Summarize(const WindowProblem& problem) {
  NormalEquations equations(problem);
  equations.Linearize();
  Quadratic quadratic;
  equations.Reduce(0, &quadratic.H, &quadratic.b);
  quadratic.H.triangularView<Eigen::StrictlyLower>() = quadratic.H.transpose();

  std::vector<MarginalizationPrior::Block> blocks;
  Eigen::VectorXd delta(quadratic.b.size());
  for (size_t i = 0; i < problem.variables().size(); ++i) {
    const Variable& variable = problem.variables()[i];
    const int offset = equations.DenseOffset(static_cast<int>(i));
    if (offset < 0) continue;
    const double* x0 = variable.linearization ? variable.linearization : variable.values;
    blocks.push_back(MakeBlock(variable.id, offset, x0));
    variable.type().minus(variable.values, x0, &delta[offset]);
  }
  // The equations' b is the gradient at the values; the prior counts from the linearisation points.
  quadratic.b -= quadratic.H * delta;
  return {std::move(blocks), std::move(quadratic)};
}

}  // namespace

std::function<bool(const BlockId&)> IsOfFrame(int64_t t_ns) {
  return [t_ns](const BlockId& id) {
    return (id.kind == BlockKind::kPose || id.kind == BlockKind::kMotion) && id.key == t_ns;
  };
}

std::function<bool(const BlockId&)> IsMotionOfFrame(int64_t t_ns) {
  return [t_ns](const BlockId& id) { return id.kind == BlockKind::kMotion && id.key == t_ns; };
}

MarginalizationPrior InitialPrior(const InitialUncertainty& uncertainty,
                                  const ProblemOptions& options, const SlidingWindow& window) {
  const FrameState& state = window.frames.front().state;
  int size = 15;
  const int extrinsic = options.estimate_extrinsic ? std::exchange(size, size + 6) : -1;
  const int td = options.estimate_td ? std::exchange(size, size + 1) : -1;
  const int readout = options.estimate_readout ? std::exchange(size, size + 1) : -1;
  const int intrinsics =
      options.estimate_intrinsics ? std::exchange(size, size + kIntrinsicsSize) : -1;
  Quadratic quadratic{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  std::vector<MarginalizationPrior::Block> blocks;

  blocks.push_back(MakeBlock({BlockKind::kPose, state.t_ns}, 0, state.pose.data()));
  SetInformation(0, 3, uncertainty.position, &quadratic.H);
  quadratic.H.block<3, 3>(3, 3) = RotationInformation(state.rotation().toRotationMatrix(),
                                                      uncertainty.inclination, uncertainty.heading);
  blocks.push_back(MakeBlock({BlockKind::kMotion, state.t_ns}, 6, state.motion.data()));
  SetInformation(6, 3, uncertainty.velocity, &quadratic.H);
  SetInformation(9, 3, uncertainty.accel_bias, &quadratic.H);
  SetInformation(12, 3, uncertainty.gyro_bias, &quadratic.H);
  if (extrinsic >= 0) {
    blocks.push_back(MakeBlock({BlockKind::kExtrinsic, 0}, extrinsic, window.extrinsic.data()));
    SetInformation(extrinsic, 3, uncertainty.extrinsic_position, &quadratic.H);
    SetInformation(extrinsic + 3, 3, uncertainty.extrinsic_rotation, &quadratic.H);
  }
  if (td >= 0) {
    blocks.push_back(MakeBlock({BlockKind::kTimeOffset, 0}, td, &window.td));
    SetInformation(td, 1, uncertainty.td, &quadratic.H);
  }
  if (readout >= 0) {
    blocks.push_back(MakeBlock({BlockKind::kReadout, 0}, readout, &window.readout));
    SetInformation(readout, 1, uncertainty.readout, &quadratic.H);
  }
  if (intrinsics >= 0) {
    blocks.push_back(MakeBlock({BlockKind::kIntrinsics, 0}, intrinsics, window.intrinsics.data()));
    const IntrinsicsDeviation& deviation = uncertainty.intrinsics;
    const double f_x = window.intrinsics[0], f_y = window.intrinsics[1];
    SetInformation(intrinsics, 1, deviation.focal_length * f_x, &quadratic.H);
    SetInformation(intrinsics + 1, 1, deviation.focal_length * f_y, &quadratic.H);
    SetInformation(intrinsics + 2, 2, deviation.principal_point, &quadratic.H);
    SetInformation(intrinsics + 4, 4, deviation.distortion, &quadratic.H);
  }
  return {std::move(blocks), std::move(quadratic)};
}

MarginalizationPrior MarginalizeOldest(const ProblemOptions& options,
                                       const MarginalizationPrior& prior, LocalMap* map,
                                       bool keep_pose) {
  const int64_t oldest_ns = map->window.frames.front().state.t_ns;
  ProblemBuilder builder(options, &map->window, &prior);
  builder.AddPrior();
  builder.AddMotion(1);
  for (auto& [id, landmark] : map->points.landmarks()) {
    if (LeavesWith(oldest_ns, landmark)) builder.AddPoint(&landmark);
  }
  for (auto& [id, landmark] : map->lines.landmarks()) {
    if (LeavesWith(oldest_ns, landmark)) builder.AddLine(&landmark);
  }
  return Summarize(builder.problem())
      .Marginalize(keep_pose ? IsMotionOfFrame(oldest_ns) : IsOfFrame(oldest_ns));
}

}  // namespace plm_vins
