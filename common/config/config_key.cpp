// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_key.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "common/format.h"

namespace plm_vins {
namespace {

// Formats "must be 1 to 500 [px]".
std::string MustBeIn(Range range, const std::string& unit) {
  return "must be " + ToText(range) + (unit.empty() ? "" : " [" + unit + "]");
}

std::optional<double> ToNumber(const YAML::Node& value) {
  double number = 0;
  if (!value.IsScalar() || !YAML::convert<double>::decode(value, number)) return std::nullopt;
  return number;
}

template <typename Field>
ConfigKey KeyOf(const std::string& name, const std::string& unit, const std::string& allowed,
                Field* field) {
  ConfigKey key;
  key.name = name;
  key.unit = unit;
  key.allowed = allowed;
  key.value = [field] { return ConfigValue(*field); };
  return key;
}

}  // namespace

std::string ToText(Range range) { return ToText(range.min) + " to " + ToText(range.max); }

std::optional<std::string> ScalarText(const YAML::Node& value) {
  if (!value.IsScalar()) return std::nullopt;
  return value.Scalar();
}

Problem ReadNumber(const YAML::Node& value, const std::string& unit, Range range, double* number) {
  const auto parsed = ToNumber(value);
  if (!parsed) return "is not a number; " + MustBeIn(range, unit);
  if (!std::isfinite(*parsed)) return "is not finite; " + MustBeIn(range, unit);
  if (*parsed < range.min || *parsed > range.max) return "out of range, " + MustBeIn(range, unit);
  *number = *parsed;
  return std::nullopt;
}

Problem ReadInteger(const YAML::Node& value, const std::string& unit, Range range, int* number) {
  double parsed = 0;
  if (Problem problem = ReadNumber(value, unit, range, &parsed)) return problem;
  if (parsed != std::floor(parsed)) return "is not a whole number; " + MustBeIn(range, unit);
  *number = static_cast<int>(parsed);
  return std::nullopt;
}

Problem ReadFlag(const YAML::Node& value, bool* flag) {
  const auto text = ScalarText(value);
  if (text != "0" && text != "1" && text != "true" && text != "false") {
    return "must be 0 or 1 (false or true)";
  }
  *flag = text == "1" || text == "true";
  return std::nullopt;
}

Problem ReadText(const YAML::Node& value, std::string* text) {
  const auto scalar = ScalarText(value);
  if (!scalar) return "must be a string";
  *text = *scalar;
  return std::nullopt;
}

Problem ReadMatrix(const YAML::Node& node, Eigen::MatrixXd* matrix) {
  const std::string size = std::to_string(matrix->rows()) + "x" + std::to_string(matrix->cols());
  const std::string advice = "must be an !!opencv-matrix of size " + size;
  if (!node.IsMap()) return advice;
  const YAML::Node data = node["data"];
  const auto differs = [&](const char* key, Eigen::Index expected) {
    return node[key] && ToNumber(node[key]) != static_cast<double>(expected);
  };
  if (!data || !data.IsSequence() || differs("rows", matrix->rows()) ||
      differs("cols", matrix->cols()) || data.size() != static_cast<size_t>(matrix->size())) {
    return advice + " with " + std::to_string(matrix->size()) + " numbers in data";
  }
  for (Eigen::Index i = 0; i < matrix->size(); ++i) {
    const auto number = ToNumber(data[i]);
    if (!number || !std::isfinite(*number)) {
      return "entry " + std::to_string(i + 1) + " of data is not a finite number";
    }
    (*matrix)(i / matrix->cols(), i % matrix->cols()) = *number;
  }
  return std::nullopt;
}

ConfigKey ConfigKey::Number(const std::string& name, const std::string& unit, Range range,
                            double* field) {
  ConfigKey key = KeyOf(name, unit, ToText(range), field);
  key.read = [=](const YAML::Node& value) { return ReadNumber(value, unit, range, field); };
  key.keep_in_range = [=] { *field = std::clamp(*field, range.min, range.max); };
  return key;
}

ConfigKey ConfigKey::Integer(const std::string& name, const std::string& unit, Range range,
                             int* field) {
  ConfigKey key = KeyOf(name, unit, ToText(range), field);
  key.read = [=](const YAML::Node& value) { return ReadInteger(value, unit, range, field); };
  return key;
}

ConfigKey ConfigKey::Flag(const std::string& name, bool* field) {
  ConfigKey key = KeyOf(name, "", "0 or 1", field);
  key.read = [=](const YAML::Node& value) { return ReadFlag(value, field); };
  return key;
}

ConfigKey ConfigKey::Text(const std::string& name, std::string* field) {
  ConfigKey key = KeyOf(name, "", "", field);
  key.read = [=](const YAML::Node& value) { return ReadText(value, field); };
  return key;
}

ConfigKey ConfigKey::OneOf(const std::string& name, const std::vector<std::string>& words,
                           const std::function<void(size_t)>& set,
                           const std::function<bool(size_t)>& is) {
  ConfigKey key;
  key.name = name;
  key.allowed = "one of " + JoinTexts(words, ", ");
  key.read = [=, allowed = key.allowed](const YAML::Node& value) -> Problem {
    const auto text = ScalarText(value);
    const auto word = text ? std::find(words.begin(), words.end(), *text) : words.end();
    if (word == words.end()) return "must be " + allowed;
    set(static_cast<size_t>(word - words.begin()));
    return std::nullopt;
  };
  key.value = [=] {
    size_t i = 0;
    while (i < words.size() && !is(i)) ++i;
    return ConfigValue(i < words.size() ? words[i] : std::string());
  };
  return key;
}

ConfigKey ConfigKey::Matrix(const std::string& name, const std::function<Eigen::MatrixXd()>& get,
                            const std::function<Problem(const Eigen::MatrixXd&)>& set) {
  ConfigKey key;
  key.name = name;
  key.read = [=](const YAML::Node& value) {
    Eigen::MatrixXd matrix = get();
    const Problem problem = ReadMatrix(value, &matrix);
    return problem ? problem : set(matrix);
  };
  key.value = [=] {
    const Eigen::MatrixXd by_column = get().transpose();
    return ConfigValue(std::vector<double>(by_column.data(), by_column.data() + by_column.size()));
  };
  key.has_default = false;
  return key;
}

ConfigKeys Required(ConfigKeys keys) {
  for (ConfigKey& key : keys) {
    key.required = true;
    key.has_default = false;
  }
  return keys;
}

ConfigKeys Join(const std::vector<ConfigKeys>& lists) {
  ConfigKeys keys;
  for (const ConfigKeys& list : lists) keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

}  // namespace plm_vins
