// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vins_estimator/problem/window_problem.h"

namespace plm_vins {

// The Gauss-Newton equations of a WindowProblem at the current values of its variables:
//
//   [ H_dd  H_dl ] [ step_d ]     [ b_d ]      d: frame variables, dense
//   [ H_ld  H_ll ] [ step_l ] = - [ b_l ]      l: landmarks, H_ll block-diagonal
//
// with H = J^T W J, b = J^T W r, W = rho' (robust weight of each term). Landmarks are eliminated
// one by one (Schur complement). Where a variable has a linearisation point, J is taken there and r
// at the values.
class NormalEquations {
 public:
  static constexpr int kMaxLandmarkSize = 4;
  using LandmarkMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxLandmarkSize, kMaxLandmarkSize>;
  using LandmarkVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxLandmarkSize, 1>;

  // `problem` must outlive this object and keep its structure; its values may change.
  explicit NormalEquations(const WindowProblem& problem);

  // Fills the equations at the current values. Returns the cost.
  double Linearize();

  // The cost alone.
  double Cost() const;

  // The dense equations with all landmarks eliminated: S step_d = -g. Diagonals are scaled by
  // 1 + `damping` before. S is full and symmetric.
  void Reduce(double damping, Eigen::MatrixXd* S, Eigen::VectorXd* g) const;

  // step_l of landmark `index` that belongs to `dense_step`, with the same damping.
  LandmarkVector LandmarkStep(int index, const Eigen::VectorXd& dense_step, double damping) const;

  // Joint covariance of some dense variables, in the order given, at the last linearisation. Empty
  // where the equations determine them not at all.
  Eigen::MatrixXd Covariance(const std::vector<BlockId>& ids) const;

  // First row of a variable in the dense equations; -1 for constants and landmarks.
  int DenseOffset(int variable) const { return dense_offset_[variable]; }
  int dense_size() const { return dense_size_; }

 private:
  // Neighbouring columns of H_ld that are neighbours in the dense equations as well.
  struct ColumnRun {
    int local = 0;
    int dense = 0;
    int size = 0;
  };

  // One landmark's share of the equations, over the dense columns that its terms touch.
  struct LandmarkEquations {
    std::vector<ColumnRun> runs;
    LandmarkMatrix H_ll;
    LandmarkVector b_l;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> H_ld;
  };

  // Where one variable of a term goes: columns of J to rows of the equations.
  struct Slot {
    int block = 0;         // position among the term's variables
    int size = 0;          // tangent size
    int dense_offset = 0;  // first dense column
    int local_offset = 0;  // first column in its landmark's H_ld
  };

  // A term together with its slots in order of dense columns.
  struct TermLayout {
    const ResidualTerm* term = nullptr;
    std::vector<Slot> slots;
    int landmark = -1;        // index, or -1
    int landmark_block = -1;  // position of the landmark among the term's variables
  };

  void LayOutFrameVariables();
  TermLayout LayOut(const ResidualTerm& term, int landmark) const;
  void LayOutLandmark(int landmark);
  double AddTerm(const TermLayout& layout);
  double AddPrior();

  const WindowProblem& problem_;
  std::vector<int> dense_offset_;  // by variable
  int dense_size_ = 0;
  std::vector<TermLayout> layouts_;
  std::vector<LandmarkEquations> landmarks_;
  Eigen::MatrixXd H_dd_;  // upper triangle
  Eigen::VectorXd b_d_;
};

}  // namespace plm_vins
