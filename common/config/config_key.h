// SPDX-License-Identifier: BSD-3-Clause
// The kinds of configuration keys. A key describes a value completely: name in the file, unit and
// range, and how to read it into a field and write it back.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config_value.h"

namespace YAML {
class Node;
}

namespace plm_vins {

// Problem of a value, as the end of the sentence "KEY: ..."; nullopt if it is valid.
using Problem = std::optional<std::string>;

struct Range {
  double min;
  double max;
};

// Formats "2 to 500".
std::string ToText(Range range);

// Returns the text of a scalar, or nullopt for a list, a map or an empty value.
std::optional<std::string> ScalarText(const YAML::Node& value);

// These read a value of one kind. If they return a problem, the last argument is unchanged.
Problem ReadNumber(const YAML::Node& value, const std::string& unit, Range range, double* number);
Problem ReadInteger(const YAML::Node& value, const std::string& unit, Range range, int* number);
Problem ReadFlag(const YAML::Node& value, bool* flag);
Problem ReadText(const YAML::Node& value, std::string* text);
// `matrix` must have the expected size.
Problem ReadMatrix(const YAML::Node& value, Eigen::MatrixXd* matrix);

// A key, bound to a field of a configuration that outlives it.
struct ConfigKey {
  std::string name;     // "td", or "group.name"
  std::string unit;     // "px"; empty: none
  std::string allowed;  // "2 to 500", "one of fld, lsd, edlines"; empty: `read` decides
  std::function<Problem(const YAML::Node& value)> read;  // stores a valid value in the field
  std::function<ConfigValue()> value;                    // of the field
  bool required = false;
  bool has_default = true;
  // Clamps a number that a program has set to its range; empty for other types.
  std::function<void()> keep_in_range;

  static ConfigKey Number(const std::string& name, const std::string& unit, Range range,
                          double* field);
  static ConfigKey Integer(const std::string& name, const std::string& unit, Range range,
                           int* field);
  static ConfigKey Flag(const std::string& name, bool* field);
  static ConfigKey Text(const std::string& name, std::string* field);

  // A choice among words. Several words may have the same value, which is then written as the first
  // one.
  template <typename T>
  static ConfigKey Choice(const std::string& name,
                          const std::vector<std::pair<std::string, T>>& choices, T* field) {
    std::vector<std::string> words;
    words.reserve(choices.size());
    for (const auto& choice : choices) words.push_back(choice.first);
    const auto set = [=](size_t i) { *field = choices[i].second; };
    const auto is = [=](size_t i) { return *field == choices[i].second; };
    return OneOf(name, words, set, is);
  }

  // An OpenCV matrix of the size that `get` returns; `set` may reject it.
  static ConfigKey Matrix(const std::string& name, const std::function<Eigen::MatrixXd()>& get,
                          const std::function<Problem(const Eigen::MatrixXd&)>& set);

 private:
  // A choice among words by number: `set` stores one, `is` compares the field with one.
  static ConfigKey OneOf(const std::string& name, const std::vector<std::string>& words,
                         const std::function<void(size_t)>& set,
                         const std::function<bool(size_t)>& is);
};

using ConfigKeys = std::vector<ConfigKey>;

ConfigKeys Required(ConfigKeys keys);

// Returns the keys of all lists in their order.
ConfigKeys Join(const std::vector<ConfigKeys>& lists);

}  // namespace plm_vins
