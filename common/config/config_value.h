// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace plm_vins {

// The value of a key. A matrix is the list of its entries, row-major.
using ConfigValue = std::variant<bool, int, double, std::string, std::vector<double>>;

// Formats with at most twelve digits: "0.7", "1e-06".
std::string ToText(double number);

// Formats for a file: flags as 0 or 1, an empty text as "", a matrix as its entries.
std::string ToText(const ConfigValue& value);

}  // namespace plm_vins
