// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "common/config/config.h"
#include "simulator/rendering/renderer.h"
#include "simulator/trajectory.h"

namespace plm_vins::simulator {

struct ImagingOptions {
  double exposure = 0.006;    // [s]
  double readout = 0;         // rolling shutter, top to bottom; 0 for a global shutter [s]
  double full_scale = 0.78;   // brightness that saturates a pixel
  double lens_blur_px = 0.6;  // standard deviation of the point spread function
  double vignetting = 0.35;   // relative loss of light in the image corners
  double read_noise = 1.2;    // standard deviation [gray levels]
  double shot_noise = 0.25;   // standard deviation at one gray level; grows with its square root
  bool add_noise = true;
  uint64_t seed = 1;
};

// Simulates a camera on the trajectory with lens distortion, motion blur, vignetting and noise.
class CameraSimulator {
 public:
  // The trajectory and the scene must outlive the camera.
  CameraSimulator(const Trajectory& trajectory, const Scene& scene, const CameraParameters& camera,
                  const Rigid3d& T_B_C, const ImagingOptions& options);

  // Renders image `index`, which seeds the noise. Its exposure (with a rolling shutter, that of the
  // middle row) is centered `t` seconds after the start.
  cv::Mat Expose(double t, uint64_t index) const;

  // Returns the exact depth (Renderer::Depth) of all rows at `t` seconds after the start.
  cv::Mat1f Depth(double t) const { return renderer_.Depth(trajectory_.At(t).T_W_B * T_B_C_); }

 private:
  void Accumulate(double t, int subpixel, cv::Mat1f* sum) const;
  int ExposureSteps(double t) const;
  cv::Mat1f VignettingGain() const;
  cv::Mat Digitize(const cv::Mat1f& brightness, uint64_t index) const;

  const Trajectory& trajectory_;
  std::shared_ptr<const CameraModel> camera_;
  Rigid3d T_B_C_;
  ImagingOptions options_;
  Renderer renderer_;
  cv::Mat1f gain_;  // gray levels per unit of brightness
};

}  // namespace plm_vins::simulator
