// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/structure_from_motion/relative_pose.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "common/geometry/epipolar_constraint.h"
#include "common/geometry/so3.h"
#include "common/geometry/symmetric_system.h"
#include "common/geometry/tangent_basis.h"
#include "common/opencv_version.h"
#include "common/statistics.h"

namespace plm_vins {
namespace {

constexpr size_t kMinCorrespondences = 15;
constexpr int kMinInliers = 12;
constexpr double kConfidence = 0.999;
// Enough iterations to find the model of at least 50 % inliers: ln(1 - kConfidence) / ln(1 -
// 0.5^5). With less than half, the result is rejected.
constexpr int kMaxIterations = 218;
constexpr double kInlierSigmas = 3.0;  // distance to the epipolar line, in standard deviations
constexpr int kRefinements = 8;
constexpr double kClearShare = 0.95;  // inliers with which RANSAC would not improve the result
// Standard deviation of the gyroscope's rotation before its bias is known: it selects one of the
// two solutions of a planar scene and has hardly any weight elsewhere [rad].
constexpr double kGyroDeviation = 0.05;

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

Eigen::Matrix3d ToEigen(const cv::Mat& m) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) result(row, col) = m.at<double>(row, col);
  }
  return result;
}

// First-order distance of a correspondence to the epipolar constraint f1 . (t x R f0) = 0, and its
// derivative for R <- Exp(theta) R and t <- t + B eta, with the weight of the constraint held
// constant.
struct EpipolarResidual {
  double distance;
  Vector5d gradient;
};

EpipolarResidual Evaluate(const Correspondence& c, const Eigen::Matrix3d& R,
                          const Eigen::Vector3d& t, const Eigen::Matrix<double, 3, 2>& B) {
  const Eigen::Vector3d f1 = c.xy1.homogeneous();
  const Eigen::Vector3d rotated = R * c.xy0.homogeneous();
  const Eigen::Vector3d line1 = t.cross(rotated);
  const Eigen::Vector3d line0 = R.transpose() * f1.cross(t);
  const double scale =
      1.0 / std::sqrt(line0.head<2>().squaredNorm() + line1.head<2>().squaredNorm() + 1e-18);
  EpipolarResidual residual;
  residual.distance = scale * f1.dot(line1);
  residual.gradient = EpipolarGradient(scale, rotated, f1, t, B);
  return residual;
}

// Refines a relative pose, with the gyroscope's rotation as a weak prior.
class PoseRefiner {
 public:
  PoseRefiner(const std::vector<Correspondence>& correspondences,
              const Eigen::Quaterniond& R_now_then_gyro, double noise)
      : correspondences_(correspondences), R_now_then_gyro_(R_now_then_gyro), noise_(noise) {}

  void Refine(RelativePose* pose) const {
    for (int i = 0; i < kRefinements; ++i) Step(pose);
  }

  double Cost(const RelativePose& pose) const;

 private:
  void Step(RelativePose* pose) const;
  Eigen::Vector3d GyroError(const RelativePose& pose) const {
    return SO3Log(pose.R_now_then * R_now_then_gyro_.conjugate()) / kGyroDeviation;
  }

  const std::vector<Correspondence>& correspondences_;
  Eigen::Quaterniond R_now_then_gyro_;
  double noise_;
};

// Returns the Cauchy cost of the whitened distances plus the squared error of the gyroscope.
double PoseRefiner::Cost(const RelativePose& pose) const {
  const Eigen::Matrix3d R = pose.R_now_then.toRotationMatrix();
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(pose.t_now_then);
  double cost = GyroError(pose).squaredNorm();
  for (const Correspondence& c : correspondences_) {
    const double whitened = Evaluate(c, R, pose.t_now_then, B).distance / noise_;
    cost += std::log1p(whitened * whitened);
  }
  return cost;
}

