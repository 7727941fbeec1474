// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/geometry/line_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/symmetric_system.h"
#include "vins_estimator/geometry/depth_limits.h"

namespace plm_vins {
namespace {

using Matrix4d = Eigen::Matrix4d;
using Matrix34d = Eigen::Matrix<double, 3, kLineTangentSize>;

// Plane through a camera and the segment that it observes, normal . (x - camera) = 0, in the frame
// of the first camera.
struct ViewingPlane {
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit vector
  double offset = 0;                                 // normal . camera
  double deviation = 0;  // angle error of the normal about the viewing ray, for unit noise
};

ViewingPlane PlaneOf(const PosedLineObservation& observation, const Rigid3d& T_C0_W) {
  const Rigid3d T_C0_C = T_C0_W * observation.T_W_C;
  const SegmentEndPoints& segment = observation.segment;
  ViewingPlane plane;
  plane.normal =
      (T_C0_C.rotation * segment.start.homogeneous().cross(segment.end.homogeneous())).normalized();
  plane.camera = T_C0_C.translation;
  plane.offset = plane.normal.dot(plane.camera);
  plane.deviation = M_SQRT2 / (segment.end - segment.start).norm();
  return plane;
}

// Returns the distance of each camera from the other's viewing plane, the smaller of both. The
// angle between the planes would be mostly noise for short segments.
double BaselineAcross(const ViewingPlane& a, const ViewingPlane& b) {
  const Eigen::Vector3d baseline = b.camera - a.camera;
  return std::min(std::abs(a.normal.dot(baseline)), std::abs(b.normal.dot(baseline)));
}

// Intersects the two planes with the widest baseline relative to their noise.
std::optional<OrthonormalLine> BestIntersection(const std::vector<ViewingPlane>& planes) {
  double widest = 0;
  PluckerLine best;
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = i + 1; j < planes.size(); ++j) {
      const double width = BaselineAcross(planes[i], planes[j]) /
                           std::hypot(planes[i].deviation, planes[j].deviation);
      if (!(width > widest)) continue;
      widest = width;
      best = Intersection(planes[i].normal, planes[i].offset, planes[j].normal, planes[j].offset);
    }
  }
  if (!(best.moment.norm() > 0 && best.direction.norm() > 0)) return std::nullopt;
  return ToOrthonormal(best);
}

// Returns the relative standard deviation of an end's depth in the first camera.
double DepthDeviation(const Matrix4d& covariance, const OrthonormalLine& line,
                      const Eigen::Vector3d& across, const Eigen::Vector3d& end) {
  const PluckerLine plucker = ToPlucker(line.data());
  const PluckerJacobian J = ToPluckerJacobian(line.data());
  Matrix34d d_end;  // derivative of PointInPlane()
  for (int k = 0; k < kLineTangentSize; ++k) {
    d_end.col(k) = across.cross(J.d_moment.col(k)) - end * across.dot(J.d_direction.col(k));
  }
  const Eigen::RowVector4d d_depth = d_end.row(2) / across.dot(plucker.direction);
  return std::sqrt((d_depth * covariance * d_depth.transpose()).value()) / std::abs(end.z());
}

// Returns the normal of the plane through the camera and an end point, perpendicular to the
// segment.
Eigen::Vector3d PlaneAcross(const Eigen::Vector2d& end_point, const SegmentEndPoints& segment) {
  const Eigen::Vector2d along = segment.end - segment.start;
  const Eigen::Vector3d across(-along.y(), along.x(), 0);
  return end_point.homogeneous().cross(across);
}

bool IsDepthKnown(const LineTriangulationOptions& options, const LineFit& fit,
                  const SegmentEndPoints& segment) {
  const LineEnds ends = EndsOf(ToPlucker(fit.line.data()), segment);
  const Matrix4d covariance = InverseOfSymmetric(fit.information);
  const double start =
      DepthDeviation(covariance, fit.line, PlaneAcross(segment.start, segment), ends.start);
  const double end =
      DepthDeviation(covariance, fit.line, PlaneAcross(segment.end, segment), ends.end);
  return start < options.max_depth_deviation && end < options.max_depth_deviation;
}

bool IsInFrontOfAll(const std::vector<PosedLineObservation>& observations, const Rigid3d& T_C0_W,
                    const OrthonormalLine& line) {
  const PluckerLine line_C0 = ToPlucker(line.data());
  for (const PosedLineObservation& observation : observations) {
    const Rigid3d T_C_C0 = (T_C0_W * observation.T_W_C).Inverse();
    if (!IsInFront(EndsOf(T_C_C0 * line_C0, observation.segment))) return false;
  }
  return true;
}

}  // namespace

LineEnds EndsOf(const PluckerLine& line_C, const SegmentEndPoints& segment) {
  return {PointInPlane(line_C, PlaneAcross(segment.start, segment)),
          PointInPlane(line_C, PlaneAcross(segment.end, segment))};
}

bool IsInFront(const LineEnds& ends_C) {
  return ends_C.start.z() > kMinTriangulatedDepth && ends_C.end.z() > kMinTriangulatedDepth;
}

TriangulatedLine TriangulateLine(const LineTriangulationOptions& options,
                                 const std::vector<PosedLineObservation>& observations) {
  TriangulatedLine triangulated;
  if (observations.size() < 2) return triangulated;
  const Rigid3d T_C0_W = observations.front().T_W_C.Inverse();
  std::vector<ViewingPlane> planes;
  planes.reserve(observations.size());
  for (const PosedLineObservation& observation : observations)
    planes.push_back(PlaneOf(observation, T_C0_W));
  const auto initial = BestIntersection(planes);
  if (!initial) return triangulated;
  const auto fit = FitLine(observations, options.noise, *initial);
  if (!fit || !IsDepthKnown(options, *fit, observations.front().segment)) {
    return triangulated;
  }
  triangulated.line = fit->line;
  const double mean_square = fit->cost / (2.0 * static_cast<double>(observations.size()));
  if (!IsInFrontOfAll(observations, T_C0_W, fit->line)) {
    triangulated.result = LineTriangulationResult::kBehind;
  } else if (mean_square > options.max_mean_error * options.max_mean_error) {
    triangulated.result = LineTriangulationResult::kInconsistent;
  } else {
    triangulated.result = LineTriangulationResult::kOk;
  }
  return triangulated;
}

}  // namespace plm_vins
