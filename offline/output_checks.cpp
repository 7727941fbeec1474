// SPDX-License-Identifier: BSD-3-Clause
#include "offline/output_checks.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "common/append.h"
#include "offline/results/result_folder.h"
#include "vins_estimator/output/calibrated_config.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

fs::path FullName(const std::string& path) {
  std::error_code error;  // for a path below an inaccessible folder
  const fs::path full = fs::absolute(path, error).lexically_normal();
  const fs::path real = fs::weakly_canonical(full, error);
  return error ? full : real;
}

// Compares by name if the files do not exist yet.
bool AreOneFile(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  return fs::equivalent(a, b, error) || FullName(a) == FullName(b);
}

std::vector<std::string> InputFiles(const Arguments& arguments) {
  std::vector<std::string> files = {arguments.config, arguments.features};
  Append(arguments.bags, &files);
  if (arguments.asl.empty()) return files;
  for (const char* table : {"imu0/data.csv", "cam0/data.csv"}) {
    files.push_back(arguments.asl + "/" + table);
    files.push_back(arguments.asl + "/mav0/" + table);
  }
  return files;
}

void CheckOutput(const char* option, const std::string& output,
                 const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (AreOneFile(input, output)) {
      throw std::runtime_error(std::string(option) + " would overwrite the input, " + input);
    }
  }
}

void CheckNoResult(const std::string& option, const std::string& file, const std::string& folder,
                   const std::string& name) {
  if (!AreOneFile(file, (fs::path(folder) / name).string())) return;
  throw std::runtime_error(option + " names " + file + ", which the run replaces by its own " +
                           name + "; choose another file or --output");
}

void CheckResults(const Arguments& arguments) {
  for (const std::string& name : ResultNames()) {
    CheckNoResult("--map-out", arguments.map_out, arguments.output, name);
    CheckNoResult("--save-features", arguments.saved_features, arguments.output, name);
    CheckNoResult("--map-in", arguments.map_in, arguments.output, name);
    CheckNoResult("--features", arguments.features, arguments.output, name);
    for (const std::string& bag : arguments.bags) {
      CheckNoResult("--bag", bag, arguments.output, name);
    }
    if (name == kCalibratedConfigFile) continue;  // may be the input; see CheckCalibrationOutput()
    CheckNoResult("--config", arguments.config, arguments.output, name);
  }
}

}  // namespace

void CheckOutputs(const Arguments& arguments) {
  std::vector<std::string> inputs = InputFiles(arguments);
  CheckOutput("--map-out", arguments.map_out, inputs);
  inputs.push_back(arguments.map_in);
  CheckOutput("--save-features", arguments.saved_features, inputs);
  if (AreOneFile(arguments.map_out, arguments.saved_features)) {
    throw std::runtime_error("--save-features and --map-out both name " + arguments.map_out);
  }
  CheckResults(arguments);
}

void CheckCalibrationOutput(const Arguments& arguments, const SensorConfig& sensor) {
  if (!RefinesCalibration(sensor)) return;
  CheckNoResult("--config", arguments.config, arguments.output, kCalibratedConfigFile);
}

}  // namespace plm_vins
