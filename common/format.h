// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

// What printf would write. The compiler holds the format to its arguments.
[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...);

}  // namespace plm_vins
