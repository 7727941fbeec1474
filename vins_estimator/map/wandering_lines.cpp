// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/wandering_lines.h"

#include <vector>
namespace plm_vins {
namespace {

constexpr size_t kMinViews = 6;     // fewer show no trend
constexpr double kMinSpread = 1.5;  // in units of the noise
constexpr double kMaxRatio = 0.25;  // of steps to spread; independent views: 1

bool Wanders(const LineLandmark& line, const SlidingWindow& window, double noise) {
  if (line.wanders || !line.triangulated || line.views.size() < kMinViews) return false;
  const std::vector<Eigen::Vector2d> residuals = ResidualsOf(line, window);
  return residuals.size() >= kMinViews && Wanders(SpreadOf(residuals, kLineParameters), noise);
}

}  // namespace

bool Wanders(const ViewSpread& spread, double noise) {
  return spread.variance > kMinSpread * kMinSpread * noise * noise &&
         spread.difference < kMaxRatio * spread.variance;
}

int NoteWandering(const SlidingWindow& window, double noise, LineMap* lines) {
  int found = 0;
  for (auto& [id, line] : lines->landmarks()) {
    if (!Wanders(line, window, noise)) continue;
    line.wanders = true;
    ++found;
  }
  return found;
}

}  // namespace plm_vins
