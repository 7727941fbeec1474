// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "simulator/random.h"

namespace plm_vins::simulator {

// Paints textures of materials. Sizes are in meters, brightness from 0 (black) to 1 (white).
// `detail` scales all contrast, from 0 (uniform) to 1 (richly textured).
class TexturePainter {
 public:
  TexturePainter(double texel, double detail, uint64_t seed)
      : texel_(texel), detail_(detail), random_(seed) {}

  cv::Mat1b Plain(double width, double height, double brightness);
  // Structures of all sizes, stains and scratches; darker toward the edges.
  cv::Mat1b Plaster(double width, double height, double brightness);
  // Bricks with plaster joints.
  cv::Mat1b Bricks(double width, double height, double brightness);
  cv::Mat1b Tiles(double width, double height, double brightness, double tile_size);
  // Wood with vertical grain.
  cv::Mat1b Wood(double width, double height, double brightness);
  cv::Mat1b Panels(double width, double height, double brightness, double panel_size);
  // A print with a light margin: a diagram, a picture or text.
  cv::Mat1b Poster(double width, double height);
  // Spines of books.
  cv::Mat1b Books(double width, double height);
  // A landscape behind glass.
  cv::Mat1b View(double width, double height);

 private:
  cv::Mat1f Canvas(double width, double height, double brightness) const;
  cv::Mat1f FractalNoise(const cv::Size& size, double coarsest, double finest, double stretch);
  cv::Point RandomPixel(const cv::Mat1f& canvas);
  void AddStains(cv::Mat1f* canvas);
  void DarkenEdges(cv::Mat1f* canvas) const;
  void DrawGrid(cv::Mat1f* canvas, double step_x, double step_y, double joint, bool running_bond,
                double joint_brightness, double variation);
  void DrawShapes(cv::Mat1f* canvas, int count);
  void DrawText(cv::Mat1f* canvas);
  int Pixels(double meters) const;

  double texel_;  // [m]
  double detail_;
  Random random_;
};

}  // namespace plm_vins::simulator
