// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <array>
#include <initializer_list>
#include <memory_resource>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "vins_estimator/equations/variable.h"
#include "vins_estimator/factors/factor.h"

namespace plm_vins {

class MarginalizationPrior;

// Variables of a term, in the order of its factor's blocks: indices of WindowProblem::variables().
struct TermVariables {
  static constexpr int kMax = 7;

  TermVariables(std::initializer_list<int> variables) {
    for (const int variable : variables) Add(variable);
  }
  void Add(int variable) { indices.at(count++) = variable; }

  std::array<int, kMax> indices = {};
  int count = 0;
};

// One term 0.5 rho(|r|^2) of the cost. Jacobians of the factor follow factors/manifolds.h: with
// respect to the tangent space and padded with zero columns to the ambient size.
struct ResidualTerm {
  static constexpr int kMaxVariables = TermVariables::kMax;

  const Factor* cost = nullptr;
  const ceres::LossFunction* loss = nullptr;      // null: squared loss
  std::array<int, kMaxVariables> variables = {};  // indices of WindowProblem::variables()
  int variable_count = 0;
};

// A landmark: its variable is eliminated before the linear system is solved.
struct LandmarkTerms {
  int variable = -1;                     // index of WindowProblem::variables()
  std::pmr::vector<ResidualTerm> terms;  // every term that depends on it
};

// A nonlinear least-squares problem over the window, in the form that both the solver and
// marginalization use: variables, terms among frames, terms grouped by landmark, and the prior.
// Variables are in order of addition; adding one again returns its index. The problem is rebuilt
// for each image from thousands of small parts, which are allocated from one arena.
class WindowProblem {
 public:
  WindowProblem() = default;
  WindowProblem(const WindowProblem&) = delete;
  WindowProblem& operator=(const WindowProblem&) = delete;

  // For `linearization`, see Variable.
  int AddVariable(const BlockId& id, double* values, bool constant = false,
                  const double* linearization = nullptr);

  // Adds a term with one variable for each block of the factor. The factor is copied; the loss must
  // outlive the problem.
  template <typename FactorType>
  void AddTerm(const FactorType& factor, const ceres::LossFunction* loss,
               const TermVariables& variables) {
    terms_.push_back(MakeTerm(factor, loss, variables));
  }

  // Adds a landmark and, below, its terms. Returns the landmark's index.
  int AddLandmark(const BlockId& id, double* values);
  template <typename FactorType>
  void AddLandmarkTerm(int landmark, const FactorType& factor, const ceres::LossFunction* loss,
                       const TermVariables& variables) {
    landmarks_[landmark].terms.push_back(MakeTerm(factor, loss, variables));
  }
  void ReserveLandmarkTerms(int landmark, size_t count) {
    landmarks_[landmark].terms.reserve(count);
  }

  // Sets the prior, which is not owned; its variables must have been added.
  void SetPrior(const MarginalizationPrior* prior) { prior_ = prior; }

  // Returns the index of a variable, or -1.
  int Find(const BlockId& id) const;

  const std::vector<Variable>& variables() const { return variables_; }
  const std::vector<ResidualTerm>& terms() const { return terms_; }
  const std::vector<LandmarkTerms>& landmarks() const { return landmarks_; }
  const MarginalizationPrior* prior() const { return prior_; }

 private:
  static constexpr size_t kUsualSize = 400'000;  // for a typical window [bytes]

  template <typename FactorType>
  const Factor* Keep(const FactorType& factor) {
    static_assert(std::is_trivially_destructible_v<FactorType>);
    return new (memory_.allocate(sizeof(FactorType), alignof(FactorType))) FactorType(factor);
  }

  template <typename FactorType>
  ResidualTerm MakeTerm(const FactorType& factor, const ceres::LossFunction* loss,
                        const TermVariables& variables) {
    CheckCount(factor, variables);
    return {Keep(factor), loss, variables.indices, variables.count};
  }

  // Throws std::logic_error unless there is one variable for each block.
  static void CheckCount(const Factor& factor, const TermVariables& variables);

  std::pmr::monotonic_buffer_resource memory_{kUsualSize};
  std::vector<Variable> variables_;
  std::pmr::unordered_map<BlockId, int, BlockIdHash> index_{&memory_};
  std::vector<ResidualTerm> terms_;
  std::vector<LandmarkTerms> landmarks_;
  const MarginalizationPrior* prior_ = nullptr;
};

}  // namespace plm_vins
