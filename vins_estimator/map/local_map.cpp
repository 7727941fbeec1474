// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/local_map.h"

#include <utility>

#include "vins_estimator/map/line_comparison.h"

namespace plm_vins {
namespace {

constexpr double kMaxPlaceSigma = 0.2;  // [m]: a less certain line could not be recognized

}  // namespace

void LocalMap::AddFrame(WindowFrame frame, const PointFrame& point_frame,
                        const std::optional<LineFrame>& line_frame) {
  points.AddFrame(point_frame, frame.cut_time_offset);
  if (line_frame) lines.AddFrame(aliases.Redirect(*line_frame));
  window.frames.push_back(std::move(frame));
}

void LocalMap::DropSecondNewest() {
  const int64_t dropped_ns = window.second_newest().state.t_ns;
  points.RemoveFrame(window, dropped_ns);
  lines.RemoveFrame(window, dropped_ns);
  window.RemoveSecondNewest();
}

DepartedLandmarks LocalMap::SlideOldest(bool stays_as_anchor) {
  const int64_t oldest_ns = window.frames.front().state.t_ns;
  if (options.remember_lines) RememberDeparting(oldest_ns, stays_as_anchor);
  DepartedLandmarks departed;
  points.Reinitialize(window, oldest_ns, [&](const PointLandmark& point) {
    departed.points.push_back({point.id, PositionInWorld(point, window)});
  });
  lines.Reinitialize(window, oldest_ns, [&](const LineLandmark& line) {
    if (const auto segment = DepartingSegment(line)) departed.lines.push_back(*segment);
  });
  points.RemoveFrame(window, oldest_ns);
  lines.RemoveFrame(window, oldest_ns);
  if (stays_as_anchor) {
    window.TurnOldestIntoAnchor();
  } else {
    window.RemoveOldest();
  }
  return departed;
}

void LocalMap::RemoveAnchor(int64_t t_ns) {
  lines.RemoveAnchor(t_ns);
  memory.RemoveAnchor(t_ns);
  window.RemoveAnchor(t_ns);
}

void LocalMap::AbsorbLine(int64_t newer, const LineLandmark& joint) {
  lines.landmarks().at(joint.id) = joint;
  lines.landmarks().erase(newer);
  memory.Join(newer, joint.id);
  aliases.Add(newer, joint.id);
}

void LocalMap::ReviveLine(int64_t newer, int64_t older) {
  auto landmark = lines.landmarks().extract(newer);
  landmark.key() = landmark.mapped().id = older;
  landmark.mapped().anchor_observations = memory.lines().at(older).anchor_observations;
  lines.landmarks().insert(std::move(landmark));
  aliases.Add(newer, older);
}

void LocalMap::ForgetIdleAliases() {
  aliases.RemoveUnless([this](int64_t id) { return lines.landmarks().count(id) > 0; });
}

// Stores the lines that are marginalized with a frame in the memory.
void LocalMap::RememberDeparting(int64_t frame_ns, bool stays_as_anchor) {
  for (const auto& [id, landmark] : lines.landmarks()) {
    if (!LeavesWith(frame_ns, landmark) || !landmark.triangulated) continue;
    const auto seen_W = See(window, Eigen::Quaterniond::Identity(), options.line_noise, landmark);
    if (seen_W && HasEnoughObservations(landmark) && seen_W->place_sigma < kMaxPlaceSigma) {
      memory.Keep(id, *seen_W);
    }
    if (stays_as_anchor) memory.KeepObservation(id, landmark.host());
  }
}

// Returns the whole observed segment of a line, since its first observation.
std::optional<MapLine> LocalMap::DepartingSegment(const LineLandmark& line) const {
  const RememberedLine* known = memory.Find(line.id);
  if (known == nullptr) return ObservedSegment(line, window);
  return MapLine{line.id, known->seen_W.start_F, known->seen_W.end_F, line.axis};
}

void DescribeMap(const LocalMap& map, EstimatorOutput* output) {
  const SlidingWindow& window = map.window;
  output->state = window.newest().state;
  output->stationary = window.newest().stationary;
  output->window.reserve(window.frames.size());
  for (const WindowFrame& frame : window.frames) output->window.push_back(frame.state);
  output->points = map.points.Optimized(window);
  output->lines = map.lines.Optimized(window);
}

}  // namespace plm_vins
