// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vins_estimator/equations/block_cholesky.h"
#include "vins_estimator/equations/equation_layout.h"
#include "vins_estimator/equations/landmark_equations.h"
#include "vins_estimator/equations/window_problem.h"

namespace plm_vins {

// The Gauss-Newton equations of a WindowProblem at the current values of its variables:
//
//   [ H_dd  H_dl ] [ step_d ]     [ b_d ]      d: frame variables, dense
//   [ H_ld  H_ll ] [ step_l ] = - [ b_l ]      l: landmarks, H_ll block-diagonal
//
// with H = J^T W J, b = J^T W r, W = rho' (robust weight of each term). Landmarks are eliminated
// one by one (Schur complement). If a variable has a linearization point, J is evaluated there and
// r at the current values. A term that cannot be evaluated at the first linearization (a landmark
// behind a camera) is ignored from then on.
class NormalEquations {
 public:
  // `problem` must outlive this object and keep its structure; its values may change.
  explicit NormalEquations(const WindowProblem& problem);
  NormalEquations(const NormalEquations&) = delete;
  NormalEquations& operator=(const NormalEquations&) = delete;

  // Linearizes at the current values. Returns the cost.
  double Linearize();

  // Returns the cost only. Infinite if a term cannot be evaluated, unless it is ignored, so that
  // the solver rejects such a step.
  double Cost() const;

  // Computes the dense equations with all landmarks eliminated: S step_d = -g, S upper triangle.
  // Diagonals are scaled by 1 + `damping` before.
  void Reduce(double damping, Eigen::MatrixXd* S, Eigen::VectorXd* g) const;

  // Returns step_d with the same damping; empty if the equations are rank deficient.
  Eigen::VectorXd DenseStep(double damping);

  // Returns step_l of landmark `index` for `dense_step`, with the same damping.
  LandmarkVector LandmarkStep(int index, const Eigen::VectorXd& dense_step, double damping) const;

  // Returns the decrease of the quadratic cost model by a step that solves the equations with this
  // damping: the part of the dense variables, and that of landmark `index`. With H step = -b -
  // damping diag(H) step, it is -b step / 2 + damping step diag(H) step / 2.
  double DenseGain(const Eigen::VectorXd& step, double damping) const;
  double LandmarkGain(int index, const LandmarkVector& step, double damping) const;

  // Returns whether a variable of the problem is neither constant nor a landmark.
  bool IsDense(const BlockId& id) const {
    const int variable = problem_.Find(id);
    return variable >= 0 && DenseOffset(variable) >= 0;
  }

  // Returns the joint covariance of dense variables, in the given order, at the last linearization;
  // nullopt if they are unobservable. Throws std::invalid_argument for landmarks, constants and
  // variables that are not in the problem.
  std::optional<Eigen::MatrixXd> Covariance(const std::vector<BlockId>& ids);

  // Returns the first row of a variable in the dense equations; -1 for constants and landmarks.
  int DenseOffset(int variable) const { return layout_.dense_offset()[variable]; }
  int dense_size() const { return layout_.dense_size(); }

 private:
  bool Factor(double damping);
  bool AddTerm(const TermLayout& layout, double* cost);
  double AddPrior();

  const WindowProblem& problem_;
  const EquationLayout layout_;
  std::vector<bool> left_out_;  // flags by term: ignored since the first linearization
  Eigen::VectorXd H_ld_;        // memory for all landmarks' H_ld
  std::vector<LandmarkEquations> landmarks_;
  Eigen::MatrixXd H_dd_;  // upper triangle
  Eigen::VectorXd b_d_;
  Eigen::MatrixXd S_;  // reduced equations, with g_
  Eigen::VectorXd g_;
  std::optional<BlockCholesky> factor_;  // Cholesky factor of S_
  double factor_damping_ = 0;            // damping of S_, valid if there is a factor
};

}  // namespace plm_vins
