// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/wandering_lines.h"

#include <optional>

namespace plm_vins {
namespace {

constexpr double kMinSpread = 1.5;  // in units of the noise
constexpr double kMaxRatio = 0.25;  // of steps to spread; independent views: 1

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
