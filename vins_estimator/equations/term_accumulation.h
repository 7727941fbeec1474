// SPDX-License-Identifier: BSD-3-Clause
// Accumulation of J^T J and J^T r of single terms in the normal equations.
#pragma once

#include <Eigen/Core>

#include "vins_estimator/equations/equation_layout.h"
#include "vins_estimator/equations/landmark_equations.h"
#include "vins_estimator/equations/term_evaluation.h"

namespace plm_vins {

// Adds a term to the dense equations: to the upper triangle of H, and to b.
void AddToDense(const TermLayout& layout, const TermEvaluation& evaluation, Eigen::MatrixXd* H,
                Eigen::VectorXd* b);

// Adds a term to the equations of its landmark.
void AddToLandmark(const TermLayout& layout, const TermEvaluation& evaluation,
                   LandmarkEquations* equations);

}  // namespace plm_vins
