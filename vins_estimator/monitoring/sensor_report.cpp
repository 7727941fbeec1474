// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/sensor_report.h"

#include <cmath>

#include "common/format.h"

namespace plm_vins {
namespace {

void Add(const std::string& fault, std::string* text) {
  if (!text->empty()) *text += "; ";
  *text += fault;
}

void Add(const CameraFaults& faults, std::string* text) {
  const std::string camera = Format("camera %d: ", faults.camera);
  if (const auto& misfit_px = faults.misfit_px) {
    Add(camera +
            Format("it deviates by %.1f px from its calibration and is not used; recalibrate it",
                   *misfit_px),
        text);
  }
  if (const auto& delay = faults.delay) {
    Add(camera + Format("it exposes %+.0f ms after camera 0", 1e3 * *delay), text);
  }
  if (const auto& baseline = faults.baseline; baseline && baseline->IsSignificant()) {
    Add(camera + Format("according to the IMU, its baseline is %.1f +- %.1f %% %s than configured",
                        100 * std::abs(baseline->error), 100 * baseline->deviation,
                        baseline->error > 0 ? "longer" : "shorter"),
        text);
  }
}

}  // namespace

std::string DescribeFaults(const std::vector<CameraFaults>& cameras, const DepthFaults& depth) {
  std::string text;
  for (const CameraFaults& camera : cameras) Add(camera, &text);
  if (const auto& scale = depth.scale; scale && scale->IsSignificant()) {
    Add(Format("depth_topic: according to the IMU, depths are %.1f +- %.1f %% too %s",
               100 * std::abs(scale->error), 100 * scale->deviation,
               scale->error > 0 ? "long" : "short"),
        &text);
  }
  if (const auto& delay = depth.delay) {
    Add(Format("depth_topic: depth images are %.0f ms %s than their timestamps, or not aligned to "
               "camera 0",
               1e3 * std::abs(*delay), *delay > 0 ? "older" : "newer"),
        &text);
  }
  return text;
}

}  // namespace plm_vins
