// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace plm_vins {

template <typename Value>
void Append(const std::vector<Value>& more, std::vector<Value>* all) {
  all->insert(all->end(), more.begin(), more.end());
}

}  // namespace plm_vins
