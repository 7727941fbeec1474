// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace plm_vins {

// Returns the bags that `places` name, each once, in order of their names. A place is a file, a
// folder (all of its files *.bag) or a pattern with *, ? and [...]. Throws std::runtime_error that
// names a folder without bags or a pattern without a match. A file need not exist.
std::vector<std::string> FindBags(const std::vector<std::string>& places);

}  // namespace plm_vins
