// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <array>
#include <initializer_list>
#include <memory>
#include <unordered_map>
#include <vector>

#include "vins_estimator/factors/factor.h"
#include "vins_estimator/problem/variable.h"

namespace plm_vins {

class MarginalizationPrior;

// One term 0.5 rho(|r|^2) of the cost. Jacobians of the factor follow factors/manifolds.h:
// taken in the tangent space and padded with zero columns to the ambient size.
struct ResidualTerm {
  static constexpr int kMaxVariables = 7;

  std::unique_ptr<const Factor> cost;
  const ceres::LossFunction* loss = nullptr;      // null: squared
  std::array<int, kMaxVariables> variables = {};  // indices of WindowProblem::variables()
  int variable_count = 0;
};

// A landmark: its variable is eliminated from the linear system before it is solved.
struct LandmarkTerms {
  int variable = -1;                // index of WindowProblem::variables()
  std::vector<ResidualTerm> terms;  // every term that depends on it
};

// A nonlinear least-squares problem over the window, in the form that both solving and
// marginalising take: variables, terms among frames, terms grouped by landmark, and the prior.
// Variables are ordered as added; a variable is added once, later additions return the same index.
class WindowProblem {
 public:
  // `linearization` as in Variable.
  int AddVariable(const BlockId& id, double* values, bool constant = false,
                  const double* linearization = nullptr);

  void AddTerm(std::unique_ptr<const Factor> cost, const ceres::LossFunction* loss,
               std::initializer_list<int> variables);

  // A landmark, and the terms that see it. Returns the landmark's index.
  int AddLandmark(const BlockId& id, double* values);
  void AddLandmarkTerm(int landmark, std::unique_ptr<const Factor> cost,
                       const ceres::LossFunction* loss, std::initializer_list<int> variables);
  void ReserveLandmarkTerms(int landmark, size_t count) {
    landmarks_[landmark].terms.reserve(count);
  }

  // The prior's variables must have been added. Not owned.
  void SetPrior(const MarginalizationPrior* prior) { prior_ = prior; }

  // Index of a variable, or -1.
  int Find(const BlockId& id) const;

  const std::vector<Variable>& variables() const { return variables_; }
  const std::vector<ResidualTerm>& terms() const { return terms_; }
  const std::vector<LandmarkTerms>& landmarks() const { return landmarks_; }
  const MarginalizationPrior* prior() const { return prior_; }

 private:
  std::vector<Variable> variables_;
  std::unordered_map<BlockId, int, BlockIdHash> index_;
  std::vector<ResidualTerm> terms_;
  std::vector<LandmarkTerms> landmarks_;
  const MarginalizationPrior* prior_ = nullptr;
};

}  // namespace plm_vins
