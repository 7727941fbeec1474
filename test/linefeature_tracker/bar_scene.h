// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "test/linefeature_tracker/line_scene.h"

namespace plm_vins {

// A scene of bars with various directions, widths and lengths, distributed over the image.
inline LineScene BarScene(const CameraParameters& parameters) {
  LineScene scene(parameters, 110);
  cv::RNG random(3);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) {
      const Eigen::Vector2d center(70 + 122 * column, 65 + 117 * row);
      const double angle = random.uniform(0.0, M_PI);
      const double length = random.uniform(60.0, 95.0);
      const Eigen::Vector2d half = 0.5 * length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const int gray =
          random.uniform(0, 2) == 0 ? random.uniform(15, 70) : random.uniform(160, 240);
      scene.AddBar(center - half, center + half, random.uniform(14.0, 30.0), gray);
    }
  }
  return scene;
}

}  // namespace plm_vins
