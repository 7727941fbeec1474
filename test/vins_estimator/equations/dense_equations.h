// SPDX-License-Identifier: BSD-3-Clause
// The Gauss-Newton equations of a WindowProblem from all Jacobians stacked in one dense matrix.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "vins_estimator/equations/marginalization_prior.h"
#include "vins_estimator/equations/normal_equations.h"
#include "vins_estimator/equations/window_problem.h"

namespace plm_vins::testing {

// H step = -b over the frame variables (columns as in NormalEquations), then the landmarks.
struct DenseEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
  double cost = 0;
  std::vector<int> offset;  // first column of each variable; -1 for constants
};

class DenseEquationsBuilder {
 public:
  DenseEquationsBuilder(const WindowProblem& problem, const NormalEquations& columns)
      : problem_(problem) {
    int size = columns.dense_size();
    for (size_t i = 0; i < problem.variables().size(); ++i) {
      equations_.offset.push_back(columns.DenseOffset(static_cast<int>(i)));
    }
    for (const LandmarkTerms& landmark : problem.landmarks()) {
      equations_.offset[landmark.variable] = size;
      size += problem.variables()[landmark.variable].type().tangent_size;
    }
    equations_.H = Eigen::MatrixXd::Zero(size, size);
    equations_.b = Eigen::VectorXd::Zero(size);
  }

  DenseEquations Build() {
    for (const ResidualTerm& term : problem_.terms()) Add(term);
    for (const LandmarkTerms& landmark : problem_.landmarks()) {
      for (const ResidualTerm& term : landmark.terms) Add(term);
    }
    if (problem_.prior() != nullptr) AddPrior(*problem_.prior());
    return equations_;
  }

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const Variable& VariableOf(const ResidualTerm& term, int block) const {
    return problem_.variables()[term.variables[block]];
  }

  void Add(const ResidualTerm& term) {
    std::vector<const double*> values, points;
    std::vector<RowMajor> blocks;
    std::vector<double*> jacobians;
    const int rows = term.cost->num_residuals();
    for (int k = 0; k < term.variable_count; ++k) {
      const Variable& variable = VariableOf(term, k);
      values.push_back(variable.values);
      points.push_back(variable.linearization ? variable.linearization : variable.values);
      blocks.emplace_back(rows, variable.type().ambient_size);
    }
    jacobians.reserve(blocks.size());
    for (RowMajor& block : blocks) jacobians.push_back(block.data());
    Eigen::VectorXd r(rows);
    ASSERT_TRUE(term.cost->Evaluate(points.data(), r.data(), jacobians.data()));
    ASSERT_TRUE(term.cost->Evaluate(values.data(), r.data(), nullptr));
    double rho[3] = {r.squaredNorm(), 1, 0};
    if (term.loss != nullptr) term.loss->Evaluate(r.squaredNorm(), rho);
    equations_.cost += 0.5 * rho[0];

    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, equations_.b.size());
    for (int k = 0; k < term.variable_count; ++k) {
      const int offset = equations_.offset[term.variables[k]];
      const int size = VariableOf(term, k).type().tangent_size;
      if (offset >= 0) J.middleCols(offset, size) += blocks[k].leftCols(size);
    }
    equations_.H += rho[1] * J.transpose() * J;
    equations_.b += rho[1] * J.transpose() * r;
  }

  // Adds 0.5 delta^T H delta + b^T delta through the selection matrix of its variables.
  void AddPrior(const MarginalizationPrior& prior) {
    const Quadratic& quadratic = prior.quadratic();
    Eigen::VectorXd delta(quadratic.b.size());
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(quadratic.b.size(), equations_.b.size());
    for (const MarginalizationPrior::Block& block : prior.blocks()) {
      const int index = problem_.Find(block.id);
      const VariableType& type = problem_.variables()[index].type();
      type.minus(problem_.variables()[index].values, block.linearization.data(),
                 &delta[block.offset]);
      const int offset = equations_.offset[index];
      if (offset >= 0)
        S.block(block.offset, offset, type.tangent_size, type.tangent_size).setIdentity();
    }
    equations_.H += S.transpose() * quadratic.H * S;
    equations_.b += S.transpose() * (quadratic.H * delta + quadratic.b);
    equations_.cost += 0.5 * delta.dot(quadratic.H * delta) + quadratic.b.dot(delta);
  }

  const WindowProblem& problem_;
  DenseEquations equations_;
};

inline DenseEquations BuildDenseEquations(const WindowProblem& problem,
                                          const NormalEquations& columns) {
  return DenseEquationsBuilder(problem, columns).Build();
}

// Scale factors that give H a unit diagonal, since meters, radians and biases differ by orders of
// magnitude.
inline Eigen::VectorXd UnitDiagonalScale(const Eigen::MatrixXd& H) {
  return H.diagonal().cwiseSqrt().cwiseInverse();
}

inline Eigen::MatrixXd ScaleBothSides(const Eigen::MatrixXd& H, const Eigen::VectorXd& scale) {
  return scale.asDiagonal() * H * scale.asDiagonal();
}

// Solves H x = right with scaling.
inline Eigen::MatrixXd SolveScaled(const Eigen::MatrixXd& H, const Eigen::MatrixXd& right) {
  const Eigen::VectorXd scale = UnitDiagonalScale(H);
  return scale.asDiagonal() *
         ScaleBothSides(H, scale).ldlt().solve(Eigen::MatrixXd(scale.asDiagonal() * right));
}

}  // namespace plm_vins::testing
