// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vins_estimator/equations/gram.h"
#include "vins_estimator/equations/window_problem.h"

namespace plm_vins {

// Maps the Jacobian columns of one variable of a term to columns of the equations.
struct Slot {
  int block = 0;         // position among the term's variables
  int size = 0;          // tangent size
  int stride = 0;        // columns of its Jacobian: ambient size
  int dense_offset = 0;  // first dense column
  int local_offset = 0;  // first column in its landmark's H_ld
};

// A term with its dense variables, in order of their columns.
struct TermLayout {
  const ResidualTerm* term = nullptr;
  std::array<Slot, ResidualTerm::kMaxVariables> slots;
  int slot_count = 0;
  int landmark = -1;        // index, or -1
  int landmark_block = -1;  // its position among the term's variables
  int landmark_stride = 0;  // columns of its Jacobian

  const Slot* begin() const { return slots.data(); }
  const Slot* end() const { return slots.data() + slot_count; }
};

// Positions of a problem's variables in its equations (see NormalEquations). Frame variables have
// dense columns, motions last and by time: each motion is coupled to its neighbors only, and only
// the oldest is in the prior, which BlockCholesky exploits. Each landmark has equations of its own;
// constants have none.
class EquationLayout {
 public:
  // `problem` must outlive this object and keep its structure.
  explicit EquationLayout(const WindowProblem& problem);

  // First dense column of each variable; -1 for constants and landmarks.
  const std::vector<int>& dense_offset() const { return dense_offset_; }
  int dense_size() const { return dense_size_; }
  int motion_size() const { return motion_size_; }  // number of columns of all motions

  // Terms among frames, then the terms of each landmark.
  const std::vector<TermLayout>& terms() const { return terms_; }
  // Dense columns that each landmark's terms use, in as few runs as possible.
  const std::vector<std::vector<ColumnRun>>& landmarks() const { return landmarks_; }

 private:
  void LayOutFrameVariables();
  void AppendColumnsOf(const std::vector<int>& variables);
  TermLayout LayOut(const ResidualTerm& term, int landmark) const;
  void LayOutLandmark(int landmark);

  const WindowProblem& problem_;
  std::vector<int> dense_offset_;
  int dense_size_ = 0;
  int motion_size_ = 0;
  std::vector<TermLayout> terms_;
  std::vector<std::vector<ColumnRun>> landmarks_;
};

}  // namespace plm_vins
