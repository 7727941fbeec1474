// SPDX-License-Identifier: BSD-3-Clause
#include "vins_estimator/equations/equation_layout.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace plm_vins {
namespace {

using DenseBlock = std::pair<int, int>;  // offset, size

// Inserts a slot in order of the dense columns.
void Insert(const Slot& slot, TermLayout* layout) {
  int position = layout->slot_count++;
  for (; position > 0; --position) {
    if (layout->slots[position - 1].dense_offset <= slot.dense_offset) break;
    layout->slots[position] = layout->slots[position - 1];
  }
  layout->slots[position] = slot;
}

// Returns the dense variables of some terms, each once, in order of their columns.
std::vector<DenseBlock> DenseBlocks(const TermLayout* begin, const TermLayout* end) {
  std::vector<DenseBlock> blocks;
  blocks.reserve(ResidualTerm::kMaxVariables * (end - begin));
  for (const TermLayout* term = begin; term != end; ++term) {
    for (const Slot& slot : *term) blocks.emplace_back(slot.dense_offset, slot.size);
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

// Returns the column of H_ld for a dense column.
int LocalColumn(const std::vector<ColumnRun>& runs, int dense) {
  const auto after =
      std::upper_bound(runs.begin(), runs.end(), dense,
                       [](int column, const ColumnRun& run) { return column < run.dense; });
  const ColumnRun& run = *std::prev(after);
  return run.local + dense - run.dense;
}

}  // namespace

EquationLayout::EquationLayout(const WindowProblem& problem) : problem_(problem) {
  LayOutFrameVariables();
  size_t term_count = problem.terms().size();
  for (const LandmarkTerms& landmark : problem.landmarks()) term_count += landmark.terms.size();
  terms_.reserve(term_count);
  for (const ResidualTerm& term : problem.terms()) terms_.push_back(LayOut(term, -1));
  landmarks_.resize(problem.landmarks().size());
  for (size_t i = 0; i < landmarks_.size(); ++i) LayOutLandmark(static_cast<int>(i));
}

void EquationLayout::LayOutFrameVariables() {
  const std::vector<Variable>& variables = problem_.variables();
  std::vector<bool> is_dense(variables.size());
  for (size_t i = 0; i < variables.size(); ++i) is_dense[i] = !variables[i].constant;
  for (const LandmarkTerms& landmark : problem_.landmarks()) is_dense[landmark.variable] = false;
  dense_offset_.assign(variables.size(), -1);
  std::vector<int> motions, others;
  for (size_t i = 0; i < variables.size(); ++i) {
    if (!is_dense[i]) continue;
    (variables[i].id.kind == BlockKind::kMotion ? motions : others).push_back(static_cast<int>(i));
  }
  std::sort(motions.begin(), motions.end(),
            [&](int a, int b) { return variables[a].id.key < variables[b].id.key; });
  AppendColumnsOf(others);
  const int before = dense_size_;
  AppendColumnsOf(motions);
  motion_size_ = dense_size_ - before;
}

void EquationLayout::AppendColumnsOf(const std::vector<int>& variables) {
  for (const int variable : variables) {
    dense_offset_[variable] = dense_size_;
    dense_size_ += problem_.variables()[variable].type().tangent_size;
  }
}

TermLayout EquationLayout::LayOut(const ResidualTerm& term, int landmark) const {
  TermLayout layout;
  layout.term = &term;
  layout.landmark = landmark;
  for (int block = 0; block < term.variable_count; ++block) {
    const int variable = term.variables[block];
    const VariableType& type = problem_.variables()[variable].type();
    if (landmark >= 0 && variable == problem_.landmarks()[landmark].variable) {
      layout.landmark_block = block;
      layout.landmark_stride = type.ambient_size;
    } else if (dense_offset_[variable] >= 0) {
      Insert({block, type.tangent_size, type.ambient_size, dense_offset_[variable], 0}, &layout);
    }
  }
  return layout;
}

void EquationLayout::LayOutLandmark(int index) {
  const size_t first = terms_.size();
  for (const ResidualTerm& term : problem_.landmarks()[index].terms) {
    terms_.push_back(LayOut(term, index));
  }
  TermLayout* const begin = terms_.data() + first;
  TermLayout* const end = terms_.data() + terms_.size();
  std::vector<ColumnRun>& runs = landmarks_[index];
  const std::vector<DenseBlock> blocks = DenseBlocks(begin, end);
  runs.reserve(blocks.size());
  for (const auto& [offset, size] : blocks) AppendColumns(offset, size, &runs);
  for (TermLayout* term = begin; term != end; ++term) {
    for (int i = 0; i < term->slot_count; ++i) {
      Slot& slot = term->slots[i];
      slot.local_offset = LocalColumn(runs, slot.dense_offset);
    }
  }
}

}  // namespace plm_vins