// Takes one Gauss-Newton step over all correspondences with Cauchy weights; also sets the
// information.
void PoseRefiner::Step(RelativePose* pose) const {
  const Eigen::Matrix3d R = pose->R_now_then.toRotationMatrix();
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(pose->t_now_then);
  Matrix5d H = Matrix5d::Zero();
  Vector5d g = Vector5d::Zero();
  for (const Correspondence& c : correspondences_) {
    EpipolarResidual r = Evaluate(c, R, pose->t_now_then, B);
    const double whitened = r.distance / noise_;
    const double weight = 1.0 / (1.0 + whitened * whitened);
    r.gradient /= noise_;
    H += weight * r.gradient * r.gradient.transpose();
    g += weight * whitened * r.gradient;
  }
  // A prior of one radian on the direction keeps the equations solvable under pure rotation.
  H.bottomRightCorner<2, 2>() += Eigen::Matrix2d::Identity();
  pose->rotation_information = H.topLeftCorner<3, 3>() - H.topRightCorner<3, 2>() *
                                                             H.bottomRightCorner<2, 2>().inverse() *
                                                             H.bottomLeftCorner<2, 3>();
  H.topLeftCorner<3, 3>() += Eigen::Matrix3d::Identity() / (kGyroDeviation * kGyroDeviation);
  g.head<3>() += GyroError(*pose) / kGyroDeviation;
  const Vector5d step = -SolveSymmetric(H, g);
  pose->R_now_then = (SO3Exp(step.head<3>()) * pose->R_now_then).normalized();
  pose->t_now_then = (pose->t_now_then + B * step.tail<2>()).normalized();
}

cv::Mat FindEssentialMatrix(const std::vector<cv::Point2d>& points0,
                            const std::vector<cv::Point2d>& points1, double max_distance) {
#if PLM_OPENCV_IS_AT_LEAST(4, 5, 4)  // before, the iterations cannot be limited
  return cv::findEssentialMat(points0, points1, cv::Mat::eye(3, 3, CV_64F), cv::RANSAC, kConfidence,
                              max_distance, kMaxIterations);
#else
  return cv::findEssentialMat(points0, points1, cv::Mat::eye(3, 3, CV_64F), cv::RANSAC, kConfidence,
                              max_distance);
#endif
}

// Returns the pose of the five-point RANSAC: of the decompositions of E, the one nearest to the
// gyroscope's rotation.
std::optional<RelativePose> FivePointPose(const std::vector<Correspondence>& correspondences,
                                          const Eigen::Quaterniond& R_now_then_gyro, double noise) {
  std::vector<cv::Point2d> points0, points1;
  for (const Correspondence& c : correspondences) {
    points0.emplace_back(c.xy0.x(), c.xy0.y());
    points1.emplace_back(c.xy1.x(), c.xy1.y());
  }
  const cv::Mat E = FindEssentialMatrix(points0, points1, kInlierSigmas * noise);
  if (E.rows != 3 || E.cols != 3) return std::nullopt;
  cv::Mat R_a, R_b, t;
  cv::decomposeEssentialMat(E, R_a, R_b, t);
  const Eigen::Quaterniond a(ToEigen(R_a)), b(ToEigen(R_b));
  const bool a_is_nearer = a.angularDistance(R_now_then_gyro) <= b.angularDistance(R_now_then_gyro);
  RelativePose pose;
  pose.R_now_then = a_is_nearer ? a : b;
  pose.t_now_then = Eigen::Vector3d(t.at<double>(0), t.at<double>(1), t.at<double>(2)).normalized();
  return pose;
}

// Returns the gyroscope's rotation with the translation direction that fits all epipolar planes
// best.
RelativePose GyroPose(const std::vector<Correspondence>& correspondences,
                      const Eigen::Quaterniond& R_now_then_gyro) {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const Correspondence& c : correspondences) {
    const Eigen::Vector3d rotated = R_now_then_gyro * c.xy0.homogeneous().eval();
    const Eigen::Vector3d normal = rotated.cross(c.xy1.homogeneous().eval());
    normals += normal * normal.transpose();
  }
  RelativePose pose;
  pose.R_now_then = R_now_then_gyro;
  pose.t_now_then = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normals).eigenvectors().col(0);
  return pose;
}

