// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plm_vins {

// Number of insertions, deletions and replacements of letters that turn `a` into `b` (Levenshtein
// distance).
int EditDistance(const std::string& a, const std::string& b);

// Returns the word most similar to `misspelt`, where "x" may stand for "group.x"; nullopt if no
// word is similar.
std::optional<std::string> NearestWord(const std::string& misspelt,
                                       const std::vector<std::string>& words);

}  // namespace plm_vins
