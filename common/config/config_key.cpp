// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_key.h"

#include <cmath>
#include <sstream>

namespace plm_vins {
namespace {

std::string ToText(double number) {
  std::ostringstream text;
  text.precision(12);
  text << number;
  return text.str();
}

// "must be 1 to 500 [px]".
std::string MustBeIn(Range range, const std::string& unit) {
  return "must be " + ToText(range.min) + " to " + ToText(range.max) +
         (unit.empty() ? "" : " [" + unit + "]");
}

std::optional<double> ToNumber(const YAML::Node& value) {
  double number = 0;
  if (!value.IsScalar() || !YAML::convert<double>::decode(value, number)) return std::nullopt;
  return number;
}

// Reads a number in the range, or tells what is wrong with it.
Problem ReadNumber(const YAML::Node& value, const std::string& unit, Range range, double* number) {
  const auto parsed = ToNumber(value);
  if (!parsed) return "is not a number; " + MustBeIn(range, unit);
  if (!std::isfinite(*parsed)) return "is not finite; " + MustBeIn(range, unit);
  if (*parsed < range.min || *parsed > range.max) return "out of range, " + MustBeIn(range, unit);
  *number = *parsed;
  return std::nullopt;
}

// The entries of an OpenCV matrix node, or what is wrong with it.
Problem ReadMatrix(const YAML::Node& node, Eigen::MatrixXd* matrix) {
  const std::string size = std::to_string(matrix->rows()) + "x" + std::to_string(matrix->cols());
  const std::string advice = "must be an !!opencv-matrix of size " + size;
  if (!node.IsMap() || !node["data"].IsSequence()) return advice;
  const YAML::Node data = node["data"];
  const auto differs = [&](const char* key, Eigen::Index expected) {
    return node[key] && ToNumber(node[key]) != static_cast<double>(expected);
  };
  if (differs("rows", matrix->rows()) || differs("cols", matrix->cols()) ||
      data.size() != static_cast<size_t>(matrix->size())) {
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

}  // namespace

std::optional<std::string> ScalarText(const YAML::Node& value) {
  if (!value.IsScalar()) return std::nullopt;
  return value.Scalar();
}

ConfigKey NumberKey(const std::string& name, const std::string& unit, Range range,
                    Field<double> field) {
  const auto read = [=](const YAML::Node& value, ConfigDraft& draft) {
    return ReadNumber(value, unit, range, &field(draft));
  };
  return {name, false, read, [field](ConfigDraft& draft) { return ToText(field(draft)); }};
}

ConfigKey IntegerKey(const std::string& name, const std::string& unit, Range range,
                     Field<int> field) {
  const auto read = [=](const YAML::Node& value, ConfigDraft& draft) -> Problem {
    double number = 0;
    if (const Problem problem = ReadNumber(value, unit, range, &number)) return problem;
    if (number != std::floor(number)) return "is not a whole number; " + MustBeIn(range, unit);
    field(draft) = static_cast<int>(number);
    return std::nullopt;
  };
  return {name, false, read, [field](ConfigDraft& draft) { return ToText(field(draft)); }};
}

ConfigKey FlagKey(const std::string& name, Field<bool> field) {
  const auto read = [field](const YAML::Node& value, ConfigDraft& draft) -> Problem {
    const auto text = ScalarText(value);
    if (text != "0" && text != "1" && text != "true" && text != "false") {
      return "must be 0 or 1 (false or true)";
    }
    field(draft) = text == "1" || text == "true";
    return std::nullopt;
  };
  return {name, false, read, [field](ConfigDraft& draft) { return field(draft) ? "1" : "0"; }};
}

ConfigKey TextKey(const std::string& name, Field<std::string> field) {
  const auto read = [field](const YAML::Node& value, ConfigDraft& draft) -> Problem {
    const auto text = ScalarText(value);
    if (!text) return "must be one text";
    field(draft) = *text;
    return std::nullopt;
  };
  return {name, false, read, field};
}

ConfigKey MatrixKey(const std::string& name, int rows, int cols,
                    std::function<Problem(const Eigen::MatrixXd&, ConfigDraft&)> set) {
  const auto read = [=](const YAML::Node& value, ConfigDraft& draft) {
    Eigen::MatrixXd matrix(rows, cols);
    const Problem problem = ReadMatrix(value, &matrix);
    return problem ? problem : set(matrix, draft);
  };
  return {name, false, read, [](ConfigDraft&) { return std::string(); }};
}

ConfigKey Required(ConfigKey key) {
  key.required = true;
  return key;
}

}  // namespace plm_vins
