// SPDX-License-Identifier: BSD-3-Clause
// Sensor data at standstill: constant images, gravity and no rotation.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"
#include "common/measurements.h"

namespace plm_vins::testing {

inline Config StillConfig() {
  Config config;
  config.sensor.cameras[0].parameters.width = 320;
  config.sensor.cameras[0].parameters.height = 240;
  config.sensor.cameras[0].parameters.fx = config.sensor.cameras[0].parameters.fy = 200;
  config.sensor.cameras[0].parameters.cx = 160;
  config.sensor.cameras[0].parameters.cy = 120;
  config.points.max_cnt = 60;
  config.points.min_dist = 15;
  return config;
}

// A picture of random blobs with many corners.
inline cv::Mat StillPicture(cv::Size size = {320, 240}) {
  cv::Mat noise(size.height / 8, size.width / 8, CV_8UC1);
  cv::RNG generator(1);
  generator.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::Mat picture;
  cv::resize(noise, picture, size, 0, 0, cv::INTER_CUBIC);
  return picture;
}

// The body's x axis points up.
inline ImuSample StillImu(int64_t t_ns) {
  return {t_ns, Eigen::Vector3d::Zero(), Eigen::Vector3d(9.81, 0, 0)};
}

}  // namespace plm_vins::testing
