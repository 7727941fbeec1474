// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/rendering/camera_simulator.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/camera/camera_model.h"
#include "simulator/random.h"

namespace plm_vins::simulator {

CameraSimulator::CameraSimulator(const Trajectory& trajectory, const Scene& scene,
                                 const CameraParameters& camera, const Rigid3d& T_B_C,
                                 const ImagingOptions& options)
    : trajectory_(trajectory),
      camera_(CameraModel::Create(camera)),
      T_B_C_(T_B_C),
      options_(options),
      renderer_(scene, camera_, options.readout > 0 ? Renderer::RowTile() : Renderer::SquareTile()),
      gain_(VignettingGain()) {}

cv::Mat CameraSimulator::Expose(double t, uint64_t index) const {
  cv::Mat1f sum(gain_.size(), 0.0f);
  const int steps = ExposureSteps(t);
  for (int i = 0; i < steps; ++i) {
    const double offset = ((i + 0.5) / steps - 0.5) * options_.exposure;
    Accumulate(t + offset, i % Renderer::kSubpixels, &sum);
  }
  if (options_.lens_blur_px > 0) {
    cv::GaussianBlur(sum, sum, cv::Size(5, 5), options_.lens_blur_px, 0, cv::BORDER_REPLICATE);
  }
  return Digitize(sum.mul(gain_, 1.0 / steps), index);
}

// Adds the scene at one instant; with a rolling shutter, at one instant for each row.
void CameraSimulator::Accumulate(double t, int subpixel, cv::Mat1f* sum) const {
  if (options_.readout > 0) {
    const auto T_W_C = [&](int row) {
      const double delay = options_.readout * ReadoutShare(row, camera_->parameters().height);
      return trajectory_.At(t + delay).T_W_B * T_B_C_;
    };
    renderer_.AccumulateByRows(T_W_C, subpixel, sum);
  } else {
    renderer_.Accumulate(trajectory_.At(t).T_W_B * T_B_C_, subpixel, sum);
  }
}

// Number of exposure steps such that the image moves by about a pixel between them; a multiple of
// the number of subpixels.
int CameraSimulator::ExposureSteps(double t) const {
  constexpr double kTypicalDistance = 3.0;  // [m]
  constexpr int kMaxRounds = 6;
  const BodyState state = trajectory_.At(t);
  const double rate = state.gyro_B.norm() + state.v_W.norm() / kTypicalDistance;
  const double blur_px = rate * options_.exposure * camera_->FocalLength();
  const int rounds = static_cast<int>(std::ceil(blur_px / Renderer::kSubpixels));
  return Renderer::kSubpixels * std::clamp(rounds, 1, kMaxRounds);
}

cv::Mat1f CameraSimulator::VignettingGain() const {
  const CameraParameters& camera = camera_->parameters();
  cv::Mat1f gain(camera.height, camera.width);
  const double corner_squared =
      0.25 * (camera.width * camera.width + camera.height * camera.height);
  for (int y = 0; y < gain.rows; ++y) {
    for (int x = 0; x < gain.cols; ++x) {
      const double dx = x - 0.5 * camera.width, dy = y - 0.5 * camera.height;
      const double loss = options_.vignetting * (dx * dx + dy * dy) / corner_squared;
      gain(y, x) = static_cast<float>(255.0 / options_.full_scale * (1.0 - loss));
    }
  }
  return gain;
}

cv::Mat CameraSimulator::Digitize(const cv::Mat1f& brightness, uint64_t index) const {
  cv::Mat1b image(brightness.size());
  cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      Random random(options_.seed, index * image.rows + y);  // rows must not depend on threads
      for (int x = 0; x < image.cols; ++x) {
        const double value = brightness(y, x);
        const double variance = options_.read_noise * options_.read_noise +
                                options_.shot_noise * options_.shot_noise * value;
        const double noise = options_.add_noise ? std::sqrt(variance) * random.Normal() : 0.0;
        image(y, x) = cv::saturate_cast<uchar>(value + noise);
      }
    }
  });
  return image;
}

}  // namespace plm_vins::simulator
