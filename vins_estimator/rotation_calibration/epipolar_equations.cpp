// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/rotation_calibration/epipolar_equations.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/geometry/epipolar_constraint.h"
#include "common/geometry/so3.h"
#include "common/geometry/tangent_basis.h"

namespace plm_vins {
namespace {

using Error = CalibrationError;

constexpr double kTolerance = 2;  // scale of the robust cost, in standard deviations
constexpr int kDirectionIterations = 4;
constexpr double kLeastInformation = 1e-9;  // of the direction, where nothing translates

// The points of a pair depend on the camera's rotation vector psi, with R_now_then = Exp(-psi), on
// the lens, and on the direction of translation, in this order.
constexpr int kFocal = 3, kDistortion = 4, kPrincipal = 5, kLocal = 7, kAll = 9;
using PairVector = Eigen::Matrix<double, kAll, 1>;
using PairMatrix = Eigen::Matrix<double, kAll, kAll>;

struct Point {
  Eigen::Vector3d then, now;  // rays, `then` rotated into the frame of now
  Eigen::Vector3d normal;     // then x now, across which the translation lies
  double noise = 0;           // standard deviation of a ray across
  double line = 0;            // length of the epipolar line's normal
  double error = 0;           // distance from the line, in standard deviations

  double Weight() const { return 1 / (1 + std::pow(error / kTolerance, 2)); }
  double Cost() const {
    return 0.5 * kTolerance * kTolerance * std::log1p(std::pow(error / kTolerance, 2));
  }
};

// By how much a ray across the axis is longer than configured.
double Factor(const Eigen::Vector2d& xy, const Error::Vector& x) {
  return 1 + x[Error::kFocal] + x[Error::kDistortion] * xy.squaredNorm();
}

Eigen::Vector3d CorrectedRay(const Eigen::Vector2d& xy, const Error::Vector& x) {
  return (Factor(xy, x) * xy + x.segment<2>(Error::kPrincipal)).eval().homogeneous();
}

// Returns the direction of translation that fits best, and sets the errors of the points.
Eigen::Vector3d FitTranslation(std::vector<Point>* points) {
  Eigen::Vector3d direction;
  for (int k = 0; k < kDirectionIterations; ++k) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (const Point& point : *points) {
      const double weight = k == 0 ? 1 : point.Weight() / (point.line * point.line);
      squares += weight * point.normal * point.normal.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(squares);
    direction = eigen.eigenvectors().col(0);
    for (Point& point : *points) {
      point.line = std::max(direction.cross(point.then).head<2>().norm(), 1e-6);
      point.error = direction.dot(point.normal) / (point.line * M_SQRT2 * point.noise);
    }
  }
  return direction;
}

// Rotation of the camera in a pair: psi = R_C_B ((I - E) phi - bias T + delay rate_change).
struct CameraRotation {
  Eigen::Vector3d extrinsics;  // error of R_B_C
  Eigen::Matrix3d R_C_B;
  Eigen::Vector3d phi;  // as the gyroscope read it, in the body
  Eigen::Vector3d psi;

  CameraRotation(const RotationPair& pair, const Eigen::Quaterniond& R_B_C, const Error::Vector& x)
      : extrinsics(x.segment<3>(Error::kExtrinsics)),
        R_C_B((R_B_C * SO3Exp(extrinsics)).conjugate().toRotationMatrix()),
        phi(SO3Log(pair.R_B0_B1)) {
    const Eigen::Map<const Eigen::Matrix3d> E(x.data() + Error::kGyro);
    psi = R_C_B * (phi - E * phi - pair.duration * x.segment<3>(Error::kBias) +
                   x[Error::kDelay] * pair.rate_change);
  }
};

// Derivative of psi and of the lens.
Eigen::Matrix<double, kLocal, Error::kSize> LocalJacobian(const RotationPair& pair,
                                                          const CameraRotation& rotation) {
  Eigen::Matrix<double, kLocal, Error::kSize> J;
  J.setZero();
  J.block<3, 3>(0, Error::kBias) = -pair.duration * rotation.R_C_B;
  J.block<3, 1>(0, Error::kDelay) = rotation.R_C_B * pair.rate_change;
  J.block<3, 3>(0, Error::kExtrinsics) = Skew(rotation.psi) * SO3RightJacobian(rotation.extrinsics);
  for (int k = 0; k < 3; ++k) {
    J.block<3, 3>(0, Error::kGyro + 3 * k) = -rotation.phi[k] * rotation.R_C_B;
  }
  J(kFocal, Error::kFocal) = J(kDistortion, Error::kDistortion) = 1;
  J.block<2, 2>(kPrincipal, Error::kPrincipal).setIdentity();
  return J;
}

// The points of a pair with the direction of translation that fits them best.
class PairGeometry {
 public:
  PairGeometry(const RotationPair& pair, const CameraRotation& rotation, double noise,
               const Error::Vector& x)
      : pair_(pair),
        R_now_then_(SO3Exp(-rotation.psi).toRotationMatrix()),
        Jr_(SO3RightJacobian(rotation.psi)),
        points_(pair.points.size()) {
    for (size_t i = 0; i < points_.size(); ++i) {
      const auto& [xy0, xy1] = pair.points[i];
      points_[i].then = R_now_then_ * CorrectedRay(xy0, x);
      points_[i].now = CorrectedRay(xy1, x);
      points_[i].noise = std::abs(Factor(xy1, x)) * noise;
      points_[i].normal = points_[i].then.cross(points_[i].now);
    }
    direction_ = FitTranslation(&points_);
    across_ = TangentBasis(direction_);
  }

