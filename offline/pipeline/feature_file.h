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

// What flows from the trackers to the estimator, in order.
struct TrackedItem {
  ImuSample imu;
  std::unique_ptr<TrackedFeatures> frame;  // instead of `imu`

  int64_t t_ns() const { return frame ? frame->points.features.t_ns : imu.t_ns; }
};

// Writes what the trackers hand to the estimator, so that runs which differ in the estimator alone
// need no images, and before it the configuration of the trackers. The format is binary, of this
// version of the program and this kind of machine: good for comparisons, not for keeping.
class FeatureFileWriter {
 public:
  // `tracker_values`: TrackerValues(). What cannot be written, here or in Close(), throws
  // std::runtime_error that names the file.
  FeatureFileWriter(const std::string& file, const Json& tracker_values);

  void Add(const TrackedItem& item);
  void Close();

 private:
  ReplacedFile file_;
};

// Reads such a file: the same items, bit by bit.
class FeatureFileReader {
 public:
  // Throws std::runtime_error where the file cannot be read or is not one of features.
  explicit FeatureFileReader(const std::string& file);

  // By which the features were recorded.
  const Json& tracker_values() const { return tracker_values_; }

  // The next item; nothing at the end. Throws std::runtime_error where the file is damaged.
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
