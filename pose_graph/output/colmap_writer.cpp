// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/output/colmap_writer.h"

#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "common/io/output_file.h"
#include "pose_graph/keyframes/landmark_key.h"

namespace plm_vins {
namespace {

struct ColmapPoint {
  int64_t id = 0;
  Eigen::Vector3d p_M;
  std::vector<std::pair<int, size_t>> views;  // observations: keyframe number, corner index
};

std::map<LandmarkKey, ColmapPoint> CollectPoints(const KeyframeMap& map,
                                                 const std::vector<int>& keyframes) {
  std::map<LandmarkKey, ColmapPoint> points;
  for (const int i : keyframes) {
    const std::vector<DescribedCorner> corners = map.keyframes[i].CornersIn(0);
    for (size_t corner = 0; corner < corners.size(); ++corner) {
      const DescribedCorner& seen = corners[corner];
      if (!seen.p_O) continue;
      ColmapPoint& point = points[{map.keyframes[i].world, seen.track}];
      point.p_M = map.T_M_O(i) * seen.p_O->cast<double>();
      point.views.emplace_back(i, corner);
    }
  }
  int64_t id = 0;
  for (auto& [name, point] : points) point.id = ++id;
  return points;
}

// Writes a file of the model with `write(stream)`.
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

// Returns the camera model that projects the rays: COLMAP lacks MEI, which is replaced by an ideal
// pinhole.
std::unique_ptr<const CameraModel> WrittenCamera(CameraParameters camera) {
  if (camera.model == CameraParameters::Model::kMei) {
    camera.model = CameraParameters::Model::kPinholeRadtan;
    camera.distortion.setZero();
  }
  return CameraModel::Create(camera);
}

// Projects the ray instead of using the stored pixel: the keyframe's camera may have been another
// one, or may have been refined since. COLMAP's pixel coordinates start at the corner of the first
// pixel, ours at its center.
Eigen::Vector2d ToColmapPixel(const CameraModel& camera, const DescribedCorner& corner) {
  const auto uv_px = camera.Project(corner.xy.cast<double>().homogeneous());
  return uv_px.value_or(corner.uv_px.cast<double>()) + Eigen::Vector2d(0.5, 0.5);
}

// Image names by keyframe number: the timestamp, as in an ASL folder. The keyframe number is
// appended to a repeated timestamp, as in maps of several runs whose clocks start from zero.
std::map<int, std::string> ImageNames(const KeyframeMap& map, const std::vector<int>& keyframes) {
  std::map<int, std::string> names;
  std::set<int64_t> stamps;
  for (const int i : keyframes) {
    const int64_t t_ns = map.keyframes[i].t_ns;
    const bool is_new = stamps.insert(t_ns).second;
    names[i] = std::to_string(t_ns) + (is_new ? "" : "_" + std::to_string(i + 1)) + ".png";
  }
  return names;
}

void WriteImage(const CameraModel& camera, const KeyframeMap& map, int number,
                const std::string& name, const std::map<LandmarkKey, ColmapPoint>& points,
                std::ostream* stream) {
  const Keyframe& keyframe = map.keyframes[number];
  const Rigid3d T_C_M = map.T_M_C({number, 0}).Inverse();
  const Eigen::Quaterniond& q = T_C_M.rotation;
  *stream << number + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  for (int i = 0; i < 3; ++i) *stream << ' ' << T_C_M.translation(i);
  *stream << " 1 " << name << '\n';
  const char* space = "";
  for (const DescribedCorner& corner : keyframe.CornersIn(0)) {
    const Eigen::Vector2d uv = ToColmapPixel(camera, corner);
    const int64_t id = corner.p_O ? points.at({keyframe.world, corner.track}).id : -1;
    *stream << space << uv.x() << ' ' << uv.y() << ' ' << id;
    space = " ";
  }
  *stream << '\n';
}

void WritePoints(const std::map<LandmarkKey, ColmapPoint>& points, std::ostream* stream) {
  for (const auto& [name, point] : points) {
    *stream << point.id;
    for (int i = 0; i < 3; ++i) *stream << ' ' << point.p_M(i);
    *stream << " 128 128 128 0";  // color gray; the error is unknown
    for (const auto& [keyframe, corner] : point.views) {
      *stream << ' ' << keyframe + 1 << ' ' << corner;
    }
    *stream << '\n';
  }
}

}  // namespace

void WriteColmapModel(const std::string& folder, const CameraParameters& camera,
                      const KeyframeMap& map) {
  std::error_code error;  // an error is reported when the first file is opened
  std::filesystem::create_directories(folder, error);
  CameraParameters shifted = camera;
  shifted.cx += 0.5;
  shifted.cy += 0.5;
  const std::vector<int> keyframes = map.NumbersInMap();
  const std::map<LandmarkKey, ColmapPoint> points = CollectPoints(map, keyframes);
  WriteFile(folder, "cameras.txt", [&](std::ostream* stream) { WriteCamera(shifted, stream); });
  const std::unique_ptr<const CameraModel> written = WrittenCamera(camera);
  WriteFile(folder, "images.txt", [&](std::ostream* stream) {
    for (const auto& [i, name] : ImageNames(map, keyframes)) {
      WriteImage(*written, map, i, name, points, stream);
    }
  });
  WriteFile(folder, "points3D.txt", [&](std::ostream* stream) { WritePoints(points, stream); });
}

}  // namespace plm_vins
