// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/io/output_file.h"
#include "common/measurements.h"
#include "offline/pipeline/feature_trackers.h"
#include "vins_estimator/output/json.h"

namespace plm_vins {

// An item of the stream from the trackers to the estimator.
struct TrackedItem {
  ImuSample imu;
  std::unique_ptr<TrackedFeatures> frame;  // null for `imu`

  int64_t t_ns() const { return frame ? frame->points.features.t_ns : imu.t_ns; }
};

// Saves the output of the trackers and their configuration, so that runs which differ only in the
// estimator do not need images. The binary format is specific to this version of the program and
// this kind of machine: suitable for comparisons, not for archiving.
class FeatureFileWriter {
 public:
  // `tracker_values` is the result of TrackerValues(). Throws std::runtime_error with the file name
  // if the file cannot be written; so does Close().
  FeatureFileWriter(const std::string& file, const Json& tracker_values);

  void Add(const TrackedItem& item);
  void Close();

 private:
  ReplacedFile file_;
};

// Reads a file of FeatureFileWriter; values are restored exactly.
class FeatureFileReader {
 public:
  // Throws std::runtime_error if the file cannot be read or is not a feature file.
  explicit FeatureFileReader(const std::string& file);

  // Configuration that the features were recorded with.
  const Json& tracker_values() const { return tracker_values_; }

  // Returns the next item, or nullopt at the end. Throws std::runtime_error if the file is damaged.
  std::optional<TrackedItem> Next();

  const std::string& file() const { return file_; }

 private:
  void ReadTrackerValues();
  std::runtime_error Unusable(const std::string& why) const;

  std::string file_;
  std::ifstream stream_;
  Json tracker_values_;
};

}  // namespace plm_vins
