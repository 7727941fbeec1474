// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/manhattan/line_directions.h"

#include "vins_estimator/geometry/line_fit.h"

namespace plm_vins {

std::vector<LineDirection> LineDirections(const SlidingWindow& window, const LineMap& lines,
                                          double noise) {
  std::vector<LineDirection> directions;
  for (const auto& [id, landmark] : lines.landmarks()) {
    if (!landmark.triangulated) continue;
    const auto fit = EvaluateLine(PosedOfHostCamera(landmark, window), noise, landmark.coordinates);
    if (!fit) continue;
    const PluckerLine line_W = LineInWorld(landmark, window);
    directions.push_back({id, line_W.direction.normalized(), DirectionDeviation(*fit)});
  }
  return directions;
}

void NameAxes(const ManhattanFrame& frame, const std::vector<LineDirection>& directions,
              LineMap* lines) {
  for (const LineDirection& direction : directions) {
    LineAxis& axis = lines->landmarks().at(direction.id).axis;
    if (frame.IsKnownWell(direction)) {
      axis = frame.AxisOf(direction);
    } else if (axis != LineAxis::kZ && !frame.R_W_M()) {
      axis = LineAxis::kFree;
    }
  }
}

}  // namespace plm_vins
