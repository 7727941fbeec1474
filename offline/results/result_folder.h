// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace plm_vins {

constexpr char kTrackImages[] = "tracks";  // folder of small images, STAMP_NS.jpg

// Relative paths of all files that a run or its evaluation may write to its folder, except images
// in tracks/ and parts of files after backward jumps.
std::vector<std::string> ResultNames();

// Creates the result folder if it is missing. Throws std::runtime_error if it cannot be created.
void MakeResultFolder(const std::string& folder);

// Removes the results of an earlier run and of its evaluation, so that the folder never mixes two
// runs. Keeps other files, and the configuration of this run, which may be calibrated.yaml of the
// earlier one. The next evaluation replaces plots/.
void RemoveEarlierResults(const std::string& folder, const std::string& config_file);

}  // namespace plm_vins
