// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/depth_noise.h"

#include "simulator/random.h"

namespace plm_vins::simulator {

cv::Mat1w MeasureDepth(const cv::Mat1f& depth, const DepthSensor& sensor, uint64_t seed,
                       uint64_t index) {
  cv::Mat1w measured(depth.size(), ushort{0});
  for (int y = 0; y < depth.rows; ++y) {
    Random random(seed, index * depth.rows + y);
    for (int x = 0; x < depth.cols; ++x) {
      const double z = depth(y, x);
      const double noise = sensor.noise * z * z * random.Normal();
      if (z > sensor.max) continue;
      measured(y, x) = cv::saturate_cast<ushort>((z + noise) / sensor.unit);
    }
  }
  return measured;
}

}  // namespace plm_vins::simulator
