// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/initial_prior.h"

#include <Eigen/Core>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "common/geometry/so3.h"

namespace plm_vins {
namespace {

// Builds a prior of independent variables.
class PriorBuilder {
 public:
  // Adds a variable with the given information on its tangent space.
  void Add(const BlockId& id, const double* values, const Eigen::MatrixXd& information) {
    const auto offset = H_.rows();
    const auto size = offset + information.rows();
    blocks_.push_back(MarginalizationPrior::MakeBlock(id, static_cast<int>(offset), values));
    H_.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
    H_.bottomRightCorner(information.rows(), information.rows()) = information;
  }

  // Adds a variable with the given standard deviations.
  void Add(const BlockId& id, const double* values, const Eigen::VectorXd& sigmas) {
    Add(id, values, Eigen::MatrixXd(sigmas.cwiseAbs2().cwiseInverse().asDiagonal()));
  }

  // Adds information on the variables from a residual's Jacobian, whitened, by their offsets. Both
  // variables of three dimensions must have been added.
  void AddResidual(int first, const Eigen::Matrix3d& by_first, int second,
                   const Eigen::Matrix3d& by_second) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, H_.cols());
    J.middleCols<3>(first) = by_first;
    J.middleCols<3>(second) = by_second;
    H_ += J.transpose() * J;
  }

  MarginalizationPrior Build() {
    return {std::move(blocks_), {H_, Eigen::VectorXd::Zero(H_.rows())}};
  }

 private:
  std::vector<MarginalizationPrior::Block> blocks_;
  Eigen::MatrixXd H_;
};

// Returns a vector with `count` copies of each standard deviation, in sequence.
Eigen::VectorXd Sigmas(std::initializer_list<std::pair<int, double>> counts_and_values) {
  std::vector<double> sigmas;
  for (const auto& [count, value] : counts_and_values) sigmas.insert(sigmas.end(), count, value);
  return Eigen::Map<const Eigen::VectorXd>(sigmas.data(), static_cast<Eigen::Index>(sigmas.size()));
}

// Returns the standard deviations of configured intrinsics.
Eigen::VectorXd Sigmas(const IntrinsicsDeviation& deviation, const Intrinsics& intrinsics) {
  return Sigmas({{1, deviation.focal_length * intrinsics[0]},
                 {1, deviation.focal_length * intrinsics[1]},
                 {2, deviation.principal_point},
                 {4, deviation.distortion}});
}

// Returns the information matrix of a pose, of position in W and rotation in B, from the standard
// deviations of heading and inclination in W.
Eigen::MatrixXd PoseInformation(const InitialUncertainty& uncertainty, const FrameState& state) {
  const Eigen::Matrix3d R_W_B = state.rotation().toRotationMatrix();
  const double inclination =
      uncertainty.leveled_by ? std::numeric_limits<double>::infinity() : uncertainty.inclination;
  const Eigen::Vector3d sigma(inclination, inclination, uncertainty.heading);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(6, 6);
  information.diagonal().head<3>().setConstant(1 / (uncertainty.position * uncertainty.position));
  information.bottomRightCorner<3, 3>() =
      R_W_B.transpose() * sigma.cwiseAbs2().cwiseInverse().asDiagonal() * R_W_B;
  return information;
}

// Adds the horizontal part of r = f - b_a - R_W_B^T g, in B, with f the mean specific force at
// standstill and g upwards: an error of the bias tilts the pose, so that both are correlated.
void AddLevel(double deviation, const SlidingWindow& window, PriorBuilder* prior) {
  constexpr int kRotation = 3, kAccelBias = 6 + 3;
  const Eigen::Vector3d up_B =
      window.frames.front().state.rotation().conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d horizontal = Eigen::Matrix3d::Identity() - up_B * up_B.transpose();
  prior->AddResidual(kRotation, -window.gravity_W.norm() / deviation * Skew(up_B), kAccelBias,
                     -horizontal / deviation);
}

}  // namespace

MarginalizationPrior InitialPrior(const InitialUncertainty& uncertainty,
                                  const ProblemOptions& options, const SlidingWindow& window) {
  const FrameState& state = window.frames.front().state;
  PriorBuilder prior;
  prior.Add({BlockKind::kPose, state.t_ns}, state.pose.data(), PoseInformation(uncertainty, state));
  prior.Add(
      {BlockKind::kMotion, state.t_ns}, state.motion.data(),
      Sigmas({{3, uncertainty.velocity}, {3, uncertainty.accel_bias}, {3, uncertainty.gyro_bias}}));
  if (uncertainty.leveled_by) AddLevel(*uncertainty.leveled_by, window, &prior);
  if (options.estimate_extrinsic) {
    prior.Add({BlockKind::kExtrinsic, 0}, window.cameras.front().extrinsics.data(),
              Sigmas({{3, uncertainty.extrinsic_position}, {3, uncertainty.extrinsic_rotation}}));
  }
  if (options.estimate_depth_stream) {
    prior.Add({BlockKind::kDepthStream, 0}, window.depth_stream.data(),
              Sigmas({{1, uncertainty.depth_scale},
                      {1, uncertainty.depth_delay},
                      {2, uncertainty.depth_shift},
                      {1, uncertainty.depth_zoom}}));
  }
  if (options.estimate_td) {
    prior.Add({BlockKind::kTimeOffset, 0}, &window.td, Sigmas({{1, uncertainty.td}}));
  }
  if (options.estimate_intrinsics) {
    for (size_t i = 0; i < window.cameras.size(); ++i) {
      const Intrinsics& intrinsics = window.cameras[i].intrinsics;
      prior.Add({BlockKind::kIntrinsics, static_cast<int64_t>(i)}, intrinsics.data(),
                Sigmas(uncertainty.intrinsics, intrinsics));
    }
  }
  return prior.Build();
}

}  // namespace plm_vins
