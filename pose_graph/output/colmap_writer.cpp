// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/colmap_writer.h"

#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <map>
#include <ostream>
#include <system_error>
#include <utility>
#include <vector>

#include "common/io/output_file.h"

namespace plm_vins {
namespace {

// A landmark of the whole map: tracks count anew in each world.
using PointName = std::pair<int, int64_t>;  // world, track

struct ColmapPoint {
  int64_t id = 0;
  Eigen::Vector3d p_M;
  std::vector<std::pair<int, size_t>> views;  // keyframe, corner
};

// Those that are kept and have a place in the map.
std::vector<int> KeyframesInMap(const KeyframeMap& map) {
  const std::vector<bool> connected = map.graph.ConnectedWith(0);
  std::vector<int> numbers;
  for (int i = 0; i < map.graph.size(); ++i) {
    if (connected[i] && map.graph.Has(i)) numbers.push_back(i);
  }
  return numbers;
}

std::map<PointName, ColmapPoint> CollectPoints(const KeyframeMap& map,
                                               const std::vector<int>& keyframes) {
  std::map<PointName, ColmapPoint> points;
  for (const int i : keyframes) {
    const Keyframe& keyframe = map.keyframes[i];
    for (size_t corner = 0; corner < keyframe.corners.size(); ++corner) {
      const DescribedCorner& seen = keyframe.corners[corner];
      if (!seen.p_O) continue;
      ColmapPoint& point = points[{keyframe.world, seen.track}];
      point.p_M = map.T_M_O(i) * seen.p_O->cast<double>();
      point.views.emplace_back(i, corner);
    }
  }
  int64_t id = 0;
  for (auto& [name, point] : points) point.id = ++id;
  return points;
}

// Writes a file of the model by `write(stream)`.
template <typename Write>
void WriteFile(const std::string& folder, const std::string& name, const Write& write) {
  OutputFile file((std::filesystem::path(folder) / name).string());
  file.stream() << std::setprecision(9);
  write(&file.stream());
  file.Close();
}

void WriteCamera(const CameraParameters& camera, std::ostream* stream) {
  using Model = CameraParameters::Model;
  const char* model = camera.model == Model::kPinholeRadtan        ? "OPENCV"
                      : camera.model == Model::kPinholeEquidistant ? "OPENCV_FISHEYE"
                                                                   : "PINHOLE";
  *stream << "1 " << model << ' ' << camera.width << ' ' << camera.height << ' ' << camera.fx << ' '
          << camera.fy << ' ' << camera.cx << ' ' << camera.cy;
  for (int i = 0; i < 4 && camera.model != Model::kMei; ++i) *stream << ' ' << camera.distortion(i);
  *stream << '\n';
}

// COLMAP counts pixels from the corner of the image, we from the middle of the first pixel.
Eigen::Vector2d ToColmapPixel(const CameraParameters& camera, const DescribedCorner& corner) {
  const Eigen::Vector2d half(0.5, 0.5);
  if (camera.model != CameraParameters::Model::kMei) return corner.uv_px.cast<double>() + half;
  const Eigen::Vector2d xy = corner.xy.cast<double>();
  return Eigen::Vector2d(camera.fx * xy.x() + camera.cx, camera.fy * xy.y() + camera.cy) + half;
}

void WriteImage(const CameraParameters& camera, const KeyframeMap& map, int number,
                const std::map<PointName, ColmapPoint>& points, std::ostream* stream) {
  const Keyframe& keyframe = map.keyframes[number];
  const Rigid3d T_C_M = (map.T_M_O(number).ToRigid() * keyframe.T_O_C()).Inverse();
  const Eigen::Quaterniond& q = T_C_M.rotation;
  *stream << number + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  for (int i = 0; i < 3; ++i) *stream << ' ' << T_C_M.translation(i);
  *stream << " 1 " << keyframe.t_ns << ".png\n";
  const char* space = "";
  for (const DescribedCorner& corner : keyframe.corners) {
    const Eigen::Vector2d uv = ToColmapPixel(camera, corner);
    const int64_t id = corner.p_O ? points.at({keyframe.world, corner.track}).id : -1;
    *stream << space << uv.x() << ' ' << uv.y() << ' ' << id;
    space = " ";
  }
  *stream << '\n';
}

void WritePoints(const std::map<PointName, ColmapPoint>& points, std::ostream* stream) {
  for (const auto& [name, point] : points) {
    *stream << point.id;
    for (int i = 0; i < 3; ++i) *stream << ' ' << point.p_M(i);
    *stream << " 128 128 128 0";  // grey; the error is not known
    for (const auto& [keyframe, corner] : point.views) {
      *stream << ' ' << keyframe + 1 << ' ' << corner;
    }
    *stream << '\n';
  }
}

}  // namespace

void WriteColmapModel(const std::string& folder, const CameraParameters& camera,
                      const KeyframeMap& map) {
  std::error_code error;  // shows with the first file
  std::filesystem::create_directories(folder, error);
  CameraParameters shifted = camera;
  shifted.cx += 0.5;
  shifted.cy += 0.5;
  const std::vector<int> keyframes = KeyframesInMap(map);
  const std::map<PointName, ColmapPoint> points = CollectPoints(map, keyframes);
  WriteFile(folder, "cameras.txt", [&](std::ostream* stream) { WriteCamera(shifted, stream); });
  WriteFile(folder, "images.txt", [&](std::ostream* stream) {
    for (const int i : keyframes) WriteImage(camera, map, i, points, stream);
  });
  WriteFile(folder, "points3D.txt", [&](std::ostream* stream) { WritePoints(points, stream); });
}

}  // namespace plm_vins
