// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/nearest_word.h"

#include <algorithm>
#include <numeric>

namespace plm_vins {

int EditDistance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);  // distances of a[0, i) to all prefixes of b
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::optional<std::string> NearestWord(const std::string& misspelt,
                                       const std::vector<std::string>& words) {
  std::optional<std::string> nearest;
  int least = std::max(1, static_cast<int>(misspelt.size()) / 3) + 1;
  for (const std::string& word : words) {
    const std::string last_part = word.substr(word.rfind('.') + 1);
    const int distance = std::min(EditDistance(misspelt, word), EditDistance(misspelt, last_part));
    if (distance >= least) continue;
    least = distance;
    nearest = word;
  }
  return nearest;
}

}  // namespace plm_vins
