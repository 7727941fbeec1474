// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/monitoring/lens_monitor.h"

#include <algorithm>
#include <cmath>

#include "common/format.h"

namespace plm_vins {
namespace {

constexpr double kBinWidth_px = 0.01;
constexpr int64_t kMinInRing = 100;  // residuals, for a median
constexpr int64_t kMinInAll = 1000;
constexpr double kQuartilesOfNormal = 1.349;  // distance of the quartiles, in standard deviations
constexpr double kMedianOfNormal = 1.253;     // standard error of the median over the mean's
// A landmark has residuals in several keyframes at nearly the same place; so many count as one.
constexpr double kViewsPerSample = 3;
constexpr double kSignificant = 2;        // standard errors, of the median of one ring
constexpr double kLargestBias_px = 0.02;  // root mean square over the rings

double StandardError(const ResidualRing& ring) {
  return kMedianOfNormal * ring.deviation_px *
         std::sqrt(kViewsPerSample / static_cast<double>(ring.count));
}

// Returns the square of the part of a ring's median that exceeds chance.
double Excess(const ResidualRing& ring) {
  const double chance = kSignificant * StandardError(ring);
  return std::max(0.0, ring.radial_px * ring.radial_px - chance * chance);
}

std::string ToString(const ResidualRing& ring) {
  return Format("%+.2f px at %.0f px", ring.radial_px, 0.5 * (ring.inner_px + ring.outer_px));
}

}  // namespace

// Interpolates within a bin.
double LensMonitor::Histogram::Quantile(double share) const {
  const double wanted = share * static_cast<double>(total);
  double before = 0;
  int bin = 0;
  while (bin < kBins - 1 && before + static_cast<double>(counts[bin]) < wanted) {
    before += static_cast<double>(counts[bin++]);
  }
  const double within =
      counts[bin] > 0 ? (wanted - before) / static_cast<double>(counts[bin]) : 0.5;
  return kBinWidth_px * (bin - kBins / 2 - 0.5 + within);
}

LensMonitor::LensMonitor(const CameraParameters& camera)
    : is_equidistant_(camera.model == CameraParameters::Model::kPinholeEquidistant),
      center_px_(camera.cx, camera.cy) {
  const Eigen::Vector2d size(camera.width, camera.height);
  width_px_ = center_px_.cwiseMax(size - center_px_).norm() / kRings;
}

void LensMonitor::Add(const std::vector<PixelResidual>& residuals) {
  for (const PixelResidual& residual : residuals) {
    const Eigen::Vector2d from_center = residual.uv_px - center_px_;
    const double radius = from_center.norm();
    if (!(radius > 0)) continue;
    const double bins = residual.error_px.dot(from_center) / (radius * kBinWidth_px);
    const double farthest = kBins / 2;
    const int bin =
        kBins / 2 + static_cast<int>(std::lround(std::clamp(bins, -farthest, farthest)));
    Histogram& ring = rings_[std::min(static_cast<int>(radius / width_px_), kRings - 1)];
    ++ring.counts[bin];
    ++ring.total;
  }
  if (!residuals.empty()) warning_ = Judge();
}

std::vector<ResidualRing> LensMonitor::Rings() const {
  std::vector<ResidualRing> rings;
  for (int i = 0; i < kRings; ++i) {
    ResidualRing ring{i * width_px_, (i + 1) * width_px_, rings_[i].total};
    if (ring.count > 0) {
      ring.radial_px = rings_[i].Quantile(0.5);
      ring.deviation_px =
          (rings_[i].Quantile(0.75) - rings_[i].Quantile(0.25)) / kQuartilesOfNormal;
    }
    rings.push_back(ring);
  }
  return rings;
}

std::string LensMonitor::Judge() const {
  std::vector<ResidualRing> rings = Rings();
  const auto is_small = [](const ResidualRing& ring) { return ring.count < kMinInRing; };
  rings.erase(std::remove_if(rings.begin(), rings.end(), is_small), rings.end());
  double sum = 0, count = 0;
  for (const ResidualRing& ring : rings) {
    sum += static_cast<double>(ring.count) * Excess(ring);
    count += static_cast<double>(ring.count);
  }
  if (count < kMinInAll || sum <= count * kLargestBias_px * kLargestBias_px) return "";
  const auto [inwards, outwards] = std::minmax_element(
      rings.begin(), rings.end(),
      [](const ResidualRing& a, const ResidualRing& b) { return a.radial_px < b.radial_px; });
  return "residuals of points depend on the distance from the image center (" + ToString(*inwards) +
         ", " + ToString(*outwards) +
         "): the focal length or the distortion model does not fit; recalibrate" +
         (is_equidistant_ ? "" : " with an equidistant (fisheye) model");
}

}  // namespace plm_vins
