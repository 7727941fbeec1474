// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/wandering_lines.h"

#include <optional>

namespace plm_vins {
namespace {

constexpr double kMinSpread = 1.5;  // relative to the noise
constexpr double kMaxRatio = 0.25;  // of `difference` to `variance`; 1 if residuals are independent

}  // namespace

bool Wanders(const ViewSpread& spread, double noise) {
  return spread.variance > kMinSpread * kMinSpread * noise * noise &&
         spread.difference < kMaxRatio * spread.variance;
}

int NoteWandering(const SlidingWindow& window, double noise, LineMap* lines) {
  int found = 0;
  for (auto& [id, line] : lines->landmarks()) {
    if (line.wanders) continue;
    const std::optional<ViewSpread> spread = SpreadOf(line, window);
    line.wanders = spread && Wanders(*spread, noise);
    found += line.wanders;
  }
  return found;
}

}  // namespace plm_vins
