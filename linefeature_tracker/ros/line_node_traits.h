// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <plm_vins/LineFeatureTrackerConfig.h>

#include <cstdint>

#include "common/config/config.h"
#include "common/ros/optional_node.h"
#include "linefeature_tracker/line_tracking_stage.h"
#include "tracking/ros/tracker_node.h"

namespace plm_vins {

// What is particular to the line tracker under ROS, as TrackerNode describes it.
struct LineNodeTraits {
  using Stage = LineTrackingStage;
  using Settings = LineFeatureTrackerConfig;

  static constexpr char kFeatureTopic[] = "linefeature";
  static constexpr char kAnnotatedTopic[] = "linefeature_img";
  static constexpr char kDiagnostics[] = "line tracking";
  // The points decide which images are used, and which tracker sends the points is not known here.
  static constexpr bool kEveryImage = true;
  // The estimator waits for lines for three images at most, so a tracker that cannot keep up leaves
  // out images instead of falling back further.
  static constexpr uint32_t kImageQueue = 3;

  static Settings ToSettings(const Config& config) {
    Settings settings = Settings::__getDefault__();  // its groups, too, have values then
    settings.max_line_cnt = config.lines.max_lines;
    settings.show_track = config.show_track;
    return settings;
  }
  static void Apply(const Settings& settings, LineTracker* tracker) {
    tracker->SetMaxLines(settings.max_line_cnt);
  }
};

struct LineSwitch {
  static constexpr char kKey[] = "use_lines";
  static bool IsOn(const Config& config) { return config.use_lines; }
};

using LineTrackerNode = OptionalNode<TrackerNode<LineNodeTraits>, LineSwitch>;

}  // namespace plm_vins
