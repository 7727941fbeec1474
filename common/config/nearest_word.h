// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// Insertions, deletions and replacements of letters that turn `a` into `b` (Levenshtein distance).
int EditDistance(const std::string& a, const std::string& b);

// The word that `misspelt` was probably meant to be, where "x" may stand for "group.x"; nothing
// where none is near.
std::optional<std::string> NearestWord(const std::string& misspelt,
                                       const std::vector<std::string>& words);

}  // namespace plm_vins
