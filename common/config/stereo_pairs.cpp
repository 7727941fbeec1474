// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/stereo_pairs.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

#include "common/camera/camera_model.h"

namespace plm_vins {
namespace {

constexpr double kMinShared = 0.5;  // share of the second image

// Returns the share of the image of camera B whose points, if they are distant, camera A shows.
double SharedView(const CameraModel& a, const CameraModel& b, const Eigen::Quaterniond& R_A_B) {
  constexpr int kColumns = 16, kRows = 12;
  const Eigen::Vector2d size(b.parameters().width, b.parameters().height);
  int shared = 0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const int column = i % kColumns, row = i / kColumns;
    const Eigen::Vector2d share((column + 0.5) / kColumns, (row + 0.5) / kRows);
    const auto xy = b.Unproject(share.cwiseProduct(size));
    const auto pixel = xy ? a.Project(R_A_B * xy->homogeneous()) : std::nullopt;
    shared += pixel && a.IsInImage(*pixel);
  }
  return static_cast<double>(shared) / (kColumns * kRows);
}

bool HasPair(int camera, const std::vector<StereoPair>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [camera](const StereoPair& pair) {
    return pair.first == camera || pair.second == camera;
  });
}

std::vector<StereoPair> OverlappingPairs(const std::vector<CameraSensor>& cameras) {
  std::vector<StereoPair> pairs;
  for (int second = 1; second < static_cast<int>(cameras.size()); ++second) {
    for (int first = 0; first < second; ++first) {
      if (HasPair(first, pairs) || HasPair(second, pairs)) continue;
      const CameraSensor &a = cameras[first], &b = cameras[second];
      const Eigen::Quaterniond R_A_B = a.T_B_C.rotation.conjugate() * b.T_B_C.rotation;
      const double shared =
          SharedView(*CameraModel::Create(a.parameters), *CameraModel::Create(b.parameters), R_A_B);
      if (shared > kMinShared) pairs.push_back({first, second});
    }
  }
  return pairs;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Returns the pairs in "none" or a text such as "0-1 2-3"; nullopt if it is neither.
std::optional<std::vector<StereoPair>> ReadPairs(const std::string& text) {
  std::vector<StereoPair> pairs;
  if (text == "none") return pairs;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool is_pair = word.size() == 3 && IsDigit(word[0]) && word[1] == '-' && IsDigit(word[2]);
    if (!is_pair) return std::nullopt;
    pairs.push_back({word[0] - '0', word[2] - '0'});
  }
  return pairs.empty() ? std::nullopt : std::optional(pairs);
}

}  // namespace

std::vector<StereoPair> StereoPairs(const SensorConfig& sensor) {
  return sensor.stereo_pairs == "auto"
             ? OverlappingPairs(sensor.cameras)
             : ReadPairs(sensor.stereo_pairs).value_or(std::vector<StereoPair>());
}

bool IsTracked(int camera, const std::vector<StereoPair>& pairs) {
  return std::none_of(pairs.begin(), pairs.end(),
                      [camera](const StereoPair& pair) { return pair.second == camera; });
}

Problem CheckStereoPairs(const SensorConfig& sensor) {
  if (sensor.stereo_pairs == "auto") return std::nullopt;
  const auto stated = ReadPairs(sensor.stereo_pairs);
  if (!stated) return "must be auto, none, or pairs of cameras such as 0-1 2-3";
  std::vector<StereoPair> pairs;
  for (const StereoPair& pair : *stated) {
    if (pair.first >= pair.second || pair.second >= static_cast<int>(sensor.cameras.size())) {
      return "must name two cameras below num_of_cam, the smaller number first";
    }
    if (HasPair(pair.first, pairs) || HasPair(pair.second, pairs)) {
      return "must name each camera at most once";
    }
    pairs.push_back(pair);
  }
  return std::nullopt;
}

}  // namespace plm_vins
