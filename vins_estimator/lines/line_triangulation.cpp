// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/lines/line_triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace plm_vins {
namespace {

using Matrix4d = Eigen::Matrix4d;
using Matrix34d = Eigen::Matrix<double, 3, kLineTangentSize>;

constexpr double kMinDepth = 0.1;  // [m]
constexpr int kRefinements = 5;

// The plane through a camera and the segment that it sees, normal . (x - camera) = 0, in the frame
// of the first camera.
struct ViewingPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of length 1
  double offset = 0;                                 // normal . camera
  double deviation = 0;  // of the normal's angle about the line of sight, for unit noise
};

ViewingPlane PlaneOf(const LineSighting& sighting, const Rigid3d& T_C0_W) {
  const Rigid3d T_C0_C = T_C0_W * sighting.T_W_C;
  const LineSegmentView& segment = sighting.segment;
  ViewingPlane plane;
  plane.normal =
      (T_C0_C.rotation * segment.start.homogeneous().cross(segment.end.homogeneous())).normalized();
  plane.offset = plane.normal.dot(T_C0_C.translation);
  plane.deviation = M_SQRT2 / (segment.end - segment.start).norm();
  return plane;
}

// The intersection of the two planes at the widest angle in terms of their noise.
std::optional<OrthonormalLine> BestIntersection(const std::vector<ViewingPlane>& planes) {
  double widest = 0;
  PluckerLine best;
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = i + 1; j < planes.size(); ++j) {
      const double sine = planes[i].normal.cross(planes[j].normal).norm();
      const double width = sine / std::hypot(planes[i].deviation, planes[j].deviation);
      if (!(width > widest)) continue;
      widest = width;
      best = Intersection(planes[i].normal, planes[i].offset, planes[j].normal, planes[j].offset);
    }
  }
  if (!(best.moment.norm() > 0 && best.direction.norm() > 0)) return std::nullopt;
  return ToOrthonormal(best);
}

// The least-squares problem of one line in all views, in units of the noise.
struct LineEquations {
  Matrix4d H = Matrix4d::Zero();
  Eigen::Vector4d g = Eigen::Vector4d::Zero();
  double cost = 0;  // sum of squares
};

std::optional<LineEquations> Linearize(const std::vector<LineSighting>& sightings,
                                       const Rigid3d& T_C0_W, double noise,
                                       const OrthonormalLine& line) {
  LineEquations equations;
  const PluckerLine line_C0 = ToPlucker(line.data());
  const PluckerJacobian plucker = ToPluckerJacobian(line.data());
  for (const LineSighting& sighting : sightings) {
    const Rigid3d T_C_C0 = (T_C0_W * sighting.T_W_C).Inverse();
    Eigen::Vector2d distances;
    Eigen::Matrix<double, 2, 3> d_distances;
    const Eigen::Vector3d moment = (T_C_C0 * line_C0).moment;
    if (!EndPointDistances(sighting.segment, moment, &distances, &d_distances)) return std::nullopt;
    Matrix34d d_moment;
    for (int k = 0; k < kLineTangentSize; ++k) {
      const PluckerLine column{plucker.d_moment.col(k), plucker.d_direction.col(k)};
      d_moment.col(k) = (T_C_C0 * column).moment;
    }
    const Eigen::Matrix<double, 2, kLineTangentSize> J = d_distances * d_moment / noise;
    equations.H += J.transpose() * J;
    equations.g += J.transpose() * distances / noise;
    equations.cost += distances.squaredNorm() / (noise * noise);
  }
  return equations;
}

// Gauss-Newton with a little damping; stops where a step makes it worse.
std::optional<LineEquations> Refine(const std::vector<LineSighting>& sightings,
                                    const Rigid3d& T_C0_W, double noise, OrthonormalLine* line) {
  auto equations = Linearize(sightings, T_C0_W, noise, *line);
  for (int i = 0; equations && i < kRefinements; ++i) {
    Matrix4d H = equations->H;
    H.diagonal() *= 1.0 + 1e-6;
    const Eigen::Vector4d step = -H.ldlt().solve(equations->g);
    if (!step.allFinite()) return std::nullopt;
    OrthonormalLine moved;
    LinePlus(line->data(), step.data(), moved.data());
    const auto next = Linearize(sightings, T_C0_W, noise, moved);
    if (!next || next->cost > equations->cost) break;
    *line = moved;
    equations = next;
  }
  return equations;
}

