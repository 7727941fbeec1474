// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "common/camera_model.h"
#include "common/rigid3.h"
#include "simulator/rendering/scene.h"

namespace plm_vins::simulator {

// Draws a scene through a calibrated lens: a ray per image sample, tabulated once, against the
// rectangles whose bounds overlap the sample's tile. The number of threads does not change a bit.
class Renderer {
 public:
  // Sample positions within a pixel, taken in turn; together they smooth edges.
  static constexpr int kSubpixels = 4;

  // The scene must outlive the renderer.
  Renderer(const Scene& scene, std::shared_ptr<const CameraModel> camera);

  // Adds the brightness (1 is a white wall in full light) of one sample per pixel to `sum`
  // (CV_32F).
  void Accumulate(const Rigid3d& T_W_C, int subpixel, cv::Mat1f* sum) const;

 private:
  static constexpr int kTileSize = 16;  // [px]

  // Rays (x, y, 1) of a tile's pixels; NaN where the lens has none.
  struct RayTile {
    cv::Rect pixels;
    Eigen::Vector2f min, max;  // bounds of the rays
    std::vector<float> x, y;
  };
  struct VisibleRectangle;

  RayTile MakeTile(const cv::Rect& pixels, const Eigen::Vector2d& offset_px) const;
  std::vector<VisibleRectangle> FindVisible(const Rigid3d& T_W_C) const;
  static bool Overlaps(const RayTile& tile, const VisibleRectangle& rectangle);
  void RenderTile(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                  cv::Mat1f* sum) const;
  float Shade(const VisibleRectangle& surface, float x, float y) const;

  const Scene& scene_;
  std::shared_ptr<const CameraModel> camera_;
  std::vector<RayTile> tiles_[kSubpixels];
};

}  // namespace plm_vins::simulator
