// SPDX-License-Identifier: BSD-3-Clause
#include "offline/arguments.h"

#include <stdexcept>

namespace plm_vins {
namespace {

constexpr double kMostSeconds = 1e9;  // timestamps are nanoseconds in 64 bits

TakeValue TakeOverride(std::vector<std::string>* overrides) {
  return [overrides](const std::string& text) -> std::string {
    overrides->push_back(text);
    const size_t equals = text.find('=');
    const bool valid = equals != 0 && equals != std::string::npos;
    return valid ? "" : "expected key=value instead of " + text;
  };
}

TakeValue TakeBag(std::vector<std::string>* bags) {
  return [bags](const std::string& text) { return TakePath(&bags->emplace_back())(text); };
}

TakeValue TakeSeconds(double* seconds) {
  const TakeValue take = TakeNumber(0, kMostSeconds, seconds);
  return [take](const std::string& text) -> std::string {
    return take(text).empty() ? "" : "expected seconds, zero to 1e9, instead of " + text;
  };
}

TakeValue TakeThreads(int* threads) {
  return [threads](const std::string& text) -> std::string {
    const bool valid = text.size() == 1 && text[0] >= '1' && text[0] <= '4';
    if (valid) *threads = text[0] - '0';
    return valid ? "" : "expected 1, 2, 3 or 4 instead of " + text;
  };
}

void DeclareFiles(Arguments* arguments, CommandLine* line) {
  line->Add("config", TakePath(&arguments->config), "configuration file (VINS YAML); required");
  line->AddList(
      "bag", TakeBag(&arguments->bags),
      "ROS bags: files, folders or patterns; several are played as one, in order of time");
  line->Add("asl", TakePath(&arguments->asl), "folder in ASL format (EuRoC), instead of bags");
  line->Add("features", TakePath(&arguments->features),
            "features that --save-features wrote, instead of images");
  line->Add("output", TakePath(&arguments->output),
            "folder for the results, made where missing; required");
  line->Add("save-features", TakePath(&arguments->saved_features),
            "write the tracked features to this file, for runs without images");
  line->Add("map-in", TakePath(&arguments->map_in),
            "start in this map (--map-out of another run); switches loop_closure on");
  line->Add("map-out", TakePath(&arguments->map_out),
            "save the map to this file in the end; switches loop_closure on");
}

}  // namespace

void Declare(Arguments* arguments, CommandLine* command_line) {
  DeclareFiles(arguments, command_line);
  command_line->Add("start", TakeSeconds(&arguments->start),
                    "skip this much after the first image [s]");
  command_line->Add("duration", TakeSeconds(&arguments->duration), "process this much [s]");
  command_line->Add("save-track-images", TakeSeconds(&arguments->track_image_interval),
                    "write a small image with its points and lines to tracks/ every so often [s]");
  command_line->AddList("set", TakeOverride(&arguments->overrides),
                        "replace values of the configuration: key=value");
  command_line->Add("threads", TakeThreads(&arguments->threads),
                    "1: all in turn, 2: trackers beside the estimator, 3: and beside each other, "
                    "4 (default): and images read ahead; the results are the same");
}

void CheckPresence(const Arguments& arguments) {
  if (arguments.config.empty()) throw std::runtime_error("--config is required");
  const int inputs = static_cast<int>(!arguments.bags.empty()) +
                     static_cast<int>(!arguments.asl.empty()) +
                     static_cast<int>(!arguments.features.empty());
  if (inputs != 1) {
    throw std::runtime_error("exactly one of --bag, --asl and --features is required");
  }
  if (arguments.output.empty()) throw std::runtime_error("--output is required");
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
