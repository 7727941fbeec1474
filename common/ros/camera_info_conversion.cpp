// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/camera_info_conversion.h"

#include <sensor_msgs/distortion_models.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "common/ros/geometry_conversion.h"

namespace plm_vins {
namespace {

using Model = CameraParameters::Model;

const std::array<std::pair<Model, std::string>, 3> kModels = {
    {{Model::kPinholeRadtan, sensor_msgs::distortion_models::PLUMB_BOB},
     {Model::kPinholeEquidistant, sensor_msgs::distortion_models::EQUIDISTANT},
     {Model::kMei, "mei"}}};

const std::string& NameOf(Model model) {
  for (const auto& [known, name] : kModels) {
    if (known == model) return name;
  }
  throw std::logic_error("a camera model without a name");
}

Model ModelOf(const std::string& name) {
  for (const auto& [model, known] : kModels) {
    if (known == name) return model;
  }
  throw std::invalid_argument("CameraInfo has the distortion model \"" + name +
                              "\"; supported are plumb_bob, equidistant and mei");
}

// Number of coefficients in D: radtan has an unused k3, and MEI has xi.
size_t CoefficientsOf(Model model) { return model == Model::kPinholeEquidistant ? 4 : 5; }

}  // namespace

sensor_msgs::CameraInfo ToCameraInfo(const CameraParameters& camera, int64_t t_ns,
                                     const std::string& frame_id) {
  sensor_msgs::CameraInfo message;
  message.header = MakeHeader(t_ns, frame_id);
  message.width = camera.width;
  message.height = camera.height;
  message.distortion_model = NameOf(camera.model);
  message.D.assign(camera.distortion.data(), camera.distortion.data() + camera.distortion.size());
  if (CoefficientsOf(camera.model) > message.D.size()) message.D.push_back(camera.xi);
  message.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  message.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  message.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return message;
}

CameraParameters ToCameraParameters(const sensor_msgs::CameraInfo& message) {
  CameraParameters camera;
  camera.model = ModelOf(message.distortion_model);
  if (message.D.size() < CoefficientsOf(camera.model)) {
    throw std::invalid_argument("CameraInfo has too few distortion coefficients for " +
                                message.distortion_model);
  }
  camera.width = static_cast<int>(message.width);
  camera.height = static_cast<int>(message.height);
  camera.fx = message.K[0];
  camera.cx = message.K[2];
  camera.fy = message.K[4];
  camera.cy = message.K[5];
  camera.distortion = Eigen::Map<const Eigen::Vector4d>(message.D.data());
  if (camera.model == Model::kMei) camera.xi = message.D[4];
  return camera;
}

}  // namespace plm_vins
