// SPDX-License-Identifier: BSD-3-Clause
// The whole configuration of the suite. One YAML file serves all nodes, so every node checks all of
// it. A module's values and their keys are in common/config/MODULE_config.{h,cpp}; what they mean
// is in config/reference.yaml.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config_value.h"
#include "common/config/estimator_config.h"
#include "common/config/line_tracker_config.h"
#include "common/config/output_config.h"
#include "common/config/point_tracker_config.h"
#include "common/config/pose_graph_config.h"
#include "common/config/sensor_config.h"

namespace plm_vins {

struct Config {
  std::string file;                              // where it was read from, for messages
  std::map<std::string, std::string> overrides;  // texts that replaced those of the file, by key
  std::vector<std::string> warnings;  // of what is accepted, but not followed; each names the file
  SensorConfig sensor;
  double publish_rate = 0;  // images whose features the estimator gets [Hz]; 0: all
  bool show_track = true;   // publish annotated images
  PointTrackerConfig points;
  bool use_lines = true;  // beside the points
  LineTrackerConfig lines;
  EstimatorConfig estimator;
  PoseGraphConfig pose_graph;
  OutputConfig output;
};

// Every problem of a configuration, one per line, each naming file and key.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::vector<std::string>& problems);
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

// Reads a VINS-format YAML file ("%YAML:1.0"); `overrides` replace scalar keys by their text, and
// messages name them by `override_prefix` and key. Throws ConfigError with *all* problems: missing,
// unknown (with the nearest known key), of a wrong type, out of range, contradictory.
Config LoadConfig(const std::string& file, const std::map<std::string, std::string>& overrides = {},
                  const std::string& override_prefix = "--set ");

// Every key with the value that is in effect: defaults, overrides, noise as densities, the mask
// with its folder. A file of them gives the same configuration.
std::vector<std::pair<std::string, ConfigValue>> EffectiveValues(const Config& config);

}  // namespace plm_vins
