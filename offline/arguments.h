// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/io/command_line.h"

namespace plm_vins {

// The options of run_offline. Paths and `bags` are empty if their options are not given.
struct Arguments {
  std::string config;
  std::vector<std::string> bags;  // files, folders and patterns
  std::string asl;
  std::string features;
  std::string output;
  std::string saved_features;
  std::string map_in;
  std::string map_out;
  double start = 0;                                           // [s]
  double duration = std::numeric_limits<double>::infinity();  // [s]
  std::vector<std::string> overrides;                         // "key=value"
  double track_image_interval = 0;                            // [s]; 0: none
  int threads = 4;
};

// Adds the options, which fill the arguments when they are parsed.
void Declare(Arguments* arguments, CommandLine* command_line);

// Throws std::runtime_error if a required option is missing, or if not exactly one input is given.
void CheckPresence(const Arguments& arguments);

// Returns values by key.
std::map<std::string, std::string> ParseOverrides(const std::vector<std::string>& texts);

}  // namespace plm_vins
