// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/initialization/visual_inertial_bundle.h"

#include <ceres/ceres.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cmath>

#include "common/so3.h"
#include "vins_estimator/factors/imu_factor.h"
#include "vins_estimator/factors/manifolds.h"
#include "vins_estimator/factors/point_factor.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

constexpr int kIterations = 12;
constexpr double kTolerance = 1e-3;       // the window is optimised further
constexpr double kGaugeDeviation = 1e-3;  // [m] and [rad]; any small value will do

// Holds position and heading of a pose: [p - p0, angle about the world's z] / deviation.
class GaugePrior final : public ceres::SizedCostFunction<4, kPoseSize> {
 public:
  explicit GaugePrior(const FrameState& state) : state_(state) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    std::array<double, kPoseTangentSize> delta;
    PoseMinus(parameters[0], state_.pose.data(), delta.data());
    const Eigen::Map<const Eigen::Vector3d> dp(delta.data()), theta(delta.data() + 3);
    const Eigen::RowVector3d z_axis = state_.rotation().toRotationMatrix().row(2);
    Eigen::Map<Eigen::Vector4d> residual(residuals);
    residual << dp, z_axis.dot(theta);
    residual /= kGaugeDeviation;
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 4, kPoseSize, Eigen::RowMajor>> J(jacobians[0]);
      J.setZero();
      J.topLeftCorner<3, 3>().setIdentity();
      J.block<1, 3>(3, 3) = z_axis * SO3RightJacobianInverse(theta);
      J /= kGaugeDeviation;
    }
    return true;
  }

 private:
  FrameState state_;
};

// Holds the biases of the first frame softly. Block: motion.
class BiasPrior final : public ceres::SizedCostFunction<6, 9> {
 public:
  BiasPrior(const ImuBias& mean, double accel_deviation, double gyro_deviation) {
    mean_ << mean.accel, mean.gyro;
    inverse_deviation_ << Eigen::Vector3d::Constant(1 / accel_deviation),
        Eigen::Vector3d::Constant(1 / gyro_deviation);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    const Eigen::Map<const Vector6> bias(parameters[0] + 3);
    Eigen::Map<Vector6> residual(residuals);
    residual = inverse_deviation_.cwiseProduct(bias - mean_);
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 6, 9, Eigen::RowMajor>> J(jacobians[0]);
      J.setZero();
      J.rightCols<6>() = inverse_deviation_.asDiagonal();
    }
    return true;
  }

 private:
  Eigen::Matrix<double, 6, 1> mean_, inverse_deviation_;
};

// The adjustment as a Ceres problem over the given states.
class Bundle {
 public:
  Bundle(const std::vector<Track>& tracks, const std::vector<std::optional<Eigen::Vector3d>>& p_W,
         const std::vector<Preintegration>& preintegrations,
         const VisualInertialBundleOptions& options, std::vector<FrameState>* states);

  bool Solve();
  double Rms(const std::vector<ceres::ResidualBlockId>& blocks, int freedom);
  double ReprojectionRms() {
    return Rms(point_blocks_, kPointSize * static_cast<int>(points_.size()));
  }
  double ImuRms() { return Rms(imu_blocks_, 0); }
  std::optional<double> RelativeScaleDeviation();

 private:
  void AddImu(const std::vector<Preintegration>& preintegrations);
  void AddPriors();
  Eigen::Vector3d InCamera(int view, const Eigen::Vector3d& p_W) const;
  void AddTrack(const Track& track, const Eigen::Vector3d& p_W);
  Eigen::SparseMatrix<double> Hessian();
  Eigen::VectorXd ScaleDirection(int size) const;

  VisualInertialBundleOptions options_;
  std::vector<FrameState>& states_;
  std::array<double, kPoseSize> extrinsics_;
  double time_offset_ = 0;
  std::vector<std::array<double, kPointSize>> points_;  // image point and inverse depth in the host
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> point_blocks_, imu_blocks_;
};

Bundle::Bundle(const std::vector<Track>& tracks,
               const std::vector<std::optional<Eigen::Vector3d>>& p_W,
               const std::vector<Preintegration>& preintegrations,
               const VisualInertialBundleOptions& options, std::vector<FrameState>* states)
    : options_(options), states_(*states) {
  FrameState extrinsics;
  extrinsics.SetPose(options.T_B_C);
  extrinsics_ = extrinsics.pose;
  points_.reserve(tracks.size());  // the solver holds pointers to the elements
  for (FrameState& state : states_) {
    problem_.AddParameterBlock(state.pose.data(), kPoseSize);
    SetPoseManifold(&problem_, state.pose.data());
    problem_.AddParameterBlock(state.motion.data(), 9);
  }
  problem_.AddParameterBlock(extrinsics_.data(), kPoseSize);
  problem_.SetParameterBlockConstant(extrinsics_.data());
  problem_.AddParameterBlock(&time_offset_, 1);
  problem_.SetParameterBlockConstant(&time_offset_);
  AddImu(preintegrations);
  AddPriors();
  for (size_t i = 0; i < tracks.size(); ++i) {
    if (p_W[i]) AddTrack(tracks[i], *p_W[i]);
  }
}

void Bundle::AddImu(const std::vector<Preintegration>& preintegrations) {
  const Eigen::Vector3d gravity_W(0, 0, -options_.gravity_norm);
  for (size_t i = 0; i < preintegrations.size(); ++i) {
    FrameState &from = states_[i], &to = states_[i + 1];
    imu_blocks_.push_back(problem_.AddResidualBlock(new ImuFactor(&preintegrations[i], gravity_W),
                                                    nullptr, from.pose.data(), from.motion.data(),
                                                    to.pose.data(), to.motion.data()));
  }
}

