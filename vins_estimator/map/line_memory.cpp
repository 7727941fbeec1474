// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/map/line_memory.h"

#include <algorithm>

#include "vins_estimator/map/landmark_map.h"

namespace plm_vins {
namespace {

constexpr double kMuchLessCertain = 2.0;  // ratio of standard deviations

// Extends `line` to the endpoints of `other`.
SeenLine Prolonged(const SeenLine& line, const SeenLine& other) {
  const Eigen::Vector3d along = line.Direction();
  const auto place = [&](const Eigen::Vector3d& end) { return along.dot(end - line.start_F); };
  const auto [low, high] =
      std::minmax({0.0, place(line.end_F), place(other.start_F), place(other.end_F)});
  SeenLine prolonged = line;
  prolonged.start_F = line.start_F + low * along;
  prolonged.end_F = line.start_F + high * along;
  return prolonged;
}

}  // namespace

void LineMemory::Keep(int64_t id, const SeenLine& line_W) {
  const auto [place, is_new] = lines_.try_emplace(id);
  RememberedLine& known = place->second;
  known.note = ++notes_;
  if (is_new) {
    known.seen_W = line_W;
    if (lines_.size() > kCapacity) ForgetLeastRecent();
  } else if (line_W.place_sigma > kMuchLessCertain * known.seen_W.place_sigma) {
    known.seen_W = Prolonged(known.seen_W, line_W);
  } else {
    known.seen_W = Prolonged(line_W, known.seen_W);
  }
}

void LineMemory::KeepObservation(int64_t id, const LineLandmark::Observation& anchor_view) {
  const auto line = lines_.find(id);
  if (line != lines_.end()) AddAnchorObservation(anchor_view, &line->second.anchor_observations);
}

void LineMemory::Join(int64_t newer, int64_t older) {
  const auto joined = lines_.extract(newer);
  if (joined.empty()) return;
  Keep(older, joined.mapped().seen_W);
  for (const LineLandmark::Observation& observation : joined.mapped().anchor_observations)
    KeepObservation(older, observation);
}

void LineMemory::ChangeObservations(const std::function<void(LineLandmark::Observation*)>& change) {
  for (auto& [id, line] : lines_) {
    for (LineLandmark::Observation& observation : line.anchor_observations) change(&observation);
  }
}

void LineMemory::RemoveAnchor(int64_t t_ns) {
  for (auto& [id, line] : lines_) RemoveObservationsIn(t_ns, &line.anchor_observations);
}

const RememberedLine* LineMemory::Find(int64_t id) const {
  const auto line = lines_.find(id);
  return line == lines_.end() ? nullptr : &line->second;
}

void LineMemory::ForgetLeastRecent() {
  lines_.erase(std::min_element(lines_.begin(), lines_.end(), [](const auto& a, const auto& b) {
    return a.second.note < b.second.note;
  }));
}

}  // namespace plm_vins
