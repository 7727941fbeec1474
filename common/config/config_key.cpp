// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_key.h"

#include <yaml-cpp/yaml.h>

#include <cmath>

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

}  // namespace plm_vins
