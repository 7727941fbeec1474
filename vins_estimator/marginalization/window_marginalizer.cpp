// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/marginalization/window_marginalizer.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

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

// A prior on some variables, each by itself.
class PriorBuilder {
 public:
  // The next variable, with this information on its tangent space.
  void Add(const BlockId& id, const double* values, const Eigen::MatrixXd& information) {
    const auto offset = H_.rows();
    const auto size = offset + information.rows();
    blocks_.push_back(MakeBlock(id, static_cast<int>(offset), values));
    H_.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
    H_.bottomRightCorner(information.rows(), information.rows()) = information;
  }

  // The same by standard deviations.
  void Add(const BlockId& id, const double* values, const Eigen::VectorXd& sigmas) {
    Add(id, values, Eigen::MatrixXd(sigmas.cwiseAbs2().cwiseInverse().asDiagonal()));
  }

  MarginalizationPrior Build() {
    return {std::move(blocks_), {H_, Eigen::VectorXd::Zero(H_.rows())}};
  }

 private:
  std::vector<MarginalizationPrior::Block> blocks_;
  Eigen::MatrixXd H_;
};

// So many of each standard deviation, one after the other.
Eigen::VectorXd Sigmas(std::initializer_list<std::pair<int, double>> counts_and_values) {
  std::vector<double> sigmas;
  for (const auto& [count, value] : counts_and_values) sigmas.insert(sigmas.end(), count, value);
  return Eigen::Map<const Eigen::VectorXd>(sigmas.data(), static_cast<Eigen::Index>(sigmas.size()));
}

// Information on a pose: on the position in the world, and on the rotation of the body, from the
// uncertainty of its heading and its inclination in the world.
Eigen::MatrixXd PoseInformation(const InitialUncertainty& uncertainty, const FrameState& state) {
  const Eigen::Matrix3d R_W_B = state.rotation().toRotationMatrix();
  const Eigen::Vector3d sigma(uncertainty.inclination, uncertainty.inclination,
                              uncertainty.heading);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(6, 6);
  information.diagonal().head<3>().setConstant(1 / (uncertainty.position * uncertainty.position));
  information.bottomRightCorner<3, 3>() =
      R_W_B.transpose() * sigma.cwiseAbs2().cwiseInverse().asDiagonal() * R_W_B;
  return information;
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
  PriorBuilder prior;
  prior.Add({BlockKind::kPose, state.t_ns}, state.pose.data(), PoseInformation(uncertainty, state));
  prior.Add(
      {BlockKind::kMotion, state.t_ns}, state.motion.data(),
      Sigmas({{3, uncertainty.velocity}, {3, uncertainty.accel_bias}, {3, uncertainty.gyro_bias}}));
  if (options.estimate_extrinsic) {
    prior.Add({BlockKind::kExtrinsic, 0}, window.extrinsic.data(),
              Sigmas({{3, uncertainty.extrinsic_position}, {3, uncertainty.extrinsic_rotation}}));
  }
  if (options.estimate_td) {
    prior.Add({BlockKind::kTimeOffset, 0}, &window.td, Sigmas({{1, uncertainty.td}}));
  }
  if (options.estimate_readout) {
    prior.Add({BlockKind::kReadout, 0}, &window.readout, Sigmas({{1, uncertainty.readout}}));
  }
  if (options.estimate_intrinsics) {
    const IntrinsicsDeviation& deviation = uncertainty.intrinsics;
    prior.Add({BlockKind::kIntrinsics, 0}, window.intrinsics.data(),
              Sigmas({{1, deviation.focal_length * window.intrinsics[0]},
                      {1, deviation.focal_length * window.intrinsics[1]},
                      {2, deviation.principal_point},
                      {4, deviation.distortion}}));
  }
  return prior.Build();
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