void Bundle::AddPriors() {
  FrameState& first = states_.front();
  problem_.AddResidualBlock(new GaugePrior(first), nullptr, first.pose.data());
  const ImuBias mean{Eigen::Vector3d::Zero(), first.gyro_bias()};
  problem_.AddResidualBlock(
      new BiasPrior(mean, options_.accel_bias_prior, options_.gyro_bias_prior), nullptr,
      first.motion.data());
}

Eigen::Vector3d Bundle::InCamera(int view, const Eigen::Vector3d& p_W) const {
  return (states_[view].T_W_B() * options_.T_B_C).Inverse() * p_W;
}

// The point in the first view of the track; one factor per view.
void Bundle::AddTrack(const Track& track, const Eigen::Vector3d& p_W) {
  const ViewObservation& host = track.observations.front();
  for (const ViewObservation& o : track.observations) {
    if (InCamera(o.view, p_W).z() < kMinLandmarkDepth) return;
  }
  const Eigen::Vector3d p_C = InCamera(host.view, p_W);
  points_.push_back({p_C.x() / p_C.z(), p_C.y() / p_C.z(), 1 / p_C.z()});
  double* point = points_.back().data();
  const double weight = 1 / options_.noise;
  point_blocks_.push_back(
      problem_.AddResidualBlock(new PointHostFactor({host.xy, Eigen::Vector2d::Zero(), 0}, weight),
                                new ceres::CauchyLoss(1.0), &time_offset_, point));
  for (size_t i = 1; i < track.observations.size(); ++i) {
    const ViewObservation& target = track.observations[i];
    point_blocks_.push_back(problem_.AddResidualBlock(
        new PointFactor({target.xy, Eigen::Vector2d::Zero(), 0}, weight),
        new ceres::CauchyLoss(1.0), states_[host.view].pose.data(),
        states_[target.view].pose.data(), extrinsics_.data(), &time_offset_, point));
  }
}

bool Bundle::Solve() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = kIterations;
  options.function_tolerance = kTolerance;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (auto& point : points_) {
    options.linear_solver_ordering->AddElementToGroup(point.data(), 0);
  }
  for (FrameState& state : states_) {
    options.linear_solver_ordering->AddElementToGroup(state.pose.data(), 1);
    options.linear_solver_ordering->AddElementToGroup(state.motion.data(), 1);
  }
  options.linear_solver_ordering->AddElementToGroup(extrinsics_.data(), 1);
  options.linear_solver_ordering->AddElementToGroup(&time_offset_, 1);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  return summary.IsSolutionUsable();
}

// Root mean square of the whitened residuals, less the unknowns that only they determine.
double Bundle::Rms(const std::vector<ceres::ResidualBlockId>& blocks, int freedom) {
  ceres::Problem::EvaluateOptions options;
  options.residual_blocks = blocks;
  std::vector<double> residuals;
  problem_.Evaluate(options, nullptr, &residuals, nullptr, nullptr);
  const double squared_sum =
      Eigen::Map<const Eigen::VectorXd>(residuals.data(), residuals.size()).squaredNorm();
  return std::sqrt(squared_sum / std::max(1, static_cast<int>(residuals.size()) - freedom));
}

// Gauss-Newton Hessian in the order: poses, motions, points.
Eigen::SparseMatrix<double> Bundle::Hessian() {
  ceres::Problem::EvaluateOptions options;
  for (FrameState& state : states_) options.parameter_blocks.push_back(state.pose.data());
  for (FrameState& state : states_) options.parameter_blocks.push_back(state.motion.data());
  for (auto& point : points_) options.parameter_blocks.push_back(point.data());
  ceres::CRSMatrix crs;
  problem_.Evaluate(options, nullptr, nullptr, nullptr, &crs);
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> rows(
      crs.num_rows, crs.num_cols, static_cast<int>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
  const Eigen::SparseMatrix<double> J = rows;
  return J.transpose() * J;
}

// The change of the logarithm of the trajectory's size with each unknown, to first order: positions
// about their mean, projected onto themselves.
Eigen::VectorXd Bundle::ScaleDirection(int size) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const FrameState& state : states_) mean += state.position() / states_.size();
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(size);
  double squared_size = 0;
  for (size_t i = 0; i < states_.size(); ++i) {
    direction.segment<3>(kPoseTangentSize * i) = states_[i].position() - mean;
    squared_size += (states_[i].position() - mean).squaredNorm();
  }
  return direction / squared_size;
}

std::optional<double> Bundle::RelativeScaleDeviation() {
  const Eigen::SparseMatrix<double> H = Hessian();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(H);
  if (ldlt.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd direction = ScaleDirection(static_cast<int>(H.rows()));
  const double variance = direction.dot(ldlt.solve(direction));
  if (!(variance > 0)) return std::nullopt;
  return std::sqrt(variance);
}

}  // namespace

std::optional<VisualInertialBundle> AdjustVisualInertialBundle(
    const std::vector<Track>& tracks, const std::vector<std::optional<Eigen::Vector3d>>& p_W,
    const std::vector<Preintegration>& preintegrations, const VisualInertialBundleOptions& options,
    std::vector<FrameState>* states, std::string* reason) {
  Bundle bundle(tracks, p_W, preintegrations, options, states);
  if (!bundle.Solve()) {
    *reason = "the visual-inertial bundle adjustment failed";
    return std::nullopt;
  }
  const std::optional<double> scale_deviation = bundle.RelativeScaleDeviation();
  if (!scale_deviation) {
    *reason = "the visual-inertial bundle adjustment is not determined";
    return std::nullopt;
  }
  return VisualInertialBundle{bundle.ReprojectionRms(), bundle.ImuRms(), *scale_deviation};
}

}  // namespace plm_vins
