// SPDX-License-Identifier: BSD-3-Clause
// The kinds of configuration keys. A key describes a value completely: name in the file, unit and
// range, and how to read it into a field and write it back.
#pragma once

#include <Eigen/Core>
#include <algorithm>
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

// A key of the struct `Section`. `field` is a pointer to a member, or a function that returns a
// reference into its argument.
template <typename Section>
struct ConfigKey {
  std::string name;     // "td", or "group.name"
  std::string unit;     // "px"; empty: none
  std::string allowed;  // "2 to 500", "one of fld, lsd, edlines"; empty: `read` decides
  std::function<Problem(const YAML::Node& value, Section& section)> read;
  std::function<ConfigValue(const Section& section)> value;
  bool required = false;
  bool has_default = true;
  // Clamps a number that a program has set to its range; empty for other types.
  std::function<void(Section& section)> keep_in_range = nullptr;

  template <typename Field>
  static ConfigKey Number(const std::string& name, const std::string& unit, Range range,
                          Field field) {
    const auto read = [=](const YAML::Node& value, Section& section) {
      return ReadNumber(value, unit, range, &std::invoke(field, section));
    };
    ConfigKey key{name, unit, ToText(range), read, ValueOf(field)};
    key.keep_in_range = [=](Section& section) {
      double& number = std::invoke(field, section);
      number = std::clamp(number, range.min, range.max);
    };
    return key;
  }

  template <typename Field>
  static ConfigKey Integer(const std::string& name, const std::string& unit, Range range,
                           Field field) {
    const auto read = [=](const YAML::Node& value, Section& section) {
      return ReadInteger(value, unit, range, &std::invoke(field, section));
    };
    return {name, unit, ToText(range), read, ValueOf(field)};
  }

  template <typename Field>
  static ConfigKey Flag(const std::string& name, Field field) {
    const auto read = [=](const YAML::Node& value, Section& section) {
      return ReadFlag(value, &std::invoke(field, section));
    };
    return {name, "", "0 or 1", read, ValueOf(field)};
  }

  template <typename Field>
  static ConfigKey Text(const std::string& name, Field field) {
    const auto read = [=](const YAML::Node& value, Section& section) {
      return ReadText(value, &std::invoke(field, section));
    };
    return {name, "", "", read, ValueOf(field)};
  }

  // A choice among words. Several words may have the same value, which is then written as the first
  // one.
  template <typename T>
  static ConfigKey Choice(const std::string& name, std::vector<std::pair<std::string, T>> choices,
                          T Section::*field) {
    std::string allowed;
    for (const auto& [word, choice] : choices) allowed += (allowed.empty() ? "" : ", ") + word;
    allowed = "one of " + allowed;
    const auto read = [=](const YAML::Node& value, Section& section) -> Problem {
      for (const auto& [word, choice] : choices) {
        if (ScalarText(value) != word) continue;
        section.*field = choice;
        return std::nullopt;
      }
      return "must be " + allowed;
    };
    const auto value = [=](const Section& section) {
      for (const auto& [word, choice] : choices) {
        if (section.*field == choice) return ConfigValue(word);
      }
      return ConfigValue(std::string());
    };
    return {name, "", allowed, read, value};
  }

  // An OpenCV matrix of the size that `get` returns; `set` may reject it.
  static ConfigKey Matrix(const std::string& name,
                          std::function<Eigen::MatrixXd(const Section& section)> get,
                          std::function<Problem(const Eigen::MatrixXd&, Section& section)> set) {
    const auto read = [=](const YAML::Node& value, Section& section) {
      Eigen::MatrixXd matrix = get(section);
      const Problem problem = ReadMatrix(value, &matrix);
      return problem ? problem : set(matrix, section);
    };
    const auto value = [=](const Section& section) {
      const Eigen::MatrixXd by_column = get(section).transpose();
      return ConfigValue(
          std::vector<double>(by_column.data(), by_column.data() + by_column.size()));
    };
    return {name, "", "", read, value, /*required=*/false, /*has_default=*/false};
  }

 private:
  template <typename Field>
  static std::function<ConfigValue(const Section&)> ValueOf(Field field) {
    return [=](const Section& section) { return ConfigValue(std::invoke(field, section)); };
  }
};

template <typename Section>
using ConfigKeys = std::vector<ConfigKey<Section>>;

template <typename Section>
ConfigKeys<Section> Required(ConfigKeys<Section> keys) {
  for (auto& key : keys) {
    key.required = true;
    key.has_default = false;
  }
  return keys;
}

// Converts the keys of a part to keys of the whole. `find` returns a pointer to the part, or
// nullptr if it is absent: its keys are then read but not stored, and have the values of a default
// part.
template <typename Whole, typename Part, typename Find>
ConfigKeys<Whole> KeysOfPart(Find find, const ConfigKeys<Part>& keys) {
  ConfigKeys<Whole> result;
  for (const ConfigKey<Part>& key : keys) {
    const auto read = [find, key](const YAML::Node& value, Whole& whole) {
      Part* part = find(whole);
      Part absent;
      return key.read(value, part ? *part : absent);
    };
    const auto value = [find, key](const Whole& whole) {
      const Part* part = find(whole);
      return key.value(part ? *part : Part());
    };
    result.push_back({key.name, key.unit, key.allowed, read, value, key.required, key.has_default});
    if (!key.keep_in_range) continue;
    result.back().keep_in_range = [find, key](Whole& whole) {
      if (Part* part = find(whole)) key.keep_in_range(*part);
    };
  }
  return result;
}

template <typename Whole, typename Part>
ConfigKeys<Whole> Within(Part Whole::*part, const ConfigKeys<Part>& keys) {
  return KeysOfPart<Whole>([part](auto& whole) { return &(whole.*part); }, keys);
}

template <typename Whole, typename Part>
ConfigKeys<Whole> Within(std::optional<Part> Whole::*part, const ConfigKeys<Part>& keys) {
  return KeysOfPart<Whole>([part](auto& whole) { return whole.*part ? &*(whole.*part) : nullptr; },
                           keys);
}

template <typename Section>
ConfigKeys<Section> Join(const std::vector<ConfigKeys<Section>>& lists) {
  ConfigKeys<Section> keys;
  for (const ConfigKeys<Section>& list : lists) keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

}  // namespace plm_vins
