// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>

#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Writes covariance.csv: a header, then one row per pose whose covariance is known, with its
// timestamp [ns] and the upper triangle of the covariance, row by row: position p_W [m], then
// rotation in B [rad], R_W_B Exp(theta).
std::string CovarianceHeader();
void WriteCovarianceRow(int64_t t_ns, const Matrix6d& covariance, std::ostream* stream);

}  // namespace plm_vins
