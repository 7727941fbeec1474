// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/problem/window_problem.h"

#include <algorithm>
#include <utility>

namespace plm_vins {
namespace {

ResidualTerm MakeTerm(std::unique_ptr<const Factor> cost, const ceres::LossFunction* loss,
                      std::initializer_list<int> variables) {
  ResidualTerm term;
  term.cost = std::move(cost);
  term.loss = loss;
  term.variable_count = static_cast<int>(variables.size());
  std::copy(variables.begin(), variables.end(), term.variables.begin());
  return term;
}

}  // namespace

int WindowProblem::AddVariable(const BlockId& id, double* values, bool constant,
                               const double* linearization) {
  const auto [position, is_new] = index_.emplace(id, static_cast<int>(variables_.size()));
  if (is_new) variables_.push_back({id, values, constant, linearization});
  return position->second;
}

void WindowProblem::AddTerm(std::unique_ptr<const Factor> cost, const ceres::LossFunction* loss,
                            std::initializer_list<int> variables) {
  terms_.push_back(MakeTerm(std::move(cost), loss, variables));
}

int WindowProblem::AddLandmark(const BlockId& id, double* values) {
  landmarks_.emplace_back();
  landmarks_.back().variable = AddVariable(id, values);
  return static_cast<int>(landmarks_.size()) - 1;
}

void WindowProblem::AddLandmarkTerm(int landmark, std::unique_ptr<const Factor> cost,
                                    const ceres::LossFunction* loss,
                                    std::initializer_list<int> variables) {
  landmarks_[landmark].terms.push_back(MakeTerm(std::move(cost), loss, variables));
}

int WindowProblem::Find(const BlockId& id) const {
  const auto found = index_.find(id);
  return found == index_.end() ? -1 : found->second;
}

}  // namespace plm_vins
