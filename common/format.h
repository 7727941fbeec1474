// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace plm_vins {

// Formats a string as printf does. The compiler checks the arguments against the format.
[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...);

// Joins the texts that are not empty.
std::string JoinTexts(const std::vector<std::string>& texts, const std::string& separator);

}  // namespace plm_vins
