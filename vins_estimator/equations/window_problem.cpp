// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/window_problem.h"

#include <stdexcept>

namespace plm_vins {

int WindowProblem::AddVariable(const BlockId& id, double* values, bool constant,
                               const double* linearization) {
  const auto [position, is_new] = index_.emplace(id, static_cast<int>(variables_.size()));
  if (is_new) variables_.push_back({id, values, constant, linearization});
  return position->second;
}

int WindowProblem::AddLandmark(const BlockId& id, double* values) {
  landmarks_.push_back({AddVariable(id, values), std::pmr::vector<ResidualTerm>(&memory_)});
  return static_cast<int>(landmarks_.size()) - 1;
}

void WindowProblem::CheckCount(const Factor& factor, const TermVariables& variables) {
  if (variables.count != factor.num_blocks()) {
    throw std::logic_error("a term needs one variable for each block of its factor");
  }
}

int WindowProblem::Find(const BlockId& id) const {
  const auto found = index_.find(id);
  return found == index_.end() ? -1 : found->second;
}

}  // namespace plm_vins
