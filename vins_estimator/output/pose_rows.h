// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "common/geometry/rigid3.h"
#include "vins_estimator/state/estimator_output.h"

namespace plm_vins {

// Formats one row of a TUM trajectory, "timestamp tx ty tz qx qy qz qw", with nine decimals each.
// The timestamp is in seconds, exact to the nanosecond.
std::string FormatTumRow(int64_t t_ns, const Rigid3d& T_W_B);

// Formats a comment between rows: the following poses are in a new world frame.
std::string FormatTumRestart(const std::string& reason);

// Writes covariance.csv: a header, then one row per pose whose covariance is known, with its
// timestamp [ns] and the upper triangle of the covariance, row by row: position p_W [m], then
// rotation in B [rad], R_W_B Exp(theta).
std::string CovarianceHeader();
void WriteCovarianceRow(int64_t t_ns, const Matrix6d& covariance, std::ostream* stream);

}  // namespace plm_vins
