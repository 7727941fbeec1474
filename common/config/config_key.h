// SPDX-License-Identifier: BSD-3-Clause
// The kinds of configuration keys: each knows how to read its value into a field and to print it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config.h"

namespace plm_vins {

// A configuration in the making: what the keys say, where that is not a field of Config itself.
struct ConfigDraft : Config {
  enum class ModelType { kPinhole, kEquidistant, kKannalaBrandt, kMei };
  enum class ImuNoiseModel { kVins, kContinuous };
  std::optional<ModelType> model_type;
  ImuNoiseModel imu_noise_model = ImuNoiseModel::kVins;
  double imu_rate = 200;  // [Hz]
  std::optional<bool> fisheye;
};

// What is wrong with a value, as the end of the sentence "KEY: ..."; nothing where it is fine.
using Problem = std::optional<std::string>;

template <typename T>
using Field = std::function<T&(ConfigDraft&)>;

struct ConfigKey {
  std::string name;
  bool required = false;
  std::function<Problem(const YAML::Node& value, ConfigDraft& draft)> read;
  std::function<std::string(ConfigDraft& draft)> print;
};

struct Range {
  double min;
  double max;
};

ConfigKey NumberKey(const std::string& name, const std::string& unit, Range range,
                    Field<double> field);
ConfigKey IntegerKey(const std::string& name, const std::string& unit, Range range,
                     Field<int> field);
ConfigKey FlagKey(const std::string& name, Field<bool> field);
ConfigKey TextKey(const std::string& name, Field<std::string> field);
// An OpenCV matrix of the given size; `set` may refuse it.
ConfigKey MatrixKey(const std::string& name, int rows, int cols,
                    std::function<Problem(const Eigen::MatrixXd&, ConfigDraft&)> set);
// One of several words.
template <typename T>
ConfigKey ChoiceKey(const std::string& name, std::vector<std::pair<std::string, T>> choices,
                    Field<T> field);

ConfigKey Required(ConfigKey key);

// The text of a scalar, or nothing for a list, a map or an empty value.
std::optional<std::string> ScalarText(const YAML::Node& value);

template <typename T>
ConfigKey ChoiceKey(const std::string& name, std::vector<std::pair<std::string, T>> choices,
                    Field<T> field) {
  const auto read = [choices, field](const YAML::Node& value, ConfigDraft& draft) -> Problem {
    std::string words;
    for (const auto& [word, choice] : choices) {
      if (ScalarText(value) == word) {
        field(draft) = choice;
        return std::nullopt;
      }
      words += (words.empty() ? "" : ", ") + word;
    }
    return "must be one of " + words;
  };
  const auto print = [choices, field](ConfigDraft& draft) {
    for (const auto& [word, choice] : choices) {
      if (field(draft) == choice) return word;
    }
    return std::string();
  };
  return {name, false, read, print};
}

}  // namespace plm_vins
