// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <plm_vins/LineFeatureTrackerConfig.h>
#include <ros/console.h>

#include <cstdint>

#include "common/config/config.h"
#include "linefeature_tracker/line_tracking_stage.h"

namespace plm_vins {

// Whether there is anything to do for the line tracker. Says so where there is not.
inline bool WantsLines(const Config& config) {
  if (config.use_lines) return true;
  ROS_INFO("not needed: use_lines is 0 in %s", config.file.c_str());
  return false;
}

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

}  // namespace plm_vins
