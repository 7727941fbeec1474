// SPDX-License-Identifier: BSD-3-Clause
// The whole configuration of the suite. All nodes share one YAML file, so every node validates all
// of it. A module's values and keys are in common/config/MODULE_config.{h,cpp};
// config/reference.yaml documents them.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config_value.h"
#include "common/config/estimator_config.h"
#include "common/config/output_config.h"
#include "common/config/pose_graph_config.h"
#include "common/config/sensor_config.h"
#include "common/config/tracker_config.h"

namespace plm_vins {

struct Config {
  std::string file;                              // path of the file, for messages
  std::map<std::string, std::string> overrides;  // overriding texts by key
  std::vector<std::string> warnings;             // about keys without effect; each names the file
  SensorConfig sensor;
  double publish_rate = 0;  // rate of images passed to the estimator [Hz]; 0: all
  bool show_track = true;   // publish annotated images
  PointTrackerConfig points;
  bool use_lines = true;  // in addition to the points
  LineTrackerConfig lines;
  EstimatorConfig estimator;
  PoseGraphConfig pose_graph;
  OutputConfig output;
};

// All problems of a configuration, one per line, each with file and key.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::vector<std::string>& problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

// Reads a YAML file in VINS-Mono's format ("%YAML:1.0"). `overrides` replace scalar keys by their
// text; messages name them by `override_prefix` and key. Throws ConfigError with *all* problems:
// missing and unknown keys (with the most similar known key), wrong types, values out of range,
// contradictions.
Config LoadConfig(const std::string& file, const std::map<std::string, std::string>& overrides = {},
                  const std::string& override_prefix = "--set ");

// Returns every key with its effective value: defaults, overrides, noise as densities, the mask
// with its folder. A file of these values gives the same configuration.
std::vector<std::pair<std::string, ConfigValue>> EffectiveValues(const Config& config);

}  // namespace plm_vins
