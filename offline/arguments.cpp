// SPDX-License-Identifier: BSD-3-Clause
#include "offline/arguments.h"

#include <CLI/CLI.hpp>

#include "common/io/option_checks.h"

namespace plm_vins {
namespace {

constexpr double kMostSeconds = 1e9;  // timestamps are nanoseconds in 64 bits

// Validates the argument of --set; returns an error message, or an empty string if it is valid.
std::string CheckOverride(const std::string& text) {
  const size_t equals = text.find('=');
  const bool valid = equals != 0 && equals != std::string::npos;
  return valid ? "" : "expected key=value instead of " + text;
}

// Validates a time span.
std::string CheckSeconds(const std::string& text) {
  return IsNumberBetween(0, kMostSeconds, text)
             ? ""
             : "expected seconds, zero to 1e9, instead of " + text;
}

void DeclareFiles(Arguments* arguments, CLI::App* app) {
  const auto add = [](CLI::App* group, const std::string& option, std::string* path,
                      const std::string& help) {
    return group->add_option(option, *path, help)->check(CheckPath);
  };
  add(app, "--config", &arguments->config, "configuration file (VINS YAML)")->required();
  auto* source = app->add_option_group("input");
  source
      ->add_option("--bag", arguments->bags,
                   "ROS bags: files, folders or patterns; several are played as one, in order of "
                   "time")
      ->check(CheckPath);
  add(source, "--asl", &arguments->asl, "folder in ASL format (EuRoC)");
  add(source, "--features", &arguments->features,
      "features that --save-features wrote, instead of images");
  source->require_option(1);
  add(app, "--output", &arguments->output, "folder for the results, made where missing")
      ->required();
  add(app, "--save-features", &arguments->saved_features,
      "write the tracked features to this file, for runs without images");
  add(app, "--map-in", &arguments->map_in,
      "start in this map (--map-out of another run); switches loop_closure on");
  add(app, "--map-out", &arguments->map_out,
      "save the map to this file in the end; switches loop_closure on");
}

}  // namespace

void Declare(Arguments* arguments, CLI::App* app) {
  DeclareFiles(arguments, app);
  app->add_option("--start", arguments->start, "skip this much after the first image [s]")
      ->check(CheckSeconds);
  app->add_option("--duration", arguments->duration, "process this much [s]")->check(CheckSeconds);
  app->add_option("--save-track-images", arguments->track_image_interval,
                  "write a small image with its points and lines to tracks/ every so often [s]")
      ->check(CheckSeconds);
  app->add_option("--set", arguments->overrides, "replace values of the configuration: key=value")
      ->check(CheckOverride);
  app->add_option("--threads", arguments->threads,
                  "1: all in turn, 2: trackers beside the estimator, 3: and beside each other, 4: "
                  "and images read ahead; the results are the same")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
}

std::map<std::string, std::string> ParseOverrides(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> overrides;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

}  // namespace plm_vins
