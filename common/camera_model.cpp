// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera_model.h"

#include <cmath>
#include <stdexcept>

#include "common/camera_models/kannala_brandt.h"
#include "common/camera_models/mei.h"
#include "common/camera_models/pinhole_radtan.h"

namespace plm_vins {
namespace {

void Check(const CameraParameters& p) {
  const Eigen::Vector4d intrinsics(p.fx, p.fy, p.cx, p.cy);
  if (!intrinsics.allFinite() || !p.distortion.allFinite() || !std::isfinite(p.xi)) {
    throw std::invalid_argument("camera model: every parameter must be a finite number");
  }
  if (p.fx <= 0 || p.fy <= 0) {
    throw std::invalid_argument("camera model: focal lengths must be positive");
  }
  if (p.xi < 0) throw std::invalid_argument("camera model: xi must not be negative");
}

}  // namespace

std::unique_ptr<const CameraModel> CameraModel::Create(const CameraParameters& parameters) {
  Check(parameters);
  switch (parameters.model) {
    case CameraParameters::Model::kPinholeRadtan:
      return std::make_unique<PinholeRadtan>(parameters);
    case CameraParameters::Model::kPinholeEquidistant:
      return std::make_unique<KannalaBrandt>(parameters);
    case CameraParameters::Model::kMei:
      return std::make_unique<Mei>(parameters);
  }
  throw std::invalid_argument("camera model: unknown model");
}

}  // namespace plm_vins
