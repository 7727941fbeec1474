// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

namespace plm_vins {

// Ratio of a stated length to the true one, on a logarithmic scale.
struct RatioEstimate {
  double log_ratio = 0;
  // Standard deviation of log_ratio; infinite if the ratio is unobservable.
  double deviation = std::numeric_limits<double>::infinity();
  double contradiction = 0;  // by which the ratio one is ruled out, in standard deviations
};

// Log-likelihood of the ratio of a stated length to the true one, from 1/3000 to 3000, with half
// the chi-square of the residuals. Curves of independent data add up. Both are needed: of two
// ratios that fit equally well, the likelihood prefers the one that predicts more precisely.
class RatioCurve {
 public:
  static constexpr int kHalf = 800, kPoints = 2 * kHalf + 1;
  static constexpr double kStep = 0.01;  // of the logarithm

  static double LogRatio(int i) { return kStep * (i - kHalf); }

  void Set(int i, double log_likelihood, double half_chi_square) {
    likelihood_[i] = log_likelihood;
    half_chi_square_[i] = half_chi_square;
  }
  void Add(const RatioCurve& other, double weight = 1);

  // Returns the most likely ratio. Its deviation follows from the curvature there, and includes
  // `model_deviation`, that of what the data were compared with. The contradiction is the least of
  // the distance of the ratio one in these deviations and of what likelihood and chi-square say.
  RatioEstimate Estimate(double model_deviation) const;

 private:
  std::array<double, kPoints> likelihood_ = {}, half_chi_square_ = {};
};

}  // namespace plm_vins
