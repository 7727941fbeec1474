// SPDX-License-Identifier: BSD-3-Clause
// Frames with known poses and the lines observed in them, for tests of merging and recognition.
#pragma once

#include <memory>
#include <utility>

#include "vins_estimator/geometry/line_fit.h"
#include "vins_estimator/map/local_map.h"
#include "vins_estimator/merging/line_structure.h"
#include "vins_estimator/recall/anchor_policy.h"

namespace plm_vins::testing {

constexpr double kFocalLength = 460.0;
constexpr double kNoise = 1.0 / kFocalLength;
constexpr size_t kWindowSize = 10;

// Builds a local map of frames with known poses, as the estimator would.
class LineWindow {
 public:
  static SameLineLimits Limits() {
    EstimatorConfig config;
    config.line_noise = kNoise * kFocalLength;
    return {config, kFocalLength};
  }

  void AddFrame(const FrameState& state, const LineFrame& frame) {
    WindowFrame window_frame;
    window_frame.state = state;
    window_frame.motion_since_previous = std::make_shared<Preintegration>(ImuNoise(), ImuBias());
    map_.AddFrame(std::move(window_frame), PointFrame(), frame);
    map_.lines.Triangulate(map_.window, LineLimits(kNoise, /*max_length=*/20));
    Refit();
  }

  UnitedLines Unite() {
    structure_.FindAxes(&map_);
    return structure_.Unite(&map_);
  }

  // Slides the window as the estimator does: drops the second newest frame or the oldest.
  void Slide(bool keep_second_newest, size_t size) {
    if (!keep_second_newest && map_.window.frames.size() > 1) {
      map_.DropSecondNewest();
    } else if (map_.window.frames.size() > size) {
      SlideOldest();
    }
  }

  LocalMap& map() { return map_; }
  const LineStructure& structure() const { return structure_; }

 private:
  void SlideOldest() {
    const AnchorPolicyOptions options{EstimatorConfig()};
    const bool stays = StaysAsAnchor(options, map_.window, map_.lines);
    const auto replaced_ns = AnchorToReplace(options, map_.window);
    if (stays && replaced_ns) map_.RemoveAnchor(*replaced_ns);
    map_.SlideOldest(stays);
  }

  // Replaces the optimization.
  void Refit() {
    for (auto& [id, landmark] : map_.lines.landmarks()) {
      if (!landmark.triangulated || landmark.observations.size() < 3) continue;
      const auto observations = PosedOfHostCamera(landmark, map_.window);
      const auto fit = FitLine(observations, kNoise, landmark.coordinates);
      if (fit) landmark.coordinates = fit->line;
    }
  }

  LocalMap map_{LocalMapOptions(kNoise, /*remember_lines=*/true)};
  LineStructure structure_{Limits()};
};

}  // namespace plm_vins::testing
