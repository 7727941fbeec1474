// SPDX-License-Identifier: BSD-3-Clause
#include "offline/results/result_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "offline/results/timed_file.h"
#include "vins_estimator/output/calibrated_config.h"

namespace plm_vins {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResults[] = {
    "trajectory.tum",       "covariance.csv",  "covariance_map.csv",  "timing.csv",
    "summary.json",         "map.ply",         "lines.ply",           "lines.obj",
    "tracks.png",           "line_tracks.png", kCalibratedConfigFile, "trajectory_map.tum",
    "trajectory_final.tum", "loops.csv",       "evaluation.json",     "run.html"};

// These may have parts, one before each backward jump of the timestamps.
constexpr const char* kTimedResults[] = {"trajectory.tum", "covariance.csv", "trajectory_map.tum",
                                         "covariance_map.csv", "trajectory_final.tum"};

void RemoveParts(const fs::path& file) {
  std::error_code error;
  for (int part = 1; fs::remove(TimedFile::PartOf(file, part), error);) ++part;
}

bool IsTrackImage(const fs::path& file) {
  const std::string stamp = file.stem().string();
  return file.extension() == ".jpg" && !stamp.empty() &&
         std::all_of(stamp.begin(), stamp.end(),
                     [](unsigned char digit) { return std::isdigit(digit) != 0; });
}

void RemoveTrackImages(const fs::path& folder) {
  std::error_code error;  // ignored if there is no such folder
  std::vector<fs::path> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (IsTrackImage(entry.path())) images.push_back(entry.path());
  }
  if (images.empty()) return;
  for (const fs::path& image : images) fs::remove(image, error);
  fs::remove(folder, error);  // fails, as intended, if other files are in it
}

}  // namespace

std::vector<std::string> ResultNames() { return {std::begin(kResults), std::end(kResults)}; }

void MakeResultFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::error_code unknown;  // for a path below an inaccessible folder
  if (!fs::is_directory(folder, unknown)) {
    throw std::runtime_error("cannot make the output folder " + folder + ": " +
                             (error ? error.message() : "not a folder"));
  }
}

void RemoveEarlierResults(const std::string& folder, const std::string& config_file) {
  std::error_code error;  // ignored if there is no such file
  for (const char* name : kResults) {
    const fs::path file = fs::path(folder) / name;
    if (!fs::equivalent(file, config_file, error)) fs::remove(file, error);
  }
  for (const char* name : kTimedResults) RemoveParts(fs::path(folder) / name);
  RemoveTrackImages(fs::path(folder) / kTrackImages);
}

}  // namespace plm_vins