  size_t size() const { return points_.size(); }
  const Point& operator[](size_t i) const { return points_[i]; }

  // Returns the derivative of a point's error by what the pair depends on. The length of the line's
  // normal is taken as constant.
  PairVector Derivative(size_t i) const {
    const Point& point = points_[i];
    const auto& [xy0, xy1] = pair_.points[i];
    const Eigen::Vector2d by_then =
        R_now_then_.leftCols<2>().transpose() * point.now.cross(direction_);
    const Eigen::Vector2d by_now = direction_.cross(point.then).head<2>();
    const double focal_then = by_then.dot(xy0), focal_now = by_now.dot(xy1);
    const auto pose = EpipolarGradient(1, point.then, point.now, direction_, across_);
    PairVector derivative;
    derivative.head<3>() = -Jr_.transpose() * pose.head<3>();
    derivative[kFocal] = focal_then + focal_now;
    derivative[kDistortion] = xy0.squaredNorm() * focal_then + xy1.squaredNorm() * focal_now;
    derivative.segment<2>(kPrincipal) = by_then + by_now;
    derivative.tail<2>() = pose.tail<2>();
    return derivative / (point.line * M_SQRT2 * point.noise);
  }

 private:
  const RotationPair& pair_;
  Eigen::Matrix3d R_now_then_, Jr_;
  std::vector<Point> points_;
  Eigen::Vector3d direction_;
  Eigen::Matrix<double, 3, 2> across_;
};

// Adds a pair after its direction of translation is eliminated.
void AddPair(const RotationPair& pair, const CameraRotation& rotation, const PairGeometry& geometry,
             EpipolarEquations* equations) {
  PairMatrix H = PairMatrix::Zero();
  PairVector g = PairVector::Zero();
  for (size_t i = 0; i < geometry.size(); ++i) {
    const Point& point = geometry[i];
    const PairVector derivative = geometry.Derivative(i);
    H += point.Weight() * derivative * derivative.transpose();
    g += point.Weight() * point.error * derivative;
    equations->cost += point.Cost();
  }
  equations->points += static_cast<double>(geometry.size());
  Eigen::Matrix2d H_direction = H.bottomRightCorner<2, 2>();
  H_direction.diagonal().array() += kLeastInformation;
  const Eigen::Matrix<double, kLocal, 2> gain =
      H.topRightCorner<kLocal, 2>() * H_direction.inverse();
  const auto J = LocalJacobian(pair, rotation);
  equations->H += J.transpose() *
                  (H.topLeftCorner<kLocal, kLocal>() - gain * H.bottomLeftCorner<2, kLocal>()) * J;
  equations->g += J.transpose() * (g.head<kLocal>() - gain * g.tail<2>());
}

}  // namespace

EpipolarEquations LinearizeEpipolar(const std::vector<RotationPair>& pairs,
                                    const Eigen::Quaterniond& R_B_C, double noise,
                                    const CalibrationError::Vector& x) {
  EpipolarEquations equations;
  for (const RotationPair& pair : pairs) {
    const CameraRotation rotation(pair, R_B_C, x);
    AddPair(pair, rotation, PairGeometry(pair, rotation, noise, x), &equations);
  }
  return equations;
}

}  // namespace plm_vins
