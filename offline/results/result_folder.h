// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace plm_vins {

constexpr char kTrackImages[] = "tracks";  // folder of small images, STAMP_NS.jpg

// What a run may write into its folder, and what may be evaluated there: paths from it, but for
// images in tracks/ and parts of before stamps jumped back.
std::vector<std::string> ResultNames();

// Makes the folder of results of a run where it is missing. Throws std::runtime_error where it
// cannot be made.
void MakeResultFolder(const std::string& folder);

// Takes out of it what an earlier run has left and what was evaluated of that, so that results of
// two runs never stand side by side. Anything else in it stays, and so does the configuration of
// this run, which may be the calibrated one of that. plots/ are replaced by the next evaluation.
void RemoveEarlierResults(const std::string& folder, const std::string& config_file);

}  // namespace plm_vins
