// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "common/camera/camera_model.h"
#include "common/geometry/rigid3.h"
#include "simulator/rendering/scene.h"

namespace plm_vins::simulator {

// Draws a scene through a calibrated lens: rays through each pixel, tabulated once, against the
// rectangles whose bounds overlap the pixel's tile. The number of threads does not change a bit.
class Renderer {
 public:
  // Halves of each pixel's samples, to be taken in turn; together they cover it.
  static constexpr int kSubpixels = 2;
  // Rays of each half that look for surfaces; what they find is shaded once.
  static constexpr int kRays = 8;

  // Sizes of tiles [px]: square ones are drawn fastest; those of one row let each row be drawn from
  // a place of its own.
  static constexpr int kTilePixels = 256;
  static cv::Size SquareTile() { return {16, 16}; }
  static cv::Size RowTile() { return {kTilePixels, 1}; }

  // The scene must outlive the renderer. A tile has at most kTilePixels.
  Renderer(const Scene& scene, std::shared_ptr<const CameraModel> camera,
           const cv::Size& tile = SquareTile());

  // Adds the brightness of one half of each pixel to `sum` (CV_32F). A white wall in full light has
  // a brightness of 1.
  void Accumulate(const Rigid3d& T_W_C, int subpixel, cv::Mat1f* sum) const;

  // The same with a pose for the top row of each row of tiles. `T_W_C` is called by many threads.
  void AccumulateByRows(const std::function<Rigid3d(int row)>& T_W_C, int subpixel,
                        cv::Mat1f* sum) const;

 private:
  static constexpr int kRaysPerTile = kRays * kTilePixels;

  // Rays (x, y, 1) of one half of a tile's samples: the first ray of all pixels, the second, ...
  // NaN where the lens has none.
  struct RayTile {
    RayTile() { x.fill(std::numeric_limits<float>::quiet_NaN()); }
    void SetRay(int index, const Eigen::Vector2d& xy);

    cv::Rect pixels;
    std::array<float, kRaysPerTile> x, y{};
    // Bounds of the rays.
    Eigen::Vector2f min = Eigen::Vector2f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Vector2f max = -min;
  };
  struct VisibleRectangle;

  void AddTile(const cv::Rect& pixels);
  std::vector<VisibleRectangle> FindVisible(const Rigid3d& T_W_C) const;
  static bool Overlaps(const RayTile& tile, const VisibleRectangle& rectangle);
  void RenderTile(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                  cv::Mat1f* sum) const;
  float ShadePixel(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                   const std::array<int, kRaysPerTile>& surface, int pixel) const;
  float Shade(const VisibleRectangle& surface, float x, float y) const;

  const Scene& scene_;
  std::shared_ptr<const CameraModel> camera_;
  int tiles_per_row_;
  std::vector<RayTile> tiles_[kSubpixels];  // row by row
};

}  // namespace plm_vins::simulator
