// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config_value.h"

#include <sstream>

namespace plm_vins {
namespace {

struct Printer {
  std::string operator()(bool flag) const { return flag ? "1" : "0"; }
  std::string operator()(int number) const { return std::to_string(number); }
  std::string operator()(double number) const { return ToText(number); }
  std::string operator()(const std::string& text) const { return text.empty() ? "\"\"" : text; }
  std::string operator()(const std::vector<double>& entries) const {
    std::string text;
    for (const double entry : entries) text += (text.empty() ? "[" : ", ") + ToText(entry);
    return text + "]";
  }
};

}  // namespace

std::string ToText(double number) {
  std::ostringstream text;
  text.precision(12);
  text << number;
  return text.str();
}

std::string ToText(const ConfigValue& value) { return std::visit(Printer(), value); }

}  // namespace plm_vins
