// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/g2o_writer.h"

#include <iomanip>

namespace plm_vins {
namespace {

constexpr double kLevelWeight = 1e6;  // information of roll and pitch [1/rad^2]

void WriteTransform(const LevelTransform& transform, std::ostream* stream) {
  const Eigen::Quaterniond q = transform.rotation();
  for (int i = 0; i < 3; ++i) *stream << ' ' << transform.translation(i);
  *stream << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w();
}

// Writes the upper triangle, row-major. The error of g2o is expressed in the axes of the measured
// `to`, that of LevelEdge in those of `from`. g2o's rotation error is the vector part of the
// quaternion: half the angle.
void WriteInformation(const LevelEdge& edge, std::ostream* stream) {
  Matrix4d from_axes_of_to = Matrix4d::Identity();
  from_axes_of_to.topLeftCorner<3, 3>() = edge.T_from_to.rotation().toRotationMatrix();
  const Matrix4d information4 =
      from_axes_of_to.transpose() * edge.covariance.inverse() * from_axes_of_to;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  information.topLeftCorner<3, 3>() = information4.topLeftCorner<3, 3>();
  information.topRightCorner<3, 1>() = 2 * information4.topRightCorner<3, 1>();
  information(3, 3) = information(4, 4) = kLevelWeight;
  information(5, 5) = 4 * information4(3, 3);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) *stream << ' ' << information(row, column);
  }
}

}  // namespace

void WriteG2o(const KeyframeMap& map, std::ostream* stream) {
  *stream << std::setprecision(9);
  for (int i = 0; i < map.graph.size(); ++i) {
    if (!map.graph.Has(i)) continue;
    *stream << "VERTEX_SE3:QUAT " << i;
    WriteTransform(map.graph.node(i), stream);
    *stream << '\n';
  }
  for (const LevelEdge& edge : map.graph.edges()) {
    *stream << "EDGE_SE3:QUAT " << edge.from << ' ' << edge.to;
    WriteTransform(edge.T_from_to, stream);
    WriteInformation(edge, stream);
    *stream << '\n';
  }
}

}  // namespace plm_vins
