// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/pixel_residuals.h"

namespace plm_vins {

std::vector<PixelResidual> PixelResiduals(const LocalMap& map, const ImageKey& image,
                                          const CameraParameters& configured) {
  const SlidingWindow& window = map.window;
  const auto model =
      CameraModel::Create(configured.With(window.cameras[image.camera].ray_intrinsics));
  const Rigid3d T_C_W = window.T_W_C(image).Inverse();
  std::vector<PixelResidual> residuals;
  for (const auto& [id, point] : map.points.landmarks()) {
    if (!IsOptimized(point)) continue;
    for (const PointLandmark::Observation& observation : point.observations) {
      if (!(observation == image)) continue;
      const auto observed = model->Project(window.AtState(observation.bearing).homogeneous());
      const auto predicted = model->Project(T_C_W * PositionInWorld(point, window));
      if (observed && predicted) residuals.push_back({*observed, *predicted - *observed});
    }
  }
  return residuals;
}

}  // namespace plm_vins
