// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace plm_vins {

constexpr char kTrackImages[] = "tracks";  // folder of small images, STAMP_NS.jpg

// Makes the folder of results of a run, and takes out of it what an earlier run has left, so that
// results of two runs never stand side by side. Anything else in it stays. Returns its path; throws
// std::runtime_error where it cannot be made.
std::string PrepareResultFolder(const std::string& folder);

}  // namespace plm_vins
