// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace plm_vins {

// Adjacent columns of a narrow matrix that are adjacent in a wide matrix as well.
struct ColumnRun {
  int local = 0;
  int dense = 0;
  int size = 0;
};

inline int CountColumns(const std::vector<ColumnRun>& runs) {
  return runs.empty() ? 0 : runs.back().local + runs.back().size;
}

// Appends `size` columns of the wide matrix, starting at `dense`.
inline void AppendColumns(int dense, int size, std::vector<ColumnRun>* runs) {
  const bool continues = !runs->empty() && runs->back().dense + runs->back().size == dense;
  if (!continues) runs->push_back({CountColumns(*runs), dense, 0});
  runs->back().size += size;
}

}  // namespace plm_vins
