// SPDX-License-Identifier: BSD-3-Clause
// Frames of known pose and the lines that they see, for the tests of merging.
#pragma once

#include <utility>
#include <vector>

#include "vins_estimator/geometry/line_fit.h"
#include "vins_estimator/manhattan/line_directions.h"
#include "vins_estimator/merging/line_merging.h"
#include "vins_estimator/recall/anchor_policy.h"

namespace plm_vins::testing {

constexpr double kFocalLength = 460.0;
constexpr double kNoise = 1.0 / kFocalLength;
constexpr size_t kWindowSize = 10;

// Frames of known pose, and the lines that they see, as the estimator would have them.
class LineWindow {
 public:
  LineWindow() : merging_(MergingOptions()) {}

  static LineMergingOptions MergingOptions() {
    EstimatorConfig config;
    config.line_noise = kNoise * kFocalLength;
    return {config, kFocalLength};
  }

  void AddFrame(const FrameState& state, const LineFrame& frame) {
    WindowFrame window_frame;
    window_frame.state = state;
    window_.frames.push_back(window_frame);
    lines_.AddFrame(merging_.Redirect(frame));
    lines_.Triangulate(window_, LineTriangulationOptions(kNoise), /*max_length=*/20);
    Refit();
  }

  LineMergingCounts Merge() {
    const auto directions = LineDirections(window_, lines_, kNoise);
    manhattan_.Update(window_.newest().state.t_ns, directions);
    NameAxes(manhattan_, directions, &lines_);
    const LineMergingCounts counts = merging_.Merge(window_, &lines_, &manhattan_);
    NoteUse(lines_, &window_);
    return counts;
  }

  // As the estimator does: drops the frame before the newest, or else the oldest.
  void Slide(bool keep_second_newest, size_t size) {
    if (!keep_second_newest && window_.frames.size() > 1) {
      lines_.RemoveFrame(window_, window_.frames[window_.frames.size() - 2].state.t_ns);
      window_.frames.erase(window_.frames.end() - 2);
    } else if (window_.frames.size() > size) {
      RemoveOldest();
    }
  }

  SlidingWindow& window() { return window_; }
  LineMap& lines() { return lines_; }
  const LineAliases& aliases() const { return merging_.aliases(); }
  const LineMemory& memory() const { return merging_.memory(); }
  const ManhattanFrame& manhattan() const { return manhattan_; }

 private:
  void RemoveOldest() {
    const AnchorPolicyOptions options{EstimatorConfig()};
    const int64_t oldest_ns = window_.frames.front().state.t_ns;
    const bool stays = StaysAsAnchor(options, window_, lines_);
    if (const auto replaced_ns = AnchorToReplace(options, window_); stays && replaced_ns) {
      lines_.RemoveAnchor(*replaced_ns);
      merging_.RemoveAnchor(*replaced_ns);
      window_.RemoveAnchor(*replaced_ns);
    }
    merging_.Remember(window_, lines_, stays);
    lines_.StartAnew(window_, oldest_ns, [](const LineLandmark&) {});
    lines_.RemoveFrame(window_, oldest_ns);
    if (stays) {
      window_.TurnOldestIntoAnchor();
    } else {
      window_.RemoveOldest();
    }
  }

  // Stands for the optimisation.
  void Refit() {
    for (auto& [id, landmark] : lines_.landmarks()) {
      if (!landmark.triangulated || landmark.views.size() < 3) continue;
      std::vector<LineSighting> sightings;
      for (const LineView& view : landmark.views) {
        sightings.push_back({window_.T_W_C(*window_.Find(view.t_ns)), view.segment});
      }
      const auto fit = FitLine(sightings, kNoise, landmark.coordinates);
      if (fit) landmark.coordinates = fit->line;
    }
  }

  SlidingWindow window_;
  LineMap lines_;
  ManhattanFrame manhattan_;
  LineMerging merging_;
};

}  // namespace plm_vins::testing