// Marks the inliers.
void Classify(const std::vector<Correspondence>& correspondences, double noise,
              RelativePose* pose) {
  const Eigen::Matrix3d R = pose->R_now_then.toRotationMatrix();
  const Eigen::Matrix<double, 3, 2> B = TangentBasis(pose->t_now_then);
  pose->inliers.assign(correspondences.size(), false);
  pose->num_inliers = 0;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    const double distance = Evaluate(correspondences[i], R, pose->t_now_then, B).distance;
    pose->inliers[i] = std::abs(distance) < kInlierSigmas * noise;
    pose->num_inliers += pose->inliers[i];
  }
}

// Returns the fit that starts from the gyroscope's rotation, or the RANSAC solution if the former
// has many outliers and the latter has a lower cost.
RelativePose FitPose(const std::vector<Correspondence>& correspondences,
                     const Eigen::Quaterniond& R_now_then_gyro, double noise) {
  const PoseRefiner refiner(correspondences, R_now_then_gyro, noise);
  RelativePose pose = GyroPose(correspondences, R_now_then_gyro);
  refiner.Refine(&pose);
  Classify(correspondences, noise, &pose);
  if (pose.num_inliers >= kClearShare * static_cast<double>(correspondences.size())) return pose;
  auto candidate = FivePointPose(correspondences, R_now_then_gyro, noise);
  if (!candidate) return pose;
  refiner.Refine(&*candidate);
  if (refiner.Cost(*candidate) >= refiner.Cost(pose)) return pose;
  Classify(correspondences, noise, &*candidate);
  return *candidate;
}

// Chooses the sign of the translation that gives most inliers positive depth.
void ChooseTranslationSign(const std::vector<Correspondence>& correspondences, RelativePose* pose) {
  int votes = 0;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    if (!pose->inliers[i]) continue;
    const Eigen::Vector3d f1 = correspondences[i].xy1.homogeneous();
    const Eigen::Vector3d rotated = pose->R_now_then * correspondences[i].xy0.homogeneous();
    // Multiplying depth1 f1 = depth0 R f0 + t by f1 x gives depth0 (f1 x R f0) = -f1 x t.
    votes += f1.cross(rotated).dot(f1.cross(pose->t_now_then)) < 0 ? 1 : -1;
  }
  if (votes < 0) pose->t_now_then = -pose->t_now_then;
}

}  // namespace

std::optional<RelativePose> EstimateRelativePose(const std::vector<Correspondence>& correspondences,
                                                 const Eigen::Quaterniond& R_now_then_gyro,
                                                 double noise, std::string* reason) {
  if (correspondences.size() < kMinCorrespondences) {
    *reason = "too few common points: " + std::to_string(correspondences.size()) + " of " +
              std::to_string(kMinCorrespondences);
    return std::nullopt;
  }
  RelativePose pose = FitPose(correspondences, R_now_then_gyro, noise);
  if (pose.num_inliers < std::max<int>(kMinInliers, correspondences.size() / 2)) {
    *reason = "epipolar geometry has too few inliers: " + std::to_string(pose.num_inliers) +
              " of " + std::to_string(correspondences.size());
    return std::nullopt;
  }
  ChooseTranslationSign(correspondences, &pose);
  return pose;
}

double MedianParallax(const std::vector<Correspondence>& correspondences,
                      const Eigen::Quaterniond& R_now_then) {
  std::vector<double> angles;
  for (const Correspondence& c : correspondences) {
    const Eigen::Vector3d rotated = R_now_then * c.xy0.homogeneous().eval();
    const Eigen::Vector3d f1 = c.xy1.homogeneous();
    angles.push_back(std::atan2(rotated.cross(f1).norm(), rotated.dot(f1)));
  }
  return Median(std::move(angles));
}

}  // namespace plm_vins
