// SPDX-License-Identifier: BSD-3-Clause
// A camera that passes a wall with lines, for tests of merging and recognition.
#pragma once

#include <vector>

#include "common/append.h"
#include "test/vins_estimator/line_window.h"

namespace plm_vins::testing {

// Line on a wall five meters ahead of a camera that moves sideways and up, in meters right and down
// from the point ahead.
struct WallLine {
  int64_t id;
  Eigen::Vector2d start, end;
  int first_frame = 0, last_frame = 100;  // frames that observe it
};

inline void AddWallFrame(const std::vector<WallLine>& lines, int i, LineWindow* window) {
  FrameState state;
  state.t_ns = (i + 1) * 100'000'000ll;
  state.SetPose({Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.15 * i, 0.15 * i, 0)});
  LineFrame frame;
  frame.t_ns = state.t_ns;
  const auto see = [&state](const Eigen::Vector2d& on_wall) -> Eigen::Vector2d {
    return (on_wall - state.position().head<2>()) / 5.0;
  };
  for (const WallLine& line : lines) {
    if (i < line.first_frame || i > line.last_frame) continue;
    frame.lines.push_back({line.id, see(line.start), see(line.end)});
  }
  window->Slide(/*keep_second_newest=*/true, kWindowSize);
  window->AddFrame(state, frame);
}

inline UnitedLines UniteOnWall(const std::vector<WallLine>& lines, LineWindow* window,
                               int frames = 10) {
  UnitedLines sum;
  for (int i = 0; i < frames; ++i) {
    AddWallFrame(lines, i, window);
    const UnitedLines united = window->Unite();
    const LineMergingCounts& now = united.merging;
    Append(united.absorbed, &sum.absorbed);
    sum.merging.merged += now.merged;
    sum.recognized += united.recognized;
    sum.merging.apart += now.apart;
    sum.merging.seen_side_by_side += now.seen_side_by_side;
    sum.merging.distant += now.distant;
    sum.merging.other_direction += now.other_direction;
    sum.merging.inconsistent += now.inconsistent;
  }
  return sum;
}

}  // namespace plm_vins::testing
