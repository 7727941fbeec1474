// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgproc.hpp>

#include "feature_tracker/point_tracking_stage.h"
#include "linefeature_tracker/line_tracking_stage.h"
#include "test/fuzz/target.h"

namespace plm_vins::fuzz {
namespace {

constexpr int kWidth = 96, kHeight = 64;

Config SmallCamera() {
  Config config;
  CameraParameters& camera = config.sensor.cameras[0].parameters;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = camera.fy = 80;
  camera.cx = 48;
  camera.cy = 32;
  return config;
}

// A moving box in front of noise.
cv::Mat Picture(int x) {
  cv::Mat picture(kHeight, kWidth, CV_8UC1);
  cv::RNG(1).fill(picture, cv::RNG::UNIFORM, 0, 40);
  cv::rectangle(picture, {x % 60, 12, 30, 30}, 200, cv::FILLED);
  return picture;
}

// Each image of an input: a byte for its kind (including four bits for its size), two for the step
// of its timestamp, then bytes that overwrite its pixels.
template <typename Stage>
void Track(const Bytes& bytes) {
  Stage stage(SmallCamera());
  Reader reader(bytes);
  int64_t t_ns = 1'000'000'000;
  for (int i = 0; !reader.empty() && i < 20; ++i) {
    const uint8_t kind = reader.Byte();
    t_ns += int64_t{reader.Value<int16_t>()} * 10'000;
    cv::Mat picture = Picture(2 * i);
    if (kind % 16 == 1) picture.release();
    if (kind % 16 == 2) cv::resize(picture, picture, {1 + kind, 1 + kind / 2});
    if (kind % 16 == 3) picture.setTo(kind);
    for (int damaged = kind % 8; damaged > 0 && !picture.empty(); --damaged) {
      const size_t at = reader.Value<uint16_t>() % picture.total();
      picture.data[at] = reader.Byte();
    }
    for (int sample = 0; sample < 10; ++sample) {
      stage.AddImu({t_ns - 50'000'000 + 5'000'000 * sample, {0.1, 0, 0}, {0, 0, 9.81}});
    }
    stage.AddImage(0, {t_ns, picture});
    while (stage.Pop()) {
    }
  }
  while (stage.Flush()) {
  }
}

Bytes Seed() {
  Bytes seed;
  for (int i = 0; i < 12; ++i) {
    for (const int byte : {i, 5000 % 256, 5000 / 256}) seed.push_back(static_cast<uint8_t>(byte));
    for (int k = 0; k < 3 * (i % 8); ++k) seed.push_back(static_cast<uint8_t>(31 * k));
  }
  return seed;
}

}  // namespace

Target PointTrackerTarget() { return {"points", {Seed()}, Track<PointTrackingStage>}; }
Target LineTrackerTarget() { return {"lines", {Seed()}, Track<LineTrackingStage>}; }

}  // namespace plm_vins::fuzz
