// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// Formats a string as printf does. The compiler checks the arguments against the format.
[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...);

}  // namespace plm_vins