// Relative deviation of an end's depth in the camera of the line's frame.
double DepthDeviation(const Matrix4d& covariance, const OrthonormalLine& line,
                      const Eigen::Vector3d& across, const Eigen::Vector3d& end) {
  const PluckerLine plucker = ToPlucker(line.data());
  const PluckerJacobian J = ToPluckerJacobian(line.data());
  Matrix34d d_end;  // of PointInPlane()
  for (int k = 0; k < kLineTangentSize; ++k) {
    d_end.col(k) = across.cross(J.d_moment.col(k)) - end * across.dot(J.d_direction.col(k));
  }
  const Eigen::RowVector4d d_depth = d_end.row(2) / across.dot(plucker.direction);
  return std::sqrt((d_depth * covariance * d_depth.transpose()).value()) / std::abs(end.z());
}

// Normal of the plane through the camera and an end point, across the segment.
Eigen::Vector3d PlaneAcross(const Eigen::Vector2d& end_point, const LineSegmentView& segment) {
  const Eigen::Vector2d along = segment.end - segment.start;
  const Eigen::Vector3d across(-along.y(), along.x(), 0);
  return end_point.homogeneous().cross(across);
}

bool IsDepthKnown(const LineTriangulationOptions& options, const Matrix4d& H,
                  const OrthonormalLine& line, const LineSegmentView& segment) {
  const LineEnds ends = EndsOf(ToPlucker(line.data()), segment);
  const Matrix4d covariance = H.ldlt().solve(Matrix4d::Identity());
  const double start =
      DepthDeviation(covariance, line, PlaneAcross(segment.start, segment), ends.start);
  const double end = DepthDeviation(covariance, line, PlaneAcross(segment.end, segment), ends.end);
  return start < options.max_depth_deviation && end < options.max_depth_deviation;
}

bool IsInFrontOfAll(const std::vector<LineSighting>& sightings, const Rigid3d& T_C0_W,
                    const OrthonormalLine& line) {
  const PluckerLine line_C0 = ToPlucker(line.data());
  for (const LineSighting& sighting : sightings) {
    const Rigid3d T_C_C0 = (T_C0_W * sighting.T_W_C).Inverse();
    if (!IsInFront(EndsOf(T_C_C0 * line_C0, sighting.segment))) return false;
  }
  return true;
}

}  // namespace

LineEnds EndsOf(const PluckerLine& line_C, const LineSegmentView& segment) {
  return {PointInPlane(line_C, PlaneAcross(segment.start, segment)),
          PointInPlane(line_C, PlaneAcross(segment.end, segment))};
}

bool IsInFront(const LineEnds& ends_C) {
  return ends_C.start.z() > kMinDepth && ends_C.end.z() > kMinDepth;
}

TriangulatedLine TriangulateLine(const LineTriangulationOptions& options,
                                 const std::vector<LineSighting>& sightings) {
  TriangulatedLine triangulated;
  if (sightings.size() < 2) return triangulated;
  const Rigid3d T_C0_W = sightings.front().T_W_C.Inverse();
  std::vector<ViewingPlane> planes;
  planes.reserve(sightings.size());
  for (const LineSighting& sighting : sightings) planes.push_back(PlaneOf(sighting, T_C0_W));
  auto line = BestIntersection(planes);
  if (!line) return triangulated;
  const auto equations = Refine(sightings, T_C0_W, options.noise, &*line);
  if (!equations || !IsDepthKnown(options, equations->H, *line, sightings.front().segment)) {
    return triangulated;
  }
  triangulated.line = *line;
  const double mean_square = equations->cost / (2.0 * static_cast<double>(sightings.size()));
  if (!IsInFrontOfAll(sightings, T_C0_W, *line)) {
    triangulated.result = LineTriangulationResult::kBehind;
  } else if (mean_square > options.max_mean_error * options.max_mean_error) {
    triangulated.result = LineTriangulationResult::kInconsistent;
  } else {
    triangulated.result = LineTriangulationResult::kOk;
  }
  return triangulated;
}

}  // namespace plm_vins
