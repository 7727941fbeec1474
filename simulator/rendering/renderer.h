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

// Renders a scene through a calibrated lens by casting rays, tabulated for each pixel, against the
// rectangles whose bounds overlap the pixel's tile. Results do not depend on the number of threads.
class Renderer {
 public:
  // The samples of a pixel are divided into halves, used alternately; together they cover the
  // pixel.
  static constexpr int kSubpixels = 2;
  // Number of rays of each half; each surface that they hit is shaded once.
  static constexpr int kRays = 8;

  // Tile sizes [px]: square tiles are fastest; tiles of one row allow a camera pose for each row.
  static constexpr int kTilePixels = 256;
  static cv::Size SquareTile() { return {16, 16}; }
  static cv::Size RowTile() { return {kTilePixels, 1}; }

  // The scene must outlive the renderer. A tile has at most kTilePixels.
  Renderer(const Scene& scene, std::shared_ptr<const CameraModel> camera,
           const cv::Size& tile = SquareTile());

  // Adds the brightness of one half of each pixel's samples to `sum` (CV_32F). A fully lit white
  // wall has brightness 1.
  void Accumulate(const Rigid3d& T_W_C, int subpixel, cv::Mat1f* sum) const;

  // Renders each row of tiles with the pose of its top row. Multiple threads call `T_W_C`.
  void AccumulateByRows(const std::function<Rigid3d(int row)>& T_W_C, int subpixel,
                        cv::Mat1f* sum) const;

  // Returns the depth along the optical axis in the middle of each pixel [m]; 0 if no surface is
  // hit.
  cv::Mat1f Depth(const Rigid3d& T_W_C) const;

 private:
  static constexpr int kRaysPerTile = kRays * kTilePixels;

  // Rays (x, y, 1) of one half of a tile's samples: the first ray of all pixels, then the second,
  // ... NaN for pixels without a ray.
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
  // Returns the inverse depth of the rectangle along the ray (x, y, 1); 0 if the ray misses it.
  static float InverseDepth(const VisibleRectangle& rectangle, float x, float y);
  void FindDepth(size_t tile, const std::vector<VisibleRectangle>& visible, cv::Mat1f* depth) const;
  static bool Overlaps(const RayTile& tile, const VisibleRectangle& rectangle);
  void RenderTile(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                  cv::Mat1f* sum) const;
  float ShadePixel(const RayTile& tile, const std::vector<VisibleRectangle>& visible,
                   const std::array<int, kRaysPerTile>& surface, int pixel) const;
  float Shade(const VisibleRectangle& surface, float x, float y) const;

  const Scene& scene_;
  std::shared_ptr<const CameraModel> camera_;
  int tiles_per_row_;
  std::vector<RayTile> tiles_[kSubpixels];  // row-major
};

}  // namespace plm_vins::simulator
